/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef itkSensorNoiseEstimator_hxx
#define itkSensorNoiseEstimator_hxx

#include <algorithm>
#include <vector>

namespace itk
{

template <typename TStack>
SensorNoiseEstimator<TStack>::SensorNoiseEstimator()
{
  this->AddOptionalInputName("Mask", 1);
  this->SetNumberOfRequiredOutputs(5);
  for (DataObjectPointerArraySizeType i = 0; i < 5; ++i)
  {
    this->ProcessObject::SetNthOutput(i, this->MakeOutput(i));
  }
}

template <typename TStack>
auto
SensorNoiseEstimator<TStack>::MakeOutput(DataObjectPointerArraySizeType index) -> DataObjectPointer
{
  switch (index)
  {
    case 0:
      return ReportObjectType::New().GetPointer();
    case 4:
      return MaskImageType::New().GetPointer();
    default:
      return FrameImageType::New().GetPointer();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetMethod(MethodEnum method)
{
  if (m_Method != method)
  {
    m_Method = method;
    this->Modified();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetMethod(const std::string & name)
{
  if (name != "published")
  {
    itkExceptionMacro("the method is \"" << name << "\"; expected published");
  }
  this->SetMethod(MethodEnum::Published);
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetRollingShutter(const std::string & name)
{
  try
  {
    this->SetRollingShutter(sensornoise::RollingShutterOf(name));
  }
  catch (const std::invalid_argument & error)
  {
    itkExceptionMacro("" << error.what());
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetRollingShutter(RollingShutterEnum mode)
{
  if (m_RollingShutter != mode)
  {
    m_RollingShutter = mode;
    this->Modified();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::VerifyInputInformation() const
{
  const MaskImageType * mask = this->GetMask();
  if (mask != nullptr && mask->GetLargestPossibleRegion() != this->GetFrameRegion())
  {
    itkExceptionMacro("the mask has the region " << mask->GetLargestPossibleRegion() << "but the frames have "
                                                 << this->GetFrameRegion());
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::GenerateOutputInformation()
{
  this->CopyFrameInformation(this->GetMean());
  this->CopyFrameInformation(this->GetVariance());
  this->CopyFrameInformation(this->GetCorrectedVariance());
  this->CopyFrameInformation(this->GetPixelUse());
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::EnlargeOutputRequestedRegion(DataObject *)
{
  this->GetMean()->SetRequestedRegionToLargestPossibleRegion();
  this->GetVariance()->SetRequestedRegionToLargestPossibleRegion();
  this->GetCorrectedVariance()->SetRequestedRegionToLargestPossibleRegion();
  this->GetPixelUse()->SetRequestedRegionToLargestPossibleRegion();
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::StartPasses()
{
  sensornoise::PublishedSettings settings;
  settings.level = m_Level;
  settings.brightQuantile = m_BrightQuantile;
  settings.darkQuantile = m_DarkQuantile;
  settings.rollingShutter = m_RollingShutter;
  settings.sigmaLines = m_RowSigma;
  settings.shutterAxis = m_ShutterAxis;
  settings.codes = sensornoise::MakeCodeSettings(m_BitDepth, m_ClipLow, m_ClipHigh, m_QuantisationStep);

  const auto                size = this->GetFrameRegion().GetSize();
  std::vector<std::uint8_t> userMask;
  if (const MaskImageType * mask = this->GetMask())
  {
    auto * whole = const_cast<MaskImageType *>(mask);
    whole->SetRequestedRegionToLargestPossibleRegion();
    whole->Update();
    userMask.assign(mask->GetBufferPointer(), mask->GetBufferPointer() + size[0] * size[1]);
  }
  m_Estimation = std::make_unique<sensornoise::PublishedMethod<PixelType>>(
    settings,
    sensornoise::FrameGeometry{ size[0], size[1], m_ShutterAxis },
    this->GetNumberOfFrames(),
    userMask,
    this->GetParallelFor());
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::ProcessFrames(unsigned int, const PixelType * frames, SizeValueType, SizeValueType count)
{
  m_Estimation->AddFrames(frames, count);
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::EndPass(unsigned int pass)
{
  m_Estimation->EndPass();
  if (pass + 1 == this->NumberOfPasses())
  {
    this->FillOutputs();
    m_Estimation.reset();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::FillOutputs()
{
  this->GetReportOutput()->Set(m_Estimation->GetReport());
  const auto fill = [](auto * image, const auto & values, auto missing) {
    image->SetBufferedRegion(image->GetLargestPossibleRegion());
    image->Allocate();
    if (values.empty())
    {
      image->FillBuffer(missing);
    }
    else
    {
      std::copy(values.begin(), values.end(), image->GetBufferPointer());
    }
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  fill(this->GetMean(), m_Estimation->GetMean(), nan);
  fill(this->GetVariance(), m_Estimation->GetVariance(), nan);
  fill(this->GetCorrectedVariance(), m_Estimation->GetCorrectedVariance(), nan);
  fill(this->GetPixelUse(), m_Estimation->GetPixelUse(), static_cast<unsigned char>(0));
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Method: Published" << std::endl;
  os << indent << "Level: " << m_Level << std::endl;
  os << indent << "BrightQuantile: " << m_BrightQuantile << std::endl;
  os << indent << "DarkQuantile: " << m_DarkQuantile << std::endl;
  os << indent << "RollingShutter: " << sensornoise::NameOf(m_RollingShutter) << std::endl;
  os << indent << "RowSigma: " << m_RowSigma << std::endl;
  os << indent << "ShutterAxis: " << m_ShutterAxis << std::endl;
  os << indent << "BitDepth: " << m_BitDepth << std::endl;
  os << indent << "ClipLow: " << m_ClipLow << std::endl;
  os << indent << "ClipHigh: " << m_ClipHigh << std::endl;
  os << indent << "QuantisationStep: " << m_QuantisationStep << std::endl;
}

} // namespace itk

#endif
