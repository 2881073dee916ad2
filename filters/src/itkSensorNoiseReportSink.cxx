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
#include "itkSensorNoiseReportSink.h"

#include "itkSensorNoiseErrors.h"
#include "report/StackReport.h"

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace itk
{

template <typename TStack>
SensorNoiseReportSink<TStack>::SensorNoiseReportSink()
{
  this->AddOptionalInputName("Mask", 1);
}

template <typename TStack>
void
SensorNoiseReportSink<TStack>::SetSourceRegion(SizeValueType x,
                                               SizeValueType y,
                                               SizeValueType width,
                                               SizeValueType height)
{
  m_Source.roi = { x, y, width, height };
  this->Modified();
}

template <typename TStack>
void
SensorNoiseReportSink<TStack>::SetSourceFrames(SizeValueType first, SizeValueType end)
{
  m_Source.frames = { first, end };
  this->Modified();
}

template <typename TStack>
void
SensorNoiseReportSink<TStack>::SetFramesHash(const std::string & sha256, SizeValueType files, SizeValueType bytes)
{
  m_FramesHash = WithItkErrors(this, [&] { return sensornoise::InputFilesOf(sha256, files, bytes); });
  this->Modified();
}

template <typename TStack>
std::optional<sensornoise::InputRecord>
SensorNoiseReportSink<TStack>::GetInputRecord() const
{
  if (m_FramesHash.sha256.empty())
  {
    return std::nullopt;
  }
  return sensornoise::InputRecord{ m_FramesHash, std::nullopt };
}

template <typename TStack>
void
SensorNoiseReportSink<TStack>::VerifyInputInformation() const
{
  const auto region = this->GetInput()->GetLargestPossibleRegion();
  WithItkErrors(this, [&] {
    sensornoise::RequireSelection(m_Source, { region.GetSize(0), region.GetSize(1) }, region.GetSize(2));
  });
  const MaskImageType * mask = this->GetMask();
  if (mask != nullptr && mask->GetLargestPossibleRegion() != this->GetFrameRegion())
  {
    itkExceptionMacro("the mask has the region " << mask->GetLargestPossibleRegion() << "but the frames have "
                                                 << this->GetFrameRegion());
  }
}

template <typename TStack>
std::vector<std::uint8_t>
SensorNoiseReportSink<TStack>::ReadMask() const
{
  auto * const mask = const_cast<MaskImageType *>(this->GetMask());
  if (mask == nullptr)
  {
    return {};
  }
  mask->SetRequestedRegionToLargestPossibleRegion();
  mask->Update();
  RequirePixels(mask, "the mask");
  return { mask->GetBufferPointer(), mask->GetBufferPointer() + this->GetFrameRegion().GetNumberOfPixels() };
}

template <typename TStack>
void
SensorNoiseReportSink<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "BitDepth: " << m_BitDepth << std::endl;
  os << indent << "ClipLow: " << m_ClipLow << std::endl;
  os << indent << "ClipHigh: " << m_ClipHigh << std::endl;
  os << indent << "QuantisationStep: " << m_QuantisationStep << std::endl;
  os << indent << "ExcessNoiseFactor: " << m_ExcessNoiseFactor << std::endl;
  if (const auto & roi = m_Source.roi)
  {
    os << indent << "SourceRegion: " << (*roi)[0] << ", " << (*roi)[1] << ", " << (*roi)[2] << ", " << (*roi)[3]
       << std::endl;
  }
  if (const auto & frames = m_Source.frames)
  {
    os << indent << "SourceFrames: " << frames->first << ", " << frames->second << std::endl;
  }
  os << indent << "FramesHash: " << m_FramesHash.sha256 << std::endl;
}

#define SensorNoise_INSTANTIATE(TPixel) template class SensorNoiseReportSink<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
