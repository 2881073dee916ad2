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
#include "itkTemporalStatisticsImageFilter.h"

#include "sensornoise/Settings.h"
#include "moments/StackMaps.h"
#include "moments/TemporalMoments.h"
#include "itkSensorNoiseMapContainer.h"

#include <cstddef>
#include <memory>
#include <ostream>
#include <utility>

namespace itk
{

template <typename TStack>
struct TemporalStatisticsImageFilter<TStack>::Moments
{
  sensornoise::TemporalMoments<PixelType> sums;
};

template <typename TStack>
TemporalStatisticsImageFilter<TStack>::TemporalStatisticsImageFilter()
{
  this->SetNumberOfRequiredOutputs(3);
  for (DataObjectPointerArraySizeType i = 0; i < 3; ++i)
  {
    this->ProcessObject::SetNthOutput(i, this->MakeOutput(i));
  }
}

template <typename TStack>
TemporalStatisticsImageFilter<TStack>::~TemporalStatisticsImageFilter() = default;

template <typename TStack>
auto
TemporalStatisticsImageFilter<TStack>::MakeOutput(DataObjectPointerArraySizeType index) -> DataObjectPointer
{
  if (index == 2)
  {
    return MaskImageType::New().GetPointer();
  }
  return FrameImageType::New().GetPointer();
}

template <typename TStack>
void
TemporalStatisticsImageFilter<TStack>::GenerateOutputInformation()
{
  this->CopyFrameInformation(this->GetMean());
  this->CopyFrameInformation(this->GetVariance());
  this->CopyFrameInformation(this->GetValidMask());
}

template <typename TStack>
void
TemporalStatisticsImageFilter<TStack>::EnlargeOutputRequestedRegion(DataObject *)
{
  this->GetMean()->SetRequestedRegionToLargestPossibleRegion();
  this->GetVariance()->SetRequestedRegionToLargestPossibleRegion();
  this->GetValidMask()->SetRequestedRegionToLargestPossibleRegion();
}

template <typename TStack>
void
TemporalStatisticsImageFilter<TStack>::StartPasses()
{
  if (this->GetNumberOfFrames() < 2)
  {
    itkExceptionMacro("the stack has " << this->GetNumberOfFrames()
                                       << " frame(s); a temporal variance needs at least 2");
  }
  sensornoise::ValidateDnSettings(sensornoise::MakeDnSettings(m_BitDepth, m_ClipLow, m_ClipHigh, m_QuantisationStep));
  m_Moments = std::make_unique<Moments>(Moments{
    sensornoise::TemporalMoments<PixelType>(this->GetFrameRegion().GetNumberOfPixels(), this->GetParallelFor()) });
}

template <typename TStack>
void
TemporalStatisticsImageFilter<TStack>::ProcessFrames(unsigned int,
                                                     const PixelType * frames,
                                                     SizeValueType,
                                                     SizeValueType count)
{
  const SizeValueType pixels = this->GetFrameRegion().GetNumberOfPixels();
  sensornoise::ForBlocks(pixels, this->GetParallelFor(), [&](std::size_t begin, std::size_t end) {
    m_Moments->sums.AddFrames(frames, pixels, count, begin, end);
  });
  m_Moments->sums.AdvanceFrames(count);
}

template <typename TStack>
void
TemporalStatisticsImageFilter<TStack>::EndPass(unsigned int)
{
  auto maps = sensornoise::MakeStackMaps<PixelType>(
    std::move(m_Moments->sums),
    sensornoise::MakeDnSettings(m_BitDepth, m_ClipLow, m_ClipHigh, m_QuantisationStep),
    this->GetParallelFor());
  m_Moments.reset();
  m_Summary = maps.summary;
  GiveToImage(this->GetMean(), std::move(maps.mean));
  GiveToImage(this->GetVariance(), std::move(maps.variance));
  GiveToImage(this->GetValidMask(), std::move(maps.valid));
}

template <typename TStack>
void
TemporalStatisticsImageFilter<TStack>::DropPasses()
{
  m_Moments.reset();
}

template <typename TStack>
void
TemporalStatisticsImageFilter<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "BitDepth: " << m_BitDepth << std::endl;
  os << indent << "ClipLow: " << m_ClipLow << std::endl;
  os << indent << "ClipHigh: " << m_ClipHigh << std::endl;
  os << indent << "QuantisationStep: " << m_QuantisationStep << std::endl;
}

#define SensorNoise_INSTANTIATE(TPixel) template class TemporalStatisticsImageFilter<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
