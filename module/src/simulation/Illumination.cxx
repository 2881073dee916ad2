// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/Illumination.h"

#include "base/Text.h"
#include "simulation/Random.h"
#include "simulation/SettingChecks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
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

} // namespace sensornoise
