// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/SimulatedSensor.h"

#include "base/Text.h"
#include "sensornoise/Simulator.h"
#include "simulation/FrameProcessing.h"
#include "simulation/Random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{

namespace
{
constexpr std::pair<const char *, IlluminationShape> NamedShapes[] = { { "steady", IlluminationShape::Steady },
                                                                       { "pulses", IlluminationShape::Pulses },
                                                                       { "ramp", IlluminationShape::Ramp },
                                                                       { "decay", IlluminationShape::Decay },
                                                                       { "sine", IlluminationShape::Sine },
                                                                       { "uniform", IlluminationShape::Uniform },
                                                                       { "exponential",
                                                                         IlluminationShape::Exponential } };

const auto *
FindShape(const std::string & text)
{
  const std::string name = text.substr(0, text.find(':'));
  return std::find_if(
    std::begin(NamedShapes), std::end(NamedShapes), [&](const auto & named) { return name == named.first; });
}

bool
HasPeriod(IlluminationShape shape)
{
  return shape == IlluminationShape::Pulses || shape == IlluminationShape::Sine;
}

/** Splits the text at colons, and returns the numbers after the first one. Throws std::invalid_argument if one is not a
 * number. */
std::vector<double>
NumbersOf(const std::string & text)
{
  std::vector<double> numbers;
  for (std::size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1))
  {
    const std::string word = text.substr(colon + 1, text.find(':', colon + 1) - colon - 1);
    std::size_t       used = 0;
    try
    {
      numbers.push_back(std::stod(word, &used));
    }
    catch (const std::logic_error &) // not a number, or out of range
    {
      used = std::string::npos;
    }
    if (used != word.size())
    {
      throw std::invalid_argument("the illumination \"" + text + "\" has \"" + word +
                                  "\" where a number is expected, as in pulses:0.3:4");
    }
  }
  return numbers;
}
} // namespace

bool
IsIlluminationName(const std::string & text)
{
  return FindShape(text) != std::end(NamedShapes);
}

IlluminationSettings
IlluminationOf(const std::string & text)
{
  const auto * named = FindShape(text);
  if (named == std::end(NamedShapes))
  {
    throw std::invalid_argument("the illumination is \"" + text +
                                "\"; expected steady, pulses, ramp, decay, sine, uniform or exponential, then the "
                                "lowest factor and the period in frames, as in pulses:0.3:4");
  }
  IlluminationSettings      illumination;
  const std::vector<double> numbers = NumbersOf(text);
  illumination.shape = named->second;
  const std::size_t most = HasPeriod(named->second) ? 2 : named->second == IlluminationShape::Steady ? 0 : 1;
  if (numbers.size() > most)
  {
    throw std::invalid_argument("the illumination \"" + text + "\" has " + std::to_string(numbers.size()) +
                                " numbers; expected at most " + std::to_string(most) + " after " + named->first);
  }
  illumination.low = !numbers.empty() ? numbers[0] : named->second == IlluminationShape::Decay ? 0.1 : 0.0;
  illumination.periodFrames = numbers.size() > 1 ? numbers[1] : illumination.periodFrames;
  return illumination;
}

std::string
TextOf(const IlluminationSettings & illumination)
{
  if (illumination.shape == IlluminationShape::Factors)
  {
    return "factors";
  }
  const auto * named = std::find_if(std::begin(NamedShapes), std::end(NamedShapes), [&](const auto & each) {
    return each.second == illumination.shape;
  });
  std::string  text = named->first;
  if (illumination.shape != IlluminationShape::Steady)
  {
    text += ":" + Text(illumination.low);
  }
  return HasPeriod(illumination.shape) ? text + ":" + Text(illumination.periodFrames) : text;
}

void
CheckSettings(const IlluminationSettings & illumination, std::size_t frames)
{
  RequireFraction(illumination.low, "lowest illumination factor");
  RequireSetting(illumination.shape != IlluminationShape::Decay || illumination.low > 0.0,
                 "lowest illumination factor",
                 illumination.low,
                 "above 0 for an exponential decay");
  RequireSetting(illumination.periodFrames >= 1.0 && illumination.periodFrames <= 1e9,
                 "period of the illumination",
                 illumination.periodFrames,
                 "1 to 1e9 frames");
  if (illumination.shape == IlluminationShape::Factors)
  {
    RequireSetting(illumination.factors.size() == frames,
                   "number of illumination factors",
                   static_cast<double>(illumination.factors.size()),
                   ("one for each of the " + std::to_string(frames) + " frames").c_str());
    for (const double factor : illumination.factors)
    {
      RequireNotNegative(factor, "illumination factor");
    }
  }
  double brightest = 0.0;
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    brightest = std::max(brightest, IlluminationFactor(illumination, frame, frames, 0));
  }
  RequireSetting(brightest > 0.0, "largest illumination factor", brightest, "a number above 0 in at least one frame");
}

double
IlluminationFactor(const IlluminationSettings & illumination, std::size_t frame, std::size_t frames, std::uint64_t seed)
{
  constexpr double    twoPi = 6.283185307179586476925;
  const double        low = illumination.low;
  const double        t = static_cast<double>(frame);
  const double        last = std::max(1.0, static_cast<double>(frames) - 1.0);
  CounterSeededRandom random(seed, StreamNumber(RandomStream::Illumination), frame);
  switch (illumination.shape)
  {
    case IlluminationShape::Pulses: {
      const auto period = static_cast<std::size_t>(std::lround(illumination.periodFrames));
      return frame % period == period - 1 ? 1.0 : low;
    }
    case IlluminationShape::Ramp:
      return low + (1.0 - low) * t / last;
    case IlluminationShape::Decay:
      return std::pow(low, t / last);
    case IlluminationShape::Sine:
      return low + (1.0 - low) * 0.5 * (1.0 + std::sin(twoPi * t / illumination.periodFrames));
    case IlluminationShape::Uniform:
      return low + (1.0 - low) * random.Uniform();
    case IlluminationShape::Exponential:
      return low - (1.0 - low) * std::log(random.Uniform());
    case IlluminationShape::Factors:
      return illumination.factors.at(frame);
    case IlluminationShape::Steady:
      break;
  }
  return 1.0;
}

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

namespace
{
/** Adds inflow(charge of the pixel, charge of the neighbour) to every pixel for each of its four neighbours; a pixel at
 * the edge has fewer. If inflow(a, b) = -inflow(b, a), the total charge of the frame is conserved. */
template <typename TInflow>
DoubleFrame
ExchangeWithNeighbours(const DoubleFrame & frame, const ParallelFor & parallelFor, TInflow inflow)
{
  DoubleFrame out(frame.width, frame.height);
  parallelFor(frame.height, [&](std::size_t y) {
    const double * row = frame.Row(y);
    for (std::size_t x = 0; x < frame.width; ++x)
    {
      double sum = row[x];
      sum += x > 0 ? inflow(row[x], row[x - 1]) : 0.0;
      sum += x + 1 < frame.width ? inflow(row[x], row[x + 1]) : 0.0;
      sum += y > 0 ? inflow(row[x], frame.Row(y - 1)[x]) : 0.0;
      sum += y + 1 < frame.height ? inflow(row[x], frame.Row(y + 1)[x]) : 0.0;
      out.Row(y)[x] = sum;
    }
  });
  return out;
}
} // namespace

void
CheckSettings(const BrighterFatterSettings & settings, double electrons)
{
  RequireNotNegative(settings.perElectron, "brighter-fatter coefficient");
  // A bright pixel among dark ones loses up to twice this fraction; beyond it the first order is not accurate.
  RequireSetting(settings.perElectron * electrons <= 0.1,
                 "brighter-fatter coefficient times the electrons of the brightest pixel",
                 settings.perElectron * electrons,
                 "at most 0.1");
}

DoubleFrame
SpreadCharge(const DoubleFrame & charge, const BrighterFatterSettings & settings, const ParallelFor & parallelFor)
{
  const double half = 0.5 * settings.perElectron;
  return ExchangeWithNeighbours(
    charge, parallelFor, [half](double own, double neighbour) { return half * (neighbour - own) * (neighbour + own); });
}

void
CheckSettings(const CouplingSettings & settings)
{
  // At 0.2 a pixel keeps no more charge than each of its neighbours receives.
  RequireSetting(
    settings.fraction >= 0.0 && settings.fraction <= 0.2, "coupling of charge", settings.fraction, "0 to 0.2");
}

DoubleFrame
CoupleCharge(const DoubleFrame & charge, const CouplingSettings & settings, const ParallelFor & parallelFor)
{
  const double fraction = settings.fraction;
  return ExchangeWithNeighbours(
    charge, parallelFor, [fraction](double own, double neighbour) { return fraction * (neighbour - own); });
}

} // namespace sensornoise
