// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/SimulatedSensor.h"

#include "simulation/Random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace sensornoise
{

void
ApplyFilters(const ColourFilterSettings & settings,
             std::size_t                  width,
             std::size_t                  height,
             std::vector<double> &        efficiency)
{
  if (!settings.pattern)
  {
    return;
  }
  efficiency.resize(width * height, 1.0);
  for (const BayerPlane plane : BayerPlanes)
  {
    const double                     transmission = plane == BayerPlane::R   ? settings.transmissionR
                                                    : plane == BayerPlane::B ? settings.transmissionB
                                                                             : settings.transmissionG;
    const std::array<std::size_t, 2> corner = CornerOf(*settings.pattern, plane);
    for (std::size_t y = corner[1]; y < height; y += 2)
    {
      for (std::size_t x = corner[0]; x < width; x += 2)
      {
        efficiency[y * width + x] *= transmission;
      }
    }
  }
}

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
  RequireRelativeSd(settings.gainSd, "standard deviation of the pixels' gain");
  RequireRelativeSd(settings.columnGainSd, "standard deviation of the columns' gain");
  RequireRelativeSd(settings.columnEfficiencySd, "standard deviation of the columns' efficiency");
  RequireNotNegative(settings.columnOffsetSdDn, "standard deviation of the columns' offset");
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

void
CheckSettings(const ReadNoiseSettings & settings)
{
  RequireSetting(
    settings.spread >= 0.0 && settings.spread <= 3.0, "spread of the read noise", settings.spread, "0 to 3");
  RequireFraction(settings.tailFraction, "fraction of pixels in the read noise's tail");
  RequireSetting(settings.tailSpread >= 0.0 && settings.tailSpread <= 3.0,
                 "spread of the read noise's tail",
                 settings.tailSpread,
                 "0 to 3");
}

std::vector<double>
DrawReadNoisePattern(const ReadNoiseSettings & settings, std::uint64_t seed, std::size_t pixels)
{
  if (settings.spread == 0.0 && (settings.tailFraction == 0.0 || settings.tailSpread == 0.0))
  {
    return {};
  }
  CounterSeededRandom random(
    seed, StreamNumber(RandomStream::FixedPattern), static_cast<std::uint64_t>(FixedPatternKind::ReadNoise));
  std::vector<double> factors(pixels);
  std::generate(factors.begin(), factors.end(), [&] {
    // Three numbers per pixel for any settings: with a larger spread the same pixels have the larger noise.
    const double core = settings.spread * random.Normal();
    const double tail = settings.tailSpread * std::abs(random.Normal());
    const bool   isInTail = random.Uniform() < settings.tailFraction;
    return std::exp(core + (isInTail ? tail : 0.0));
  });
  return factors;
}

namespace
{
/** Returns valueOf(random) for every pixel; empty unless \a isNeeded. */
template <typename TFunction>
std::vector<double>
DrawMap(std::uint64_t seed, FixedPatternKind kind, std::size_t pixels, bool isNeeded, TFunction valueOf)
{
  CounterSeededRandom random(seed, StreamNumber(RandomStream::FixedPattern), static_cast<std::uint64_t>(kind));
  std::vector<double> map(isNeeded ? pixels : 0);
  std::generate(map.begin(), map.end(), [&] { return valueOf(random); });
  return map;
}

/** Replaces every pixel by combine(its value, the value of its column); an empty \a map stands for \a neutral
 * everywhere. */
template <typename TFunction>
void
CombineWithColumns(std::vector<double> &       map,
                   const std::vector<double> & ofColumn,
                   std::size_t                 pixels,
                   double                      neutral,
                   TFunction                   combine)
{
  if (ofColumn.empty())
  {
    return;
  }
  map.resize(pixels, neutral);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    map[pixel] = combine(map[pixel], ofColumn[pixel % ofColumn.size()]);
  }
}
} // namespace

std::vector<double>
DrawEfficiency(const SimulationSettings & settings, std::size_t width, std::size_t height)
{
  const std::size_t pixels = width * height;
  const double      sd = settings.prnuSd;
  auto              map = DrawMap(settings.seed, FixedPatternKind::Efficiency, pixels, sd > 0.0, [sd](auto & random) {
    return 1.0 + sd * random.Normal();
  });
  CombineWithColumns(map,
                     DrawColumnEfficiency(settings.flaws.pattern, settings.seed, width),
                     pixels,
                     1.0,
                     [](double ofPixel, double ofColumn) { return ofPixel * ofColumn; });
  ApplyFilters(settings.flaws.filters, width, height, map);
  return map;
}

std::vector<double>
DrawOffsetDn(const SimulationSettings & settings, std::size_t width, std::size_t height)
{
  const std::size_t pixels = width * height;
  const double      sdDn = settings.dsnuSdDn;
  auto              map = DrawMap(settings.seed, FixedPatternKind::Offset, pixels, sdDn > 0.0, [sdDn](auto & random) {
    return sdDn * random.Normal();
  });
  CombineWithColumns(map,
                     DrawColumnOffsetDn(settings.flaws.pattern, settings.seed, width),
                     pixels,
                     0.0,
                     [](double ofPixel, double ofColumn) { return ofPixel + ofColumn; });
  return map;
}

std::vector<double>
DrawReadNoiseDn(const SimulationSettings & settings, std::size_t width, std::size_t height)
{
  const std::size_t pixels = width * height;
  const double      fraction = settings.hotPixelFraction;
  const double      readNoiseDn = settings.camera.readNoiseDn;
  auto map = DrawMap(settings.seed, FixedPatternKind::HotPixels, pixels, fraction > 0.0, [&](auto & random) {
    const bool isHot = random.Uniform() < fraction;
    return readNoiseDn * (isHot ? settings.hotPixelNoiseFactor : 1.0);
  });
  const std::vector<double> factors = DrawReadNoisePattern(settings.flaws.readNoise, settings.seed, pixels);
  if (!factors.empty())
  {
    map.resize(pixels, readNoiseDn);
    std::transform(map.begin(), map.end(), factors.begin(), map.begin(), [](double a, double b) { return a * b; });
  }
  return map;
}

} // namespace sensornoise
