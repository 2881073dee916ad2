// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/ExpectedSignal.h"

#include "simulation/FixedPattern.h"
#include "simulation/FrameResampling.h"
#include "sensornoise/Simulator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sensornoise
{
namespace
{
void
RequireReference(const std::vector<double> & reference, std::size_t width, std::size_t height)
{
  if (width == 0 || height == 0 || reference.size() != width * height)
  {
    throw std::invalid_argument("the reference image has " + std::to_string(reference.size()) +
                                " values; expected width x height = " + std::to_string(width) + " x " +
                                std::to_string(height) + ", both at least 1");
  }
  if (!std::all_of(reference.begin(), reference.end(), [](double value) { return std::isfinite(value); }))
  {
    throw std::invalid_argument("the reference image holds a value that is not finite; expected finite values only");
  }
}
} // namespace

ExpectedSignal::ExpectedSignal(const std::vector<double> & reference,
                               std::size_t                 width,
                               std::size_t                 height,
                               const SimulationSettings &  settings)
  : m_Width(width)
  , m_Height(height)
  , m_IsDark(settings.isDark)
{
  RequireReference(reference, width, height);
  m_Electrons =
    ScaleToRange(GaussianBlur(reference, width, height, settings.opticalBlurPixels), 0.0, settings.camera.electrons);
  m_Efficiency = DrawEfficiency(settings, width, height);
}

void
ExpectedSignal::ExpectedElectronsRow(const SimulationTruth & truth,
                                     std::size_t             frame,
                                     std::size_t             y,
                                     double *                electrons) const
{
  if (m_IsDark)
  {
    std::fill_n(electrons, m_Width, 0.0);
    return;
  }
  const LinearShift vertical(truth.series.beta[frame], m_Height);
  const LinearShift horizontal(truth.series.alpha[frame], m_Width);
  const double *    above = m_Electrons.data() + vertical.First(y) * m_Width;
  const double *    below = m_Electrons.data() + vertical.Second(y) * m_Width;
  const double      brightness = 1.0 + FlickerOfRow(truth.settings, truth.series, frame, y);
  for (std::size_t x = 0; x < m_Width; ++x)
  {
    const std::size_t left = horizontal.First(x);
    const std::size_t right = horizontal.Second(x);
    const double      rate =
      vertical.Blend(horizontal.Blend(above[left], above[right]), horizontal.Blend(below[left], below[right]));
    const double efficiency = m_Efficiency.empty() ? 1.0 : m_Efficiency[y * m_Width + x];
    electrons[x] = std::max(0.0, rate * brightness * efficiency);
  }
}

double
ExpectedSignal::ElectronsAtRest(std::size_t pixel, double brightness) const
{
  const double efficiency = m_Efficiency.empty() ? 1.0 : m_Efficiency[pixel];
  return m_IsDark ? 0.0 : std::max(0.0, m_Electrons[pixel] * brightness * efficiency);
}

} // namespace sensornoise
