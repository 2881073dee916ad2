// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/GainPattern.h"

#include "simulation/Random.h"
#include "simulation/RandomStreams.h"
#include "simulation/SettingChecks.h"

#include <algorithm>
#include <numeric>

namespace sensornoise
{
namespace
{
/** Returns \a count normal numbers with mean \a mean and standard deviation \a sd. */
std::vector<double>
DrawNormal(std::uint64_t seed, FixedPatternKind kind, std::size_t count, double mean, double sd)
{
  CounterSeededRandom random(seed, StreamNumber(RandomStream::FixedPattern), static_cast<std::uint64_t>(kind));
  std::vector<double> values(count);
  std::generate(values.begin(), values.end(), [&] { return mean + sd * random.Normal(); });
  return values;
}

void
DivideByMean(std::vector<double> & values)
{
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  std::for_each(values.begin(), values.end(), [mean](double & value) { value /= mean; });
}

void
RequireRelativeSd(double sd, const char * name)
{
  // Beyond it, a normal number may be near -1, and a pixel would have no gain.
  RequireSetting(sd >= 0.0 && sd < 0.2, name, sd, "0 or more and below 0.2");
}
} // namespace

void
CheckSettings(const PatternSettings & settings)
{
  RequireRelativeSd(settings.gainSd, "spread of the pixels' gain");
  RequireRelativeSd(settings.columnGainSd, "spread of the columns' gain");
  RequireRelativeSd(settings.columnEfficiencySd, "spread of the columns' efficiency");
  RequireNotNegative(settings.columnOffsetSdDn, "spread of the columns' offset");
}

std::vector<double>
DrawGainPattern(const PatternSettings & settings, std::uint64_t seed, std::size_t width, std::size_t height)
{
  if (settings.gainSd == 0.0 && settings.columnGainSd == 0.0)
  {
    return {};
  }
  std::vector<double>       gain = DrawNormal(seed, FixedPatternKind::Gain, width * height, 1.0, settings.gainSd);
  const std::vector<double> ofColumn =
    DrawNormal(seed, FixedPatternKind::ColumnGain, width, 1.0, settings.columnGainSd);
  for (std::size_t pixel = 0; pixel < gain.size(); ++pixel)
  {
    gain[pixel] *= ofColumn[pixel % width];
  }
  DivideByMean(gain);
  return gain;
}

std::vector<double>
DrawColumnEfficiency(const PatternSettings & settings, std::uint64_t seed, std::size_t width)
{
  if (settings.columnEfficiencySd == 0.0)
  {
    return {};
  }
  std::vector<double> efficiency =
    DrawNormal(seed, FixedPatternKind::ColumnEfficiency, width, 1.0, settings.columnEfficiencySd);
  DivideByMean(efficiency);
  return efficiency;
}

std::vector<double>
DrawColumnOffsetDn(const PatternSettings & settings, std::uint64_t seed, std::size_t width)
{
  return settings.columnOffsetSdDn == 0.0
           ? std::vector<double>{}
           : DrawNormal(seed, FixedPatternKind::ColumnOffset, width, 0.0, settings.columnOffsetSdDn);
}

} // namespace sensornoise
