// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameProcessing.h"

#include "sensornoise/Simulator.h"
#include "simulation/SimulatedSensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
/** The pixels that surround a pixel, sorted by value. */
struct Neighbourhood
{
  std::array<double, 8> values{};
  std::size_t           count{ 0 };

  Neighbourhood(const DoubleFrame & frame, std::size_t centreX, std::size_t centreY)
  {
    const std::size_t endX = std::min(centreX + 2, frame.width);
    const std::size_t endY = std::min(centreY + 2, frame.height);
    for (std::size_t y = centreY > 0 ? centreY - 1 : 0; y < endY; ++y)
    {
      for (std::size_t x = centreX > 0 ? centreX - 1 : 0; x < endX; ++x)
      {
        if (x != centreX || y != centreY)
        {
          values[count++] = frame.Row(y)[x];
        }
      }
    }
    std::sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
  }
  double
  Median() const
  {
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
  }
  double
  Sd() const
  {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < count; ++i)
    {
      sum += values[i];
    }
    const double mean = sum / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      squares += (values[i] - mean) * (values[i] - mean);
    }
    return std::sqrt(squares / static_cast<double>(count - 1));
  }
};
} // namespace

void
CheckSettings(const DefectCorrectionSettings & settings)
{
  RequireNotNegative(settings.thresholdSd, "threshold of the defect correction");
}

DoubleFrame
CorrectDefects(const DoubleFrame & valuesDn, const DefectCorrectionSettings & settings, const ParallelFor & parallelFor)
{
  DoubleFrame out = valuesDn;
  parallelFor(valuesDn.height, [&](std::size_t y) {
    for (std::size_t x = 0; x < valuesDn.width; ++x)
    {
      const Neighbourhood around(valuesDn, x, y);
      if (around.count >= 2 && std::abs(valuesDn.Row(y)[x] - around.Median()) > settings.thresholdSd * around.Sd())
      {
        out.Row(y)[x] = around.Median();
      }
    }
  });
  return out;
}

void
CheckSettings(const TemporalFilterSettings & settings)
{
  RequireSetting(settings.weight >= 0.0 && settings.weight <= 0.99,
                 "weight of the last frame in the temporal filter",
                 settings.weight,
                 "0 to 0.99");
}

TemporalFilter::TemporalFilter(const TemporalFilterSettings & settings)
  : m_Weight(settings.weight)
{}

DoubleFrame
TemporalFilter::OutputFrame(std::size_t frame, const InputFrame & inputOf, const ParallelFor & parallelFor)
{
  std::shared_ptr<const State> last;
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    last = m_Last;
  }
  const bool  goesOn = last && last->frame <= frame;
  std::size_t t = goesOn ? last->frame : 0;
  DoubleFrame output = goesOn ? last->output : inputOf(0);
  while (t < frame)
  {
    const DoubleFrame input = inputOf(++t);
    parallelFor(output.height, [&](std::size_t y) {
      for (std::size_t x = 0; x < output.width; ++x)
      {
        output.Row(y)[x] = (1.0 - m_Weight) * input.Row(y)[x] + m_Weight * output.Row(y)[x];
      }
    });
  }
  const auto                        state = std::make_shared<const State>(State{ frame, output });
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_Last = state;
  return output;
}

void
CheckSettings(const MedianSettings & settings)
{
  RequireSetting(settings.radiusPixels <= 10, "radius of the median filter", settings.radiusPixels, "0 to 10 pixels");
}

DoubleFrame
FilterByMedian(const DoubleFrame & valuesDn, const MedianSettings & settings, const ParallelFor & parallelFor)
{
  const auto  radius = static_cast<std::ptrdiff_t>(settings.radiusPixels);
  const auto  lastX = static_cast<std::ptrdiff_t>(valuesDn.width) - 1;
  const auto  lastY = static_cast<std::ptrdiff_t>(valuesDn.height) - 1;
  DoubleFrame out(valuesDn.width, valuesDn.height);
  parallelFor(valuesDn.height, [&](std::size_t y) {
    std::vector<double> square;
    for (std::ptrdiff_t x = 0; x <= lastX; ++x)
    {
      square.clear();
      for (std::ptrdiff_t dy = -radius; dy <= radius; ++dy)
      {
        const auto     row = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(y) + dy, 0, lastY);
        const double * sourceDn = valuesDn.Row(static_cast<std::size_t>(row));
        for (std::ptrdiff_t dx = -radius; dx <= radius; ++dx)
        {
          square.push_back(sourceDn[std::clamp<std::ptrdiff_t>(x + dx, 0, lastX)]);
        }
      }
      const auto middle = square.begin() + static_cast<std::ptrdiff_t>(square.size() / 2);
      std::nth_element(square.begin(), middle, square.end());
      out.Row(y)[x] = *middle;
    }
  });
  return out;
}

void
CheckSettings(const SmoothingSettings & settings)
{
  RequireSetting(settings.sdPixels >= 0.0 && settings.sdPixels <= 100.0,
                 "smoothing in the camera",
                 settings.sdPixels,
                 "0 to 100 pixels");
}

DoubleFrame
SmoothFrame(DoubleFrame valuesDn, const SmoothingSettings & settings, const ParallelFor & parallelFor)
{
  valuesDn.values = GaussianBlur(valuesDn.values, valuesDn.width, valuesDn.height, settings.sdPixels, parallelFor);
  return valuesDn;
}

DoubleFrame
MoveCharge(DoubleFrame charge, const SensorFlaws & flaws, const ParallelFor & parallelFor)
{
  if (flaws.brighterFatter.IsOn())
  {
    charge = SpreadCharge(charge, flaws.brighterFatter, parallelFor);
  }
  if (flaws.coupling.IsOn())
  {
    charge = CoupleCharge(charge, flaws.coupling, parallelFor);
  }
  return charge;
}

DoubleFrame
ProcessBeforeTemporalFilter(DoubleFrame valuesDn, const SensorFlaws & flaws, const ParallelFor & parallelFor)
{
  if (flaws.defectCorrection.IsOn())
  {
    valuesDn = CorrectDefects(valuesDn, flaws.defectCorrection, parallelFor);
  }
  return valuesDn;
}

DoubleFrame
ProcessAfterTemporalFilter(DoubleFrame         valuesDn,
                           const SensorFlaws & flaws,
                           unsigned int        bitDepth,
                           const ParallelFor & parallelFor)
{
  if (flaws.median.IsOn())
  {
    valuesDn = FilterByMedian(valuesDn, flaws.median, parallelFor);
  }
  if (flaws.smoothing.IsOn())
  {
    valuesDn = SmoothFrame(std::move(valuesDn), flaws.smoothing, parallelFor);
  }
  if (flaws.binning.IsOn())
  {
    valuesDn = BinFrame(valuesDn, flaws.binning, parallelFor);
  }
  if (flaws.resampling.IsOn())
  {
    valuesDn = ResampleFrame(valuesDn, flaws.resampling, parallelFor);
  }
  if (flaws.blocks.IsOn())
  {
    valuesDn = QuantiseBlocks(valuesDn, StepsOfQuality(flaws.blocks, bitDepth), parallelFor);
  }
  return valuesDn;
}

} // namespace sensornoise
