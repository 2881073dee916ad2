// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/GainEstimate.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Eigen.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "moments/DarkFrames.h"
#include "pixels/Constants.h"
#include "pixels/VarianceCurve.h"
#include "refined/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sensornoise
{

namespace
{
/** Offset [DN] and variance [DN^2] of the dark frames, with their standard errors. */
struct DarkPoint
{
  double offsetDn;
  double offsetErrorDn;
  double varianceDn2;
  double varianceErrorDn2;
};

/** Returns the point over the pixels that are used in the bright frames, if there are maps of the dark frames, else
 * over all pixels. */
DarkPoint
PointOf(const RefinedResults & found)
{
  const KnownOffset & dark = *found.settings.offset;
  DarkPoint point{ dark.valueDn, dark.standardErrorDn, dark.variance->valueDn2, dark.variance->standardErrorDn2 };
  if (dark.maps && dark.maps->usable.size() == found.variance.pixelUse.size())
  {
    double pixels = 0.0;
    double offset = 0.0;
    double variance = 0.0;
    for (std::size_t p = 0; p < dark.maps->usable.size(); ++p)
    {
      if (dark.maps->usable[p] != 0 && found.variance.pixelUse[p] == static_cast<std::uint8_t>(PixelUse::Used))
      {
        pixels += 1.0;
        offset += dark.maps->offsetDn[p];
        variance += dark.maps->varianceDn2[p];
      }
    }
    if (pixels > 0.0)
    {
      const double fewer = std::sqrt(static_cast<double>(dark.maps->usable.size()) / pixels);
      point = {
        offset / pixels, dark.standardErrorDn * fewer, variance / pixels, dark.variance->standardErrorDn2 * fewer
      };
    }
  }
  return point;
}

/** Adds the error by quantization to a variance that quantization hides: any smaller one may look like it. */
DarkPoint
AddHiddenNoise(DarkPoint point, double stepDn)
{
  const double hiddenDn2 = InCommon.hiddenVariance * stepDn * stepDn;
  if (point.varianceDn2 < hiddenDn2)
  {
    point.varianceErrorDn2 = std::hypot(point.varianceErrorDn2, hiddenDn2);
  }
  return point;
}

/** Moves the line towards the point, weighted by the errors of both. Returns their difference before that, in standard
 * deviations. */
double
MoveToPoint(GainEstimate & estimate, const DarkPoint & dark)
{
  VarianceLine &        line = estimate.line;
  const Eigen::Vector2d design(dark.offsetDn, 1.0);
  const double          difference = dark.varianceDn2 - line.intercept - line.gain * dark.offsetDn;
  const double          error = std::hypot(dark.varianceErrorDn2, estimate.scale * dark.offsetErrorDn);
  const double          own = design.dot(estimate.covariance * design);
  const double          expected = own + error * error;
  estimate.atOffset = DarkVariance{ line.intercept + line.gain * dark.offsetDn, std::sqrt(std::max(0.0, own)) };
  const Eigen::Vector2d step = estimate.covariance * design / expected;
  line.gain += step(0) * difference;
  line.intercept += step(1) * difference;
  estimate.covariance -= step * (estimate.covariance * design).transpose();
  return std::abs(difference) / std::sqrt(expected);
}

/** Gains of the levels, (V - sigma^2) / (mean - mu) [DN/e-]. */
struct LevelGains
{
  double mean{ 0.0 };
  double variance{ 0.0 };        ///< statistical variance of the mean
  double scatter{ 0.0 };         ///< standard deviation between levels, without statistical scatter
  double inverseSignalDn{ 0.0 }; ///< weighted mean of 1 / (mean - mu) [1/DN]: the gain falls by it with sigma^2

  /** Returns the covariance of gain and intercept of the line through \a dark with the mean gain. */
  Eigen::Matrix2d
  CovarianceOfLine(const DarkPoint & dark) const
  {
    // Derivatives of gain and intercept, sigma^2 - gain mu, by sigma^2, mu, and the variance of the levels.
    Eigen::Matrix<double, 2, 3> slopes;
    slopes.row(0) << -inverseSignalDn, mean * inverseSignalDn, 1.0;
    slopes.row(1) = -dark.offsetDn * slopes.row(0) + Eigen::RowVector3d(1.0, -mean, 0.0);
    const Eigen::Vector3d errors(dark.varianceErrorDn2, dark.offsetErrorDn, std::sqrt(variance));
    return slopes * errors.cwiseAbs2().asDiagonal() * slopes.transpose();
  }
};

LevelGains
GainsOfLevels(const VarianceCurve & curve, const DarkPoint & dark)
{
  const double brightestDn = curve.bins.empty() ? 0.0 : curve.LevelOf(curve.bins.back());
  double       weight = 0.0, sum = 0.0, squares = 0.0, levels = 0.0, inverse = 0.0;
  for (const CurveBin & bin : curve.bins)
  {
    const double level = curve.LevelOf(bin);
    const double signal = level - dark.offsetDn;
    if (signal > InCommon.darkFraction * (brightestDn - dark.offsetDn))
    {
      const double own = curve.VarianceOf(bin);
      const double gain = (own - dark.varianceDn2) / signal;
      const double w = bin.weight * signal * signal;
      weight += w;
      sum += w * gain;
      squares += w * gain * gain;
      inverse += w / signal;
      levels += 1.0;
    }
  }
  LevelGains gains;
  if (weight > 0.0)
  {
    gains.mean = sum / weight;
    gains.variance = 1.0 / weight;
    gains.inverseSignalDn = inverse / weight;
    // The scatter is significant if chi-square exceeds its expectation by two standard deviations.
    const double dof = std::max(1.0, levels - 1.0);
    const double chi2 = squares - sum * gains.mean;
    const double more = chi2 - dof - Significance.hint * std::sqrt(2.0 * dof);
    gains.scatter = std::sqrt(std::max(0.0, more / weight));
  }
  return gains;
}
} // namespace

void
CombineWithDarkPoint(GainEstimate & estimate, const RefinedResults & found)
{
  const DarkPoint dark = AddHiddenNoise(PointOf(found), found.scene.summary.dnRange.quantisationStepDn);
  // Smaller deviations from the line do not explain a difference, but are in its error.
  const bool         isNonlinear = estimate.IsCurved();
  const GainEstimate before = estimate;
  if (!isNonlinear)
  {
    estimate.covariance += SlopeCovariance(0.5 * (estimate.below + estimate.above), estimate.line.pivotDn);
  }
  const double contradiction = MoveToPoint(estimate, dark);
  const auto   atOffset = estimate.atOffset;
  const bool   isFar = estimate.curve.DarkestFraction(dark.offsetDn) > InCommon.darkFraction;
  // The slope of levels that are alike is extrapolated to the dark level. Only if its error is below what counts, it
  // tests response and dark level.
  const double counts = before.isWide ? InRefined.largestNonlinearity : InPixels.leastDeviation;
  estimate.isLinearityTested = std::sqrt(before.covariance(0, 0)) < 0.5 * counts * std::abs(before.line.gain);
  const double difference = std::abs(dark.varianceDn2 - atOffset->valueDn2);
  if (!isNonlinear && contradiction > Significance.severalTests &&
      difference > InCommon.leastDarkDifference * std::max(dark.varianceDn2, std::abs(atOffset->valueDn2)))
  {
    estimate = before;
    estimate.atOffset = atOffset;
    estimate.isDarkRejected = true;
    return;
  }
  const LevelGains gains = GainsOfLevels(estimate.curve, dark);
  if (isNonlinear || isFar)
  {
    estimate.atOffset.reset(); // a non-linear response may explain the difference
  }
  if ((isNonlinear || contradiction > Significance.hint) && gains.mean > 0.0)
  {
    estimate.line.gain = gains.mean;
    estimate.line.intercept = dark.varianceDn2 - gains.mean * dark.offsetDn;
    estimate.covariance = gains.CovarianceOfLine(dark);
    estimate.below = estimate.above = gains.scatter;
    if (!isNonlinear)
    {
      const double fraction = SizeBeyondChance(1.0, 1.0 / (contradiction * contradiction), Significance.hint);
      estimate.covariance += SlopeCovariance(fraction * (before.line.gain - gains.mean), estimate.line.pivotDn);
      estimate.darkDifferenceDn2 = fraction * difference;
    }
  }
}

} // namespace sensornoise
