// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FlickerSeries.h"

#include "base/Constants.h"
#include "report/Quantities.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

namespace
{
/** Returns why the standard deviation of \a flicker is not identifiable. */
FlickerFailure
FindFailure(const SeriesOfFlicker & flicker)
{
  const Quantity & sd = flicker.sd;
  // The noise of an unknown flicker may be large, but illumination that is off in most frames makes more than 1, too.
  const bool isLarge = sd.value && sd.standardError && *sd.standardError < InCommon.largestRelativeError * *sd.value;
  const bool isBelowOne = sd.interval95 && sd.interval95->high.value_or(2.0) < 1.0;
  if (!(flicker.scaleError > InCommon.largestRelativeError) && (isLarge || isBelowOne))
  {
    return FlickerFailure::None;
  }
  if (!std::isfinite(flicker.scaleError))
  {
    return FlickerFailure::UnknownOffset;
  }
  return flicker.scaleError > InCommon.largestRelativeError ? FlickerFailure::UncertainOffset
                                                            : FlickerFailure::NoiseOfFrames;
}
} // namespace

SeriesOfFlicker
EstimateFlicker(const RefinedResults & found, const UsedOffset & offset, double modelError)
{
  const double offsetFromCentre = offset.valueDn - found.scene.model.centreDn;
  OffsetLine   line = found.reestimated.line;
  line.UseOffset(offsetFromCentre);
  SeriesOfFlicker flicker;
  flicker.gamma = line.gamma;
  const auto   frames = static_cast<double>(line.gamma.size());
  const double noise = line.Widening() / line.precision;
  double       squares = 0.0;
  for (const double gamma : line.gamma)
  {
    squares += gamma * gamma;
  }
  const double variance = squares / (frames - 1.0) - noise;
  const double fromOffset = 2.0 * variance * std::hypot(line.sensitivity * offset.errorDn, modelError);
  const double ownError =
    2.0 * std::sqrt(std::max(0.0, variance) * noise / (frames - 1.0)) + noise * std::sqrt(2.0 / (frames - 1.0));
  flicker.sd = RootOf(variance, std::hypot(ownError, fromOffset));
  if (found.HasLocalIllumination() && !found.MayLocalIlluminationBeNoise())
  {
    const LocalFlicker & local = found.reestimated.localFlicker;
    const double         sd = local.Sd(offsetFromCentre);
    const double         step = 1.0 + offset.errorDn;
    const double         slope = (local.Sd(offsetFromCentre + step) - local.Sd(offsetFromCentre - step)) / (2.0 * step);
    const double         error = std::hypot(slope * offset.errorDn, sd * std::sqrt(noise), sd * modelError);
    flicker.sd = RootOf(sd * sd, 2.0 * sd * error);
  }
  flicker.scaleError = std::abs(line.sensitivity) * offset.errorDn;
  flicker.limit = flicker.sd.interval95;
  flicker.failure = FindFailure(flicker);
  if (flicker.failure != FlickerFailure::None)
  {
    flicker.sd = Quantity::Without(EstimateStatus::NotIdentifiable);
  }
  return flicker;
}

} // namespace sensornoise
