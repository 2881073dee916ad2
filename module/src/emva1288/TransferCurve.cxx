// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/TransferCurve.h"

#include "base/Text.h"
#include "emva1288/Constants.h"
#include "emva1288/DarkLevels.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

namespace sensornoise
{

namespace
{
/** Returns whether a pair of the same exposure is in the list, in place of this longer series. */
bool
HasPairOf(const EmvaSeries & series, const std::vector<EmvaSeries> & all)
{
  return series.frames > 2 && std::any_of(all.begin(), all.end(), [&series](const EmvaSeries & other) {
           return !other.isDark && other.frames == 2 && other.exposure == series.exposure &&
                  other.photons == series.photons;
         });
}

EmvaPoint
PointOf(const EmvaSeries & series, const DarkLevels & darkLevels)
{
  const DarkLevels::Level dark = darkLevels.At(series.exposure);
  EmvaPoint               point;
  point.exposure = series.exposure;
  point.photons = series.photons;
  point.frames = series.frames;
  point.meanDn = series.meanDn;
  point.signalDn = series.meanDn - dark.meanDn;
  point.varianceDn2 = series.temporalVarianceDn2;
  point.excessDn2 = series.temporalVarianceDn2 - dark.varianceDn2;
  point.snr = series.temporalVarianceDn2 > 0.0 ? point.signalDn / std::sqrt(series.temporalVarianceDn2) : 0.0;
  return point;
}

/** Returns whether so many values of the series are at the end of the range of digital numbers as at saturation. */
bool
IsSaturated(const EmvaSeries & series, unsigned int bitDepth)
{
  const double top = bitDepth > 0 ? std::ldexp(1.0, static_cast<int>(bitDepth)) - 1.0 : series.highestDn;
  return series.highestDn >= top && series.fractionAtHighest >= InEmva.leastSaturatedFraction;
}

/** Throws std::invalid_argument if the series have no temporal noise, or no signal. */
void
RequireSignal(const TransferCurve & curve)
{
  const EmvaPoint & saturation = curve.points[curve.saturation];
  if (!(saturation.varianceDn2 > 0.0))
  {
    throw std::invalid_argument("the frames of each flat exposure are equal, so that they have no temporal noise; "
                                "expected separate frames. List each frame once, and no copies.");
  }
  if (!(saturation.signalDn > 0.0))
  {
    throw std::invalid_argument(
      "the flat field with the largest variance, of the exposure " + Text(saturation.exposure) +
      ", has the mean level " + Text(saturation.meanDn) + " DN, which is " + Text(-saturation.signalDn) +
      " DN below the dark frames; expected brighter flat fields. Check which frames are dark.");
  }
}
} // namespace

TransferCurve
MakeTransferCurve(const std::vector<EmvaSeries> & series, const DarkLevels & dark, const EmvaSettings & settings)
{
  TransferCurve curve;
  for (const EmvaSeries & each : series)
  {
    if (!each.isDark && !HasPairOf(each, series))
    {
      curve.series.push_back(each);
    }
  }
  curve.hasPhotons = std::all_of(
    curve.series.begin(), curve.series.end(), [](const EmvaSeries & each) { return each.photons.has_value(); });
  const auto abscissa = [&curve](const EmvaSeries & each) { return curve.hasPhotons ? *each.photons : each.exposure; };
  std::stable_sort(curve.series.begin(), curve.series.end(), [&abscissa](const EmvaSeries & a, const EmvaSeries & b) {
    return abscissa(a) < abscissa(b);
  });
  std::set<double> different;
  for (const EmvaSeries & each : curve.series)
  {
    different.insert(abscissa(each));
    curve.points.push_back(PointOf(each, dark));
  }
  if (different.size() < InEmva.fewestPoints)
  {
    throw std::invalid_argument("the flat fields have " + std::to_string(different.size()) +
                                (different.size() == 1 ? " exposure" : " different exposures") +
                                "; expected 3 or more, from dark to saturation. The standard asks for 50.");
  }
  const auto largest = std::max_element(curve.points.begin(), curve.points.end(), [](const auto & a, const auto & b) {
    return a.varianceDn2 < b.varianceDn2;
  });
  curve.saturation = static_cast<std::size_t>(largest - curve.points.begin());
  RequireSignal(curve);
  curve.isSaturated =
    curve.saturation + 1 < curve.points.size() || IsSaturated(curve.series[curve.saturation], settings.bitDepth);
  for (EmvaPoint & point : curve.points)
  {
    point.isInGainFit = point.signalDn <= InEmva.gainRange * curve.SaturationSignalDn();
  }
  return curve;
}

} // namespace sensornoise
