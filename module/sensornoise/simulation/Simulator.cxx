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
#include "sensornoise/simulation/Simulator.h"

#include "sensornoise/simulation/Random.h"
#include "sensornoise/simulation/Scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace sensornoise
{
namespace
{
constexpr std::uint64_t PixelStream = 2;
constexpr std::uint64_t FixedPatternStream = 3;

/** Linear interpolation at position + shift along one axis, edge pixels replicated. */
class Shift
{
public:
  Shift(double shift, std::size_t size)
    : m_Last(static_cast<double>(size) - 1.0)
    , m_Whole(std::floor(shift))
    , m_Fraction(shift - m_Whole)
  {}
  std::size_t
  First(std::size_t position) const
  {
    return static_cast<std::size_t>(std::clamp(static_cast<double>(position) + m_Whole, 0.0, m_Last));
  }
  std::size_t
  Second(std::size_t position) const
  {
    return static_cast<std::size_t>(std::clamp(static_cast<double>(position) + m_Whole + 1.0, 0.0, m_Last));
  }
  double
  Blend(double first, double second) const
  {
    return first + m_Fraction * (second - first);
  }

private:
  double m_Last;
  double m_Whole;
  double m_Fraction;
};
} // namespace

StackSimulator::StackSimulator(const std::vector<double> & reference,
                               std::size_t                 width,
                               std::size_t                 height,
                               const SimulationSettings &  settings)
  : m_Width(width)
  , m_Height(height)
  , m_Truth(DrawTruth(settings, height))
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
  m_Electrons =
    ScaleToRange(GaussianBlur(reference, width, height, settings.opticalBlurPixels), 0.0, settings.camera.electrons);
  DrawFixedPattern();
}

void
StackSimulator::ExpectedElectronsRow(std::size_t frame, std::size_t y, double * electrons) const
{
  if (frame >= m_Truth.settings.frames || y >= m_Height)
  {
    throw std::invalid_argument("row " + std::to_string(y) + " of frame " + std::to_string(frame) +
                                " was asked for; expected a row below " + std::to_string(m_Height) +
                                " and a frame below " + std::to_string(m_Truth.settings.frames));
  }
  const Shift    vertical(m_Truth.series.beta[frame], m_Height);
  const Shift    horizontal(m_Truth.series.alpha[frame], m_Width);
  const double * above = m_Electrons.data() + vertical.First(y) * m_Width;
  const double * below = m_Electrons.data() + vertical.Second(y) * m_Width;
  const double   brightness = 1.0 + FlickerOfRow(m_Truth.settings, m_Truth.series, frame, y);
  for (std::size_t x = 0; x < m_Width; ++x)
  {
    const std::size_t left = horizontal.First(x);
    const std::size_t right = horizontal.Second(x);
    const double      rate =
      vertical.Blend(horizontal.Blend(above[left], above[right]), horizontal.Blend(below[left], below[right]));
    const double response = m_Response.empty() ? 1.0 : m_Response[y * m_Width + x];
    electrons[x] = std::max(0.0, rate * brightness * response);
  }
}

void
StackSimulator::DrawFixedPattern()
{
  const SimulationSettings & settings = m_Truth.settings;
  const auto                 draw = [&](std::vector<double> & map, std::uint64_t kind, bool isNeeded, auto valueOf) {
    CounterSeededRandom random(settings.seed, FixedPatternStream, kind);
    map.resize(isNeeded ? m_Electrons.size() : 0);
    std::generate(map.begin(), map.end(), [&] { return valueOf(random); });
  };
  draw(m_Response, 0, settings.prnuSd > 0.0, [&](auto & random) { return 1.0 + settings.prnuSd * random.Normal(); });
  draw(m_DarkSignalDn, 1, settings.dsnuSdDn > 0.0, [&](auto & random) { return settings.dsnuSdDn * random.Normal(); });
  draw(m_ReadNoiseDn, 2, settings.hotPixelFraction > 0.0, [&](auto & random) {
    const bool isHot = random.Uniform() < settings.hotPixelFraction;
    return settings.camera.readNoiseDn * (isHot ? settings.hotPixelNoiseFactor : 1.0);
  });
}

template <typename TPixel>
std::pair<double, double>
StackSimulator::CodeRange(const SimulationSettings & settings)
{
  static_assert(std::is_arithmetic_v<TPixel>, "a frame holds integer or floating-point numbers");
  using Limits = std::numeric_limits<TPixel>;
  double low = settings.clipLowDn.value_or(-std::numeric_limits<double>::infinity());
  double high = settings.clipHighDn.value_or(std::numeric_limits<double>::infinity());
  if constexpr (std::is_integral_v<TPixel>)
  {
    static_assert(Limits::digits <= 32, "codes of more than 32 bits are not represented exactly");
    const auto bits = static_cast<int>(settings.bitDepth);
    if (bits > Limits::digits)
    {
      throw std::invalid_argument("the bit depth is " + std::to_string(bits) + "; the pixel type holds at most " +
                                  std::to_string(Limits::digits) + " bits");
    }
    low = std::max(std::ceil(low), bits == 0 ? static_cast<double>(Limits::lowest()) : 0.0);
    high = std::min(std::floor(high), bits == 0 ? static_cast<double>(Limits::max()) : std::ldexp(1.0, bits) - 1.0);
    if (!(low < high))
    {
      throw std::invalid_argument("the clip levels leave the codes from " + std::to_string(low) + " to " +
                                  std::to_string(high) + "; expected at least two codes");
    }
  }
  return { low, high };
}

template <typename TPixel>
void
StackSimulator::RenderRow(std::size_t frame, std::size_t y, TPixel * out) const
{
  const auto          range = CodeRange<TPixel>(m_Truth.settings);
  const CameraModel & camera = m_Truth.settings.camera;
  CounterSeededRandom random(m_Truth.settings.seed, PixelStream, frame, y);
  std::vector<double> electrons(m_Width);
  ExpectedElectronsRow(frame, y, electrons.data());
  for (std::size_t x = 0; x < m_Width; ++x)
  {
    const std::size_t pixel = y * m_Width + x;
    const double      readNoiseDn = m_ReadNoiseDn.empty() ? camera.readNoiseDn : m_ReadNoiseDn[pixel];
    const double      offsetDn = camera.offsetDn + (m_DarkSignalDn.empty() ? 0.0 : m_DarkSignalDn[pixel]);
    const double      signalDn = camera.gainDnPerElectron * static_cast<double>(random.Poisson(electrons[x]));
    const double      valueDn = signalDn + offsetDn + readNoiseDn * random.Normal();
    if constexpr (std::is_integral_v<TPixel>)
    {
      out[x] = static_cast<TPixel>(std::clamp(std::floor(valueDn + 0.5), range.first, range.second));
    }
    else
    {
      out[x] = static_cast<TPixel>(std::clamp(valueDn, range.first, range.second));
    }
  }
}

template SensorNoise_EXPORT void
StackSimulator::RenderRow<unsigned char>(std::size_t, std::size_t, unsigned char *) const;
template SensorNoise_EXPORT void
StackSimulator::RenderRow<unsigned short>(std::size_t, std::size_t, unsigned short *) const;
template SensorNoise_EXPORT void
StackSimulator::RenderRow<short>(std::size_t, std::size_t, short *) const;
template SensorNoise_EXPORT void
StackSimulator::RenderRow<float>(std::size_t, std::size_t, float *) const;
template SensorNoise_EXPORT void
StackSimulator::RenderRow<double>(std::size_t, std::size_t, double *) const;

template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::CodeRange<unsigned char>(const SimulationSettings &);
template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::CodeRange<unsigned short>(const SimulationSettings &);
template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::CodeRange<short>(const SimulationSettings &);
template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::CodeRange<float>(const SimulationSettings &);
template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::CodeRange<double>(const SimulationSettings &);

} // namespace sensornoise
