// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/Exposures.h"

#include "base/ChiSquare.h"
#include "base/Eigen.h"
#include "base/Text.h"
#include "moments/Constants.h"
#include "moments/StackMaps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace sensornoise
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Levels = std::vector<ExposureLevel>;

constexpr const char * FallingLevels =
  "the levels do not rise with the exposures. Give the exposures in the order of the frames.";

/** A weighted polynomial through levels: its coefficients are operatorOnLevels * levels [DN per exposure^k]. */
struct WeightedFit
{
  MatrixXd columns;
  MatrixXd operatorOnLevels;

  /** \a scales are the signals to which the deviations are relative [DN]. Exposures in units of the largest one keep
   * the equations well conditioned. */
  WeightedFit(const Levels & levels, const VectorXd & scales, Index coefficients)
    : columns(scales.size(), coefficients)
  {
    const double unit = levels.back().exposure;
    for (Index i = 0; i < columns.rows(); ++i)
    {
      for (Index k = 0; k < coefficients; ++k)
      {
        columns(i, k) = std::pow(levels[static_cast<std::size_t>(i)].exposure / unit, static_cast<double>(k));
      }
    }
    const VectorXd inverse = scales.cwiseInverse();
    const MatrixXd relative = inverse.asDiagonal() * columns;
    operatorOnLevels = relative.colPivHouseholderQr().solve(MatrixXd(inverse.asDiagonal()));
    for (Index k = 0; k < coefficients; ++k)
    {
      operatorOnLevels.row(k) /= std::pow(unit, static_cast<double>(k));
      columns.col(k) *= std::pow(unit, static_cast<double>(k));
    }
  }
};

VectorXd
MeansOf(const Levels & levels)
{
  VectorXd means(static_cast<Index>(levels.size()));
  std::transform(levels.begin(), levels.end(), means.data(), [](const ExposureLevel & each) { return each.meanDn; });
  return means;
}

/** Returns the scales of the deviations in the fit [DN]: y, or the exposure where no dark offset was measured. The line
 * minus its own intercept is proportional to the exposure. */
VectorXd
ScalesOf(const Levels & levels, const std::optional<double> & darkDn)
{
  VectorXd scales(static_cast<Index>(levels.size()));
  std::transform(levels.begin(), levels.end(), scales.data(), [&](const ExposureLevel & each) {
    return darkDn ? each.meanDn - *darkDn : each.exposure;
  });
  return scales;
}

/** Range of levels in which the linearity error is measured. */
struct FitRange
{
  double saturationDn;
  bool   isClipLevel; ///< false: the largest level, which is not saturated

  double
  HighestDn(double offsetDn) const
  {
    return isClipLevel ? offsetDn + (1.0 - InMoments.linearityRangeLow) * (saturationDn - offsetDn) : saturationDn;
  }
  bool
  Holds(double meanDn, double offsetDn) const
  {
    return meanDn - offsetDn >= InMoments.linearityRangeLow * (saturationDn - offsetDn) &&
           meanDn <= this->HighestDn(offsetDn);
  }
};

Levels
LevelsWithin(const Levels & bright, const FitRange & range, double offsetDn)
{
  Levels within;
  std::copy_if(bright.begin(), bright.end(), std::back_inserter(within), [&](const ExposureLevel & each) {
    return range.Holds(each.meanDn, offsetDn);
  });
  return within;
}

/** Returns the levels within the range. Without dark frames the range depends on the offset, and the offset on the
 * levels: a few iterations make both consistent. */
Levels
FindLevels(const Levels & bright, const FitRange & range, const std::optional<double> & darkDn)
{
  if (darkDn)
  {
    return LevelsWithin(bright, range, *darkDn);
  }
  Levels levels;
  std::copy_if(bright.begin(), bright.end(), std::back_inserter(levels), [&](const ExposureLevel & each) {
    return each.meanDn <= range.HighestDn(0.0);
  });
  for (std::size_t round = 0; round < bright.size() && levels.size() >= 2; ++round)
  {
    const WeightedFit line(levels, ScalesOf(levels, darkDn), 2);
    const double      offsetDn = (line.operatorOnLevels * MeansOf(levels))(0);
    Levels            next = LevelsWithin(bright, range, offsetDn);
    if (next.size() == levels.size())
    {
      break;
    }
    levels = std::move(next);
  }
  return levels;
}

/** A variance and its degrees of freedom. */
struct Scatter
{
  double variance{ 0.0 }; ///< relative variance [1]
  double dof{ 0.0 };
};

/** Estimates the scatter of the illumination from frames of equal exposure, without the noise of the pixels. The mean
 * squares are weighted by their variances, which depend on the result. */
Scatter
ScatterOfRepeats(const Levels & levels, const VectorXd & signals)
{
  Scatter scatter;
  for (int round = 0; round < InMoments.roundsOfExposureScatter; ++round)
  {
    double sum = 0.0;
    double weights = 0.0;
    scatter.dof = 0.0;
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
      const double y2 = signals(static_cast<Index>(i)) * signals(static_cast<Index>(i));
      const double noise = levels[i].pixelNoiseDn2 / y2;
      const double dof = static_cast<double>(levels[i].frames) - 1.0;
      const double own = scatter.variance + noise;
      const double weight = own > 0.0 ? 1.0 / (own * own) : 1.0;
      sum += weight * (levels[i].squaresDn2 / y2 - dof * noise);
      weights += weight * dof;
      scatter.dof += dof;
    }
    scatter.variance = weights > 0.0 ? std::max(0.0, sum / weights) : 0.0;
  }
  return scatter;
}

/** Estimates the scatter from the deviations from a parabola, for stacks in which no exposure has two frames. This
 * scatter includes the noise of the pixels. */
Scatter
ScatterAboutParabola(const Levels & levels, const VectorXd & scales, const VectorXd & signals)
{
  const double dof = static_cast<double>(levels.size()) - 3.0;
  if (dof < 1.0)
  {
    return {};
  }
  const WeightedFit parabola(levels, scales, 3);
  const VectorXd    means = MeansOf(levels);
  const VectorXd    rest = means - parabola.columns * (parabola.operatorOnLevels * means);
  return { rest.cwiseQuotient(signals).squaredNorm() / dof, dof };
}

/** Returns the variance of each level [DN^2]. */
VectorXd
VariancesOf(const Levels & levels, const VectorXd & signals, const Scatter & scatter)
{
  const double least = InMoments.leastExposureScatter * InMoments.leastExposureScatter;
  VectorXd     variances(signals.size());
  for (Index i = 0; i < signals.size(); ++i)
  {
    const ExposureLevel & level = levels[static_cast<std::size_t>(i)];
    const double          ofIllumination = std::max(least, scatter.variance) * signals(i) * signals(i);
    variances(i) = (ofIllumination + level.pixelNoiseDn2) / static_cast<double>(level.frames);
  }
  return variances;
}

/** Returns the square of the linearity error and its standard error. \a deviations have the covariance \a covariance.
 *
 * Noise adds the trace of the covariance C to the sum of the squares of the deviations d. Without noise, the mean
 * square has the variance (4 d'Cd + 2 tr C^2) / n^2; the error of the scatter adds 2 (tr C)^2 / dof / n^2. With
 * measured deviations d'Cd is too large by tr C^2.
 *
 * The square of the mean of absolute values is the mean square times their ratio, which is computed from the
 * deviations. Large deviations change it through the sum of their signs instead; the larger of the two errors is used.
 * Where the interval contains 0, the noise determines the ratio, and the upper bound of the ratio, 1, is used. */
FittedNumber
SquaredError(const VectorXd & deviations, const MatrixXd & covariance, double dof)
{
  const auto     count = static_cast<double>(deviations.size());
  const double   squares = deviations.squaredNorm();
  const double   trace = covariance.trace();
  const double   ofNoise = covariance.squaredNorm();
  const double   mean = deviations.cwiseAbs().sum() / count;
  const double   ratio = squares > 0.0 ? mean * mean / (squares / count) : 1.0;
  const VectorXd bySigns = (mean / ratio) * deviations.cwiseSign();
  const double   ofDeviations =
    4.0 * std::max(deviations.dot(covariance * deviations), bySigns.dot(covariance * bySigns)) - 2.0 * ofNoise;
  const double error = std::sqrt(std::max(ofDeviations, 2.0 * ofNoise) + 2.0 * trace * trace / dof);
  const bool   isLimit = squares - trace <= StudentQuantile(0.975, dof) * error;
  const double factor = (isLimit ? 1.0 : ratio) / count;
  return { factor * (squares - trace), factor * error };
}

/** Returns the offset where there are no dark frames. A line through a curved response is biased there. The larger of
 * the difference to the offset of a parabola and the error of this difference is therefore added to the standard
 * error, in quadrature. */
FittedNumber
OffsetOfLine(const Levels & levels, const VectorXd & scales, const WeightedFit & line, const VectorXd & variances)
{
  const WeightedFit        parabola(levels, scales, 3);
  const Eigen::RowVectorXd ofLine = line.operatorOnLevels.row(0);
  const Eigen::RowVectorXd change = parabola.operatorOnLevels.row(0) - ofLine;
  const VectorXd           means = MeansOf(levels);
  const auto sd = [&](const Eigen::RowVectorXd & row) { return std::sqrt(row.cwiseAbs2().dot(variances.transpose())); };
  const double ofModel = std::max(std::abs(change.dot(means)), sd(change));
  return { ofLine.dot(means), std::hypot(sd(ofLine), ofModel) };
}

/** Fits the line to \a levels, 3 or more. */
void
FitLine(ExposureFit & fit, const Levels & levels, const std::optional<double> & darkDn)
{
  const VectorXd    means = MeansOf(levels);
  const VectorXd    scales = ScalesOf(levels, darkDn);
  const WeightedFit line(levels, scales, 2);
  const VectorXd    coefficients = line.operatorOnLevels * means;
  const VectorXd    fitted = line.columns * coefficients;
  const VectorXd    signals = fitted.array() - darkDn.value_or(coefficients(0));
  fit.responsivity = FittedNumber{ coefficients(1), 0.0 };
  if (!(signals.minCoeff() > 0.0))
  {
    fit.reason = FallingLevels;
    return;
  }
  Scatter    scatter = ScatterOfRepeats(levels, signals);
  const bool hasRepeats = scatter.dof > 0.0;
  scatter = hasRepeats ? scatter : ScatterAboutParabola(levels, scales, signals);
  const VectorXd variances = VariancesOf(levels, signals, scatter);
  const VectorXd deviations = (means - fitted).cwiseQuotient(signals);
  const MatrixXd rest = signals.cwiseInverse().asDiagonal() *
                        (MatrixXd::Identity(means.size(), means.size()) - line.columns * line.operatorOnLevels);
  fit.illuminationScatter = std::sqrt(scatter.variance);
  fit.dof = scatter.dof;
  if (!darkDn)
  {
    fit.offsetDn = OffsetOfLine(levels, scales, line, variances);
  }
  const double slopeVariance = line.operatorOnLevels.row(1).cwiseAbs2().dot(variances.transpose());
  fit.responsivity->standardError = std::sqrt(slopeVariance);
  for (ExposureFit::Level & level : fit.levels)
  {
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
      if (levels[i].exposure == level.exposure)
      {
        level.deviation = deviations(static_cast<Index>(i));
      }
    }
  }
  if (scatter.dof > 0.0)
  {
    fit.squaredError = SquaredError(deviations, rest * variances.asDiagonal() * rest.transpose(), scatter.dof);
  }
  else
  {
    fit.reason = "no exposure has two frames, and the range holds only 3 levels: their noise is not known. Record at "
                 "least two frames of each exposure.";
  }
}

FitRange
FindRange(ExposureFit & fit, const Levels & levels, const DnRange & dnRange)
{
  double largest = levels.front().meanDn;
  for (const ExposureLevel & level : levels)
  {
    largest = std::max(largest, level.meanDn);
  }
  fit.saturationDn = dnRange.clipHighDn.value_or(largest);
  fit.saturationSource = dnRange.clipHighDn ? dnRange.GetHighClipSource() : "largest level";
  return { fit.saturationDn, dnRange.clipHighDn.has_value() };
}
} // namespace

ExposureFit
FitExposures(const std::vector<ExposureLevel> & levels, const DnRange & dnRange)
{
  ExposureFit fit;
  if (levels.empty())
  {
    fit.reason = "too few parts of the frames hold finite pixels in all frames";
    return fit;
  }
  for (const ExposureLevel & level : levels)
  {
    fit.levels.push_back({ level.exposure, level.frames, level.meanDn, std::nullopt });
  }
  if (!(levels.back().meanDn > levels.front().meanDn))
  {
    fit.reason = FallingLevels;
    return fit;
  }
  const FitRange        range = FindRange(fit, levels, dnRange);
  const bool            hasDark = levels.front().exposure == 0.0;
  const Levels          bright(levels.begin() + (hasDark ? 1 : 0), levels.end());
  std::optional<double> darkDn;
  if (hasDark)
  {
    const ExposureLevel & dark = levels.front();
    const auto            frames = static_cast<double>(dark.frames);
    const double          ofFrames = dark.frames > 1 ? dark.squaresDn2 / (frames - 1.0) : 0.0;
    darkDn = dark.meanDn;
    fit.isOffsetOfDarkFrames = true;
    fit.offsetDn =
      FittedNumber{ dark.meanDn,
                    std::sqrt(std::max({ dark.pixelNoiseDn2 / frames, ofFrames / frames, dark.patternDn2 })) };
  }
  const Levels within = FindLevels(bright, range, darkDn);
  if (within.size() < InCommon.fewestLevels)
  {
    fit.reason = "only " + std::to_string(within.size()) + " of " + std::to_string(levels.size()) +
                 " exposures have a level between " + Text(100.0 * InMoments.linearityRangeLow) + " % and " +
                 Text(100.0 * (1.0 - InMoments.linearityRangeLow)) + " % of saturation (" + Text(fit.saturationDn) +
                 " DN); 3 are needed. Record further exposures between these levels.";
    return fit;
  }
  FitLine(fit, within, darkDn);
  return fit;
}

std::optional<ExposureFit>
FitExposures(const std::vector<double> &      exposures,
             const FrameThumbnails &          thumbnails,
             const std::vector<std::size_t> & counted,
             const StackMaps &                maps)
{
  if (exposures.empty())
  {
    return std::nullopt;
  }
  return FitExposures(
    FindExposureLevels(thumbnails, counted, exposures, FindEvenPixels(thumbnails, counted, exposures, maps)),
    maps.summary.dnRange);
}

} // namespace sensornoise
