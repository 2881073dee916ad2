// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/DefectCorrection.h"

#include "simulation/SettingChecks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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
CorrectDefects(const DoubleFrame & codesDn, const DefectCorrectionSettings & settings, const ParallelFor & parallelFor)
{
  DoubleFrame out = codesDn;
  parallelFor(codesDn.height, [&](std::size_t y) {
    for (std::size_t x = 0; x < codesDn.width; ++x)
    {
      const Neighbourhood around(codesDn, x, y);
      if (around.count >= 2 && std::abs(codesDn.Row(y)[x] - around.Median()) > settings.thresholdSd * around.Sd())
      {
        out.Row(y)[x] = around.Median();
      }
    }
  });
  return out;
}

} // namespace sensornoise
