// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FixedPattern.h"

#include "simulation/ColourFilters.h"
#include "simulation/GainPattern.h"
#include "simulation/Random.h"
#include "simulation/RandomStreams.h"
#include "simulation/ReadNoisePattern.h"

#include <algorithm>
#include <cstdint>

namespace sensornoise
{
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
