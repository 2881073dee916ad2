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
#ifndef sensornoise_simulation_Simulator_h
#define sensornoise_simulation_Simulator_h

#include "sensornoise/simulation/Random.h"
#include "sensornoise/simulation/Scenes.h"
#include "sensornoise/simulation/SimulationSettings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class StackSimulator
 * A burst of frames of a static scene with known noise: equation (2.1) of Sur and Grediac 2015
 * (DOI 10.1137/140977035), as in their section 4.2,
 *
 *   u(x, y, t) = g Poisson((1 + gamma_t) p(x + alpha_t, y + beta_t)) + Normal(mu, sigma^2)   [DN]
 *
 * with p the reference image, blurred and then scaled to [0, electrons] (a constant image: `electrons` everywhere),
 * interpolated linearly with edge pixels replicated. A rate below 0 counts as 0. Flaws of a real sensor can be added:
 * rolling shutter, saturation and floor, PRNU, DSNU and hot pixels (SimulationSettings).
 *
 * A row is a pure function of (settings, frame, row): rows may be drawn in any order and by any number of threads. The
 * simulator holds one frame of doubles (a second and third for PRNU and DSNU, a fourth for hot pixels), never the
 stack.
 *
   \code
   const StackSimulator simulator(MakeTargetScene(512, 512), 512, 512, SimulationSettings{});
   std::vector<unsigned short> row(512);
   simulator.RenderRow(0, 100, row.data()); // row 100 of frame 0
   \endcode
 */
class StackSimulator
{
public:
  /** \param reference image, row after row, any range
   * \param width columns
   * \param height rows
   * \throws std::invalid_argument if the settings, the size or a reference value cannot be used. */
  StackSimulator(const std::vector<double> & reference,
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

  std::size_t
  GetWidth() const
  {
    return m_Width;
  }

  std::size_t
  GetHeight() const
  {
    return m_Height;
  }

  const SimulationTruth &
  GetTruth() const
  {
    return m_Truth;
  }

  /** Expected electrons of row `y` of frame `frame`: (1 + gamma) p(x + alpha, y + beta), with PRNU, cut at 0.
   * `electrons` has room for one row. */
  void
  ExpectedElectronsRow(std::size_t frame, std::size_t y, double * electrons) const
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

  /** Draws row `y` of frame `frame` into `out`, which has room for one row [DN].
   *
   * Integer pixels are rounded to the nearest code and clipped to [max(0, clipLowDn), min(2^bitDepth - 1, clipHighDn)]
   * (bit depth 0: to the range of the type). Floating-point pixels are neither rounded nor clipped, unless a clip level
   * is set.
   * \throws std::invalid_argument if the bit depth does not fit in the type. */
  template <typename TPixel>
  void
  RenderRow(std::size_t frame, std::size_t y, TPixel * out) const
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

  /** Lowest and highest value [DN] that a pixel of type TPixel takes under these settings.
   * \throws std::invalid_argument if the bit depth does not fit in the type, or no code is left. */
  template <typename TPixel>
  static std::pair<double, double>
  CodeRange(const SimulationSettings & settings)
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

private:
  static constexpr std::uint64_t PixelStream = 2;
  static constexpr std::uint64_t FixedPatternStream = 3;

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

  /** What differs from pixel to pixel and stays the same from frame to frame; a map is empty where nothing differs. */
  void
  DrawFixedPattern()
  {
    const SimulationSettings & settings = m_Truth.settings;
    const auto                 draw = [&](std::vector<double> & map, std::uint64_t kind, bool isNeeded, auto valueOf) {
      CounterSeededRandom random(settings.seed, FixedPatternStream, kind);
      map.resize(isNeeded ? m_Electrons.size() : 0);
      std::generate(map.begin(), map.end(), [&] { return valueOf(random); });
    };
    draw(m_Response, 0, settings.prnuSd > 0.0, [&](auto & random) { return 1.0 + settings.prnuSd * random.Normal(); });
    draw(
      m_DarkSignalDn, 1, settings.dsnuSdDn > 0.0, [&](auto & random) { return settings.dsnuSdDn * random.Normal(); });
    draw(m_ReadNoiseDn, 2, settings.hotPixelFraction > 0.0, [&](auto & random) {
      const bool isHot = random.Uniform() < settings.hotPixelFraction;
      return settings.camera.readNoiseDn * (isHot ? settings.hotPixelNoiseFactor : 1.0);
    });
  }

  std::size_t         m_Width;
  std::size_t         m_Height;
  SimulationTruth     m_Truth;
  std::vector<double> m_Electrons;
  std::vector<double> m_Response;
  std::vector<double> m_DarkSignalDn;
  std::vector<double> m_ReadNoiseDn;
};

} // namespace sensornoise

#endif // sensornoise_simulation_Simulator_h
