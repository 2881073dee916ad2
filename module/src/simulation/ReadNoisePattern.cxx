// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/ReadNoisePattern.h"

#include "simulation/Random.h"
#include "simulation/RandomStreams.h"
#include "simulation/SettingChecks.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

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

} // namespace sensornoise
