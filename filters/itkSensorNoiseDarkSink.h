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
#ifndef itkSensorNoiseDarkSink_h
#define itkSensorNoiseDarkSink_h

#include "itkSensorNoiseStackSink.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/moments/CodeSettings.h"
#include "sensornoise/moments/DarkDrift.h"
#include "sensornoise/moments/DarkFrames.h"
#include "sensornoise/moments/KnownOffset.h"
#include "sensornoise/moments/TemporalMoments.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace itk
{

/** \class SensorNoiseDarkSink
 * \brief Reads dark frames once, in chunks, for SensorNoiseEstimator: what a pipeline has no use for by itself.
 * \ingroup SensorNoise
 */
template <typename TStack>
class SensorNoiseDarkSink : public SensorNoiseStackSink<TStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseDarkSink);

  using Self = SensorNoiseDarkSink;
  using Superclass = SensorNoiseStackSink<TStack>;
  using Pointer = SmartPointer<Self>;
  using typename Superclass::PixelType;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseDarkSink";
  }

  /** Without outputs ProcessObject would do nothing. */
  void
  Update() override
  {
    this->UpdateOutputInformation();
    this->UpdateOutputData(nullptr);
  }

  /** Nonzero at the pixels to be used; empty (default): all. To be set before Update(). */
  void
  SetUsedPixels(std::vector<std::uint8_t> used)
  {
    m_UsedPixels = std::move(used);
    this->Modified();
  }

  /** Offset and read noise of the frames that were read, see sensornoise::MeasureDarkFrames(). */
  sensornoise::KnownOffset
  Measure(const sensornoise::CodeSettings & codes)
  {
    return sensornoise::MeasureDarkFrames<PixelType>(m_Moments, codes, m_UsedPixels, this->GetParallelFor(), m_Drift);
  }

protected:
  SensorNoiseDarkSink() = default;
  ~SensorNoiseDarkSink() override = default;

  unsigned int
  NumberOfPasses() const override
  {
    return 1;
  }
  void
  StartPasses() override
  {
    const SizeValueType pixels = this->GetFrameRegion().GetNumberOfPixels();
    m_Moments = sensornoise::TemporalMoments<PixelType>(pixels);
    m_Drift = sensornoise::DarkDrift(pixels, m_UsedPixels);
  }
  void
  ProcessFrames(unsigned int, const PixelType * frames, SizeValueType, SizeValueType count) override
  {
    const SizeValueType pixels = this->GetFrameRegion().GetNumberOfPixels();
    sensornoise::ForBlocks(pixels, this->GetParallelFor(), [&](std::size_t begin, std::size_t end) {
      m_Moments.AddFrames(frames, pixels, count, begin, end);
    });
    m_Moments.AdvanceFrames(count);
    m_Drift.AddFrames(frames, count, this->GetParallelFor());
  }
  void
  EndPass(unsigned int) override
  {}

private:
  std::vector<std::uint8_t>               m_UsedPixels;
  sensornoise::TemporalMoments<PixelType> m_Moments;
  sensornoise::DarkDrift                  m_Drift;
};

} // namespace itk

#endif
