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
#include "itkNoiseCorrelationEstimator.h"

#include "itkSensorNoiseErrors.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "correlation/FrameSample.h"
#include "sensornoise/Settings.h"
#include "correlation/NoiseCorrelation.h"
#include "moments/StackMaps.h"
#include "moments/TemporalMoments.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <type_traits>
#include <utility>
#include <vector>

namespace itk
{

/** Intermediate results of an update. */
template <typename TStack>
struct NoiseCorrelationEstimator<TStack>::Measurement
{
  sensornoise::CorrelationSettings        settings;
  sensornoise::TemporalMoments<PixelType> moments; ///< empty if mean and mask are given
  std::vector<double>                     mean;
  std::vector<std::uint8_t>               mask; ///< empty: not given
  sensornoise::FrameSample                sample;
};

template <typename TStack>
NoiseCorrelationEstimator<TStack>::NoiseCorrelationEstimator()
{
  this->AddOptionalInputName("Mean", 1);
  this->AddOptionalInputName("Mask", 2);
  this->SetNumberOfRequiredOutputs(1);
  this->ProcessObject::SetNthOutput(0, this->MakeOutput(0));
}

template <typename TStack>
NoiseCorrelationEstimator<TStack>::~NoiseCorrelationEstimator() = default;

template <typename TStack>
void
NoiseCorrelationEstimator<TStack>::AddSeries(const std::vector<double> & series)
{
  m_Series.push_back(series);
  this->Modified();
}

template <typename TStack>
void
NoiseCorrelationEstimator<TStack>::ClearSeries()
{
  if (!m_Series.empty())
  {
    m_Series.clear();
    this->Modified();
  }
}

template <typename TStack>
void
NoiseCorrelationEstimator<TStack>::VerifyInputInformation() const
{
  const auto verify = [this](const char * name, const ImageBase<2> * image) {
    if (image != nullptr && image->GetLargestPossibleRegion() != this->GetFrameRegion())
    {
      itkExceptionMacro("the " << name << " has the region " << image->GetLargestPossibleRegion()
                               << "but the frames have " << this->GetFrameRegion());
    }
  };
  verify("mean", this->GetMean());
  verify("mask", this->GetMask());
}

template <typename TStack>
unsigned int
NoiseCorrelationEstimator<TStack>::NumberOfPasses() const
{
  return this->GetMean() != nullptr && this->GetMask() != nullptr ? 1 : 2;
}

template <typename TStack>
void
NoiseCorrelationEstimator<TStack>::StartPasses()
{
  const SizeValueType pixels = this->GetFrameRegion().GetNumberOfPixels();
  const SizeValueType frames = this->GetNumberOfFrames();
  m_Measurement = std::make_unique<Measurement>();
  m_Measurement->settings.offsetDn = m_Offset;
  m_Measurement->settings.quantisationStepDn = m_QuantisationStep;
  m_Measurement->settings.series = m_Series;
  m_Measurement->settings.frameMeans = m_RemoveFrameMeans;
  m_Measurement->settings.Validate(frames);
  if (m_QuantisationStep == 0.0 && std::is_integral_v<PixelType>)
  {
    m_Measurement->settings.quantisationStepDn = 1.0;
  }
  // Mean and mask may depend on the same reader as the stack. Therefore they are updated before the stack is read.
  const auto pixelsOf = [pixels](const auto * image, auto & values) {
    if (image != nullptr)
    {
      auto * whole = const_cast<std::remove_const_t<std::remove_pointer_t<decltype(image)>> *>(image);
      whole->SetRequestedRegionToLargestPossibleRegion();
      whole->Update();
      values.assign(image->GetBufferPointer(), image->GetBufferPointer() + pixels);
    }
  };
  pixelsOf(this->GetMean(), m_Measurement->mean);
  pixelsOf(this->GetMask(), m_Measurement->mask);
  if (this->NumberOfPasses() == 2)
  {
    m_Measurement->moments = sensornoise::TemporalMoments<PixelType>(pixels);
  }
}

template <typename TStack>
void
NoiseCorrelationEstimator<TStack>::ProcessFrames(unsigned int      pass,
                                                 const PixelType * frames,
                                                 SizeValueType     first,
                                                 SizeValueType     count)
{
  const auto size = this->GetFrameRegion().GetSize();
  if (pass + 1 < this->NumberOfPasses())
  {
    this->GetParallelFor()(size[1], [&](std::size_t y) {
      m_Measurement->moments.AddFrames(frames, size[0] * size[1], count, y * size[0], (y + 1) * size[0]);
    });
    m_Measurement->moments.AdvanceFrames(count);
    return;
  }
  if (first == 0)
  {
    const sensornoise::FrameGeometry geometry{ size[0], size[1], 1 };
    m_Measurement->sample = sensornoise::FrameSample::Of<PixelType>(geometry, this->GetNumberOfFrames());
  }
  m_Measurement->sample.AddFrames(frames, first, count, m_Measurement->mean, this->GetParallelFor());
}

template <typename TStack>
void
NoiseCorrelationEstimator<TStack>::FindMeanAndMask()
{
  auto maps = sensornoise::MakeStackMaps<PixelType>(
    std::move(m_Measurement->moments),
    sensornoise::MakeDnSettings(0, std::nan(""), std::nan(""), m_QuantisationStep),
    this->GetParallelFor());
  m_Measurement->settings.quantisationStepDn = maps.summary.dnRange.quantisationStepDn;
  if (m_Measurement->mean.empty())
  {
    m_Measurement->mean = std::move(maps.mean);
  }
  std::vector<std::uint8_t> & valid = maps.valid;
  for (std::size_t p = 0; p < m_Measurement->mask.size(); ++p)
  {
    valid[p] = valid[p] != 0 && m_Measurement->mask[p] != 0 ? 1 : 0;
  }
  m_Measurement->mask = std::move(valid);
}

template <typename TStack>
void
NoiseCorrelationEstimator<TStack>::EndPass(unsigned int pass)
{
  if (pass + 1 < this->NumberOfPasses())
  {
    this->FindMeanAndMask();
    return;
  }
  const auto                       size = this->GetFrameRegion().GetSize();
  sensornoise::CorrelationEstimate estimate =
    sensornoise::EstimateCorrelation(m_Measurement->sample.TakeNoise(m_Measurement->mean, this->GetParallelFor()),
                                     m_Measurement->mean,
                                     m_Measurement->mask,
                                     m_Measurement->settings,
                                     this->GetParallelFor());
  estimate.width = size[0];
  estimate.height = size[1];
  estimate.frames = this->GetNumberOfFrames();
  this->GetResultOutput()->Set(std::move(estimate));
  m_Measurement.reset();
}

template <typename TStack>
void
NoiseCorrelationEstimator<TStack>::DropPasses()
{
  m_Measurement.reset();
}

template <typename TStack>
void
NoiseCorrelationEstimator<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfSeries: " << m_Series.size() << std::endl;
  os << indent << "RemoveFrameMeans: " << m_RemoveFrameMeans << std::endl;
  os << indent << "Offset: " << m_Offset << std::endl;
  os << indent << "QuantisationStep: " << m_QuantisationStep << std::endl;
}

#define SensorNoise_INSTANTIATE(TPixel) template class NoiseCorrelationEstimator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
