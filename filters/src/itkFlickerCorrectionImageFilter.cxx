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
#include "itkFlickerCorrectionImageFilter.h"

#include "itkSensorNoiseChunks.h"
#include "itkSensorNoiseErrors.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Settings.h"
#include "base/Constants.h"
#include "published/Flicker.h"
#include "published/PublishedScene.h"
#include "itkImageScanlineIterator.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>

namespace itk
{

template <typename TStack>
FlickerCorrectionImageFilter<TStack>::FlickerCorrectionImageFilter()
{
  this->AddRequiredInputName("Mean", 1);
  this->AddRequiredInputName("Variance", 2);
  this->AddRequiredInputName("Mask", 3);
  this->ProcessObject::SetOutput("Offset", this->MakeOutput("Offset"));
  this->DynamicMultiThreadingOn();
}

template <typename TStack>
DataObject::Pointer
FlickerCorrectionImageFilter<TStack>::MakeOutput(const ProcessObject::DataObjectIdentifierType & name)
{
  if (name == "Offset")
  {
    return OffsetDecoratorType::New().GetPointer();
  }
  return Superclass::MakeOutput(name);
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::SetRollingShutter(const std::string & name)
{
  this->SetRollingShutter(WithItkErrors(this, [&name] { return sensornoise::RollingShutterOf(name); }));
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::SetRollingShutter(RollingShutterEnum mode)
{
  if (m_RollingShutter != mode)
  {
    m_RollingShutter = mode;
    this->Modified();
  }
}

template <typename TStack>
sensornoise::FrameGeometry
FlickerCorrectionImageFilter<TStack>::GetGeometry() const
{
  const RegionType & stack = this->GetInput()->GetLargestPossibleRegion();
  return { stack.GetSize(0), stack.GetSize(1), m_ShutterAxis };
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::VerifyInputInformation() const
{
  const RegionType & stack = this->GetInput()->GetLargestPossibleRegion();
  const auto         verify = [this, &stack](const char * name, const ImageBase<2> * image) {
    const auto & region = image->GetLargestPossibleRegion();
    for (unsigned int d = 0; d < 2; ++d)
    {
      if (region.GetIndex(d) != stack.GetIndex(d) || region.GetSize(d) != stack.GetSize(d))
      {
        itkExceptionMacro("the " << name << " has the region " << region << "but the frames of the stack have "
                                 << stack);
      }
    }
  };
  verify("mean", this->GetMean());
  verify("variance", this->GetVariance());
  verify("mask", this->GetMask());
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  const_cast<FrameImageType *>(this->GetMean())->SetRequestedRegionToLargestPossibleRegion();
  const_cast<FrameImageType *>(this->GetVariance())->SetRequestedRegionToLargestPossibleRegion();
  const_cast<MaskImageType *>(this->GetMask())->SetRequestedRegionToLargestPossibleRegion();
}

template <typename TStack>
bool
FlickerCorrectionImageFilter<TStack>::IsEstimateUpToDate() const
{
  // An image with a source is modified with each chunk that is read. Therefore the time of its pipeline is compared.
  const auto timeOf = [](const DataObject * data) {
    return data->GetSource() ? data->GetPipelineMTime() : data->GetMTime();
  };
  const ModifiedTimeType newest = std::max({ this->GetMTime(),
                                             timeOf(this->GetInput()),
                                             timeOf(this->GetMean()),
                                             timeOf(this->GetVariance()),
                                             timeOf(this->GetMask()) });
  return m_EstimateTime.GetMTime() > newest;
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::UpdateStack(const RegionType & region)
{
  auto * stack = const_cast<StackType *>(this->GetInput());
  stack->SetRequestedRegion(region);
  stack->PropagateRequestedRegion();
  stack->UpdateOutputData();
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::EstimateFlicker()
{
  const StackType *                stack = this->GetInput();
  const RegionType                 whole = stack->GetLargestPossibleRegion();
  const sensornoise::FrameGeometry geometry = this->GetGeometry();
  const SizeValueType              frames = whole.GetSize(2);
  const SizeValueType              pixels = geometry.Pixels();
  if (frames < 3)
  {
    itkExceptionMacro("the stack has " << frames << " frame(s); flicker and offset need at least 3");
  }
  WithItkErrors(this, [&] {
    sensornoise::PublishedSettings settings;
    settings.brightQuantile = m_BrightQuantile;
    settings.darkQuantile = m_DarkQuantile;
    settings.rollingShutter = m_RollingShutter;
    settings.sigmaRows = m_SigmaRows;
    settings.shutterAxis = m_ShutterAxis;
    settings.Validate();

    const double * const                     mean = this->GetMean()->GetBufferPointer();
    const sensornoise::IsoIntensitySetFinder finder(
      mean, this->GetVariance()->GetBufferPointer(), this->GetMask()->GetBufferPointer(), pixels, frames);
    m_BrightSet = finder.Find(m_BrightQuantile);
    m_DarkSet = finder.Find(m_DarkQuantile);
    const bool                         byRow = m_RollingShutter != RollingShutterEnum::Off;
    const sensornoise::IsoIntensitySet rowSet = byRow ? finder.FindRowSet(m_BrightSet) : sensornoise::IsoIntensitySet();
    sensornoise::FlickerSums           sums(m_BrightSet, m_DarkSet, mean, geometry, frames, rowSet);

    const SizeValueType chunkFrames = SensorNoiseFramesPerChunk(pixels * sizeof(typename StackType::PixelType));
    const bool          isInMemory = stack->GetBufferedRegion() == whole;
    for (SizeValueType first = 0; first < frames; first += chunkFrames)
    {
      RegionType chunk = whole;
      chunk.SetIndex(2, whole.GetIndex(2) + static_cast<IndexValueType>(first));
      chunk.SetSize(2, std::min(chunkFrames, frames - first));
      if (!isInMemory || first == 0)
      {
        this->UpdateStack(isInMemory ? whole : chunk);
      }
      const auto * const buffer = stack->GetBufferPointer() + stack->ComputeOffset(chunk.GetIndex());
      this->GetMultiThreader()->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
      this->GetMultiThreader()->ParallelizeArray(
        0, chunk.GetSize(2), [&](SizeValueType k) { sums.AddFrame(buffer + k * pixels, first + k); }, nullptr);
    }
    m_Flicker = sensornoise::EstimateFlicker(sums, m_BrightSet, m_DarkSet, m_RollingShutter, m_SigmaRows);
  });
  m_EstimateTime.Modified();
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::GenerateData()
{
  if (!this->IsEstimateUpToDate())
  {
    this->EstimateFlicker();
  }
  const bool isIdentified = m_Flicker.flickerZ > sensornoise::Significance.everyPixel;
  this->GetOffsetOutput()->Set(isIdentified ? m_Flicker.offsetDn : std::numeric_limits<double>::quiet_NaN());

  // After the pass above, or after the update of the mean from the same reader, the stack holds another chunk.
  this->UpdateStack(this->GetOutput()->GetRequestedRegion());
  Superclass::GenerateData();
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::DynamicThreadedGenerateData(const RegionType & region)
{
  const StackType *      stack = this->GetInput();
  const FrameImageType * mean = this->GetMean();
  const RegionType &     whole = stack->GetLargestPossibleRegion();
  const double           offset = m_Flicker.offsetDn;

  ImageScanlineConstIterator<StackType>     in(stack, region);
  ImageScanlineIterator<CorrectedStackType> out(this->GetOutput(), region);
  for (; !in.IsAtEnd(); in.NextLine(), out.NextLine())
  {
    const auto     start = in.GetIndex();
    const auto     t = static_cast<std::size_t>(start[2] - whole.GetIndex(2));
    const auto     y = static_cast<std::size_t>(start[1] - whole.GetIndex(1));
    auto           x = static_cast<std::size_t>(start[0] - whole.GetIndex(0));
    const double * reference = mean->GetBufferPointer() + mean->ComputeOffset({ { start[0], start[1] } });
    for (; !in.IsAtEndOfLine(); ++in, ++out, ++reference, ++x)
    {
      const std::size_t row = m_ShutterAxis == 0 ? x : y;
      out.Set(m_Flicker.IsKnown(row)
                ? static_cast<double>(in.Get()) - (1.0 + m_Flicker.Gamma(t, row)) * (*reference - offset)
                : std::numeric_limits<double>::quiet_NaN());
    }
  }
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::UpdateOutputInformation()
{
  ResetAfterError(this, [this] { Superclass::UpdateOutputInformation(); });
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::UpdateOutputData(DataObject * output)
{
  if (this->m_Updating)
  {
    return;
  }
  // The offset alone needs no corrected frame. With the whole region an update of the offset would compute the stack.
  const RegionType requested = this->GetOutput()->GetRequestedRegion();
  if (output != this->GetOutput())
  {
    RegionType frame = this->GetOutput()->GetLargestPossibleRegion();
    frame.SetSize(2, 1);
    this->GetOutput()->SetRequestedRegion(frame);
    this->GenerateInputRequestedRegion();
  }
  try
  {
    ResetAfterError(this, [this, output] { Superclass::UpdateOutputData(output); });
  }
  catch (...)
  {
    this->GetOutput()->SetRequestedRegion(requested);
    throw;
  }
  this->GetOutput()->SetRequestedRegion(requested);
}

template <typename TStack>
void
FlickerCorrectionImageFilter<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "BrightQuantile: " << m_BrightQuantile << std::endl;
  os << indent << "DarkQuantile: " << m_DarkQuantile << std::endl;
  os << indent << "RollingShutter: " << sensornoise::NameOf(m_RollingShutter) << std::endl;
  os << indent << "SigmaRows: " << m_SigmaRows << std::endl;
  os << indent << "ShutterAxis: " << m_ShutterAxis << std::endl;
}

#define SensorNoise_INSTANTIATE(TPixel) template class FlickerCorrectionImageFilter<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
