// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Stencils.h"
#include "moments/Constants.h"
#include "refined/Constants.h"
#include "report/Quantities.h"
#include "series/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Motion along one axis. */
struct AxisMotion
{
  std::vector<double> series;       ///< shift of every frame, mean 0 [pixel]; empty: the derivative is not active
  std::vector<double> leastSquares; ///< shift of every frame by least squares [pixel]
  Eigen::Index        place{ 0 };   ///< index of its derivative among the derivatives of the motion
  Quantity            sd{ Quantity::Without(EstimateStatus::NotIdentifiable) };

  /** Upper end of the interval of the standard deviation, also if the blocks do not share it [pixel]. */
  std::optional<double> highestSd;
  double                deviationOfBlocks{ 0.0 }; ///< see DeviationOfBlocks::rms; 0 without motion [1]
};

/** Weights of the frames' shifts, whose variance is proportional to 1 / (1 + gamma_t)^2. They differ only under strong
 * changes of the illumination. Dark frames have the weight 0, as their shift is not identifiable. */
struct FrameWeights
{
  std::vector<double> ofFrames;
  double              sum{ 0.0 };
  double              frames{ 0.0 };  ///< number of frames with a weight above 0
  double              squares{ 0.0 }; ///< sum of the squared weights

  /** Returns the expectation of a weighted sum of squares about the weighted mean, over the variance: the number of
   * frames minus 1 if all weights are 1. */
  double
  Dof() const
  {
    return sum - squares / sum;
  }
  /** Returns the number of equally weighted frames that determine a variance as precisely, minus 1. */
  double
  EffectiveDof() const
  {
    return sum * sum / squares - 1.0;
  }
  /** Returns the mean variance of the shifts' noise, over the variance at the mean illumination [1]. */
  double
  MeanNoise() const
  {
    return (frames - 1.0) / this->Dof();
  }
};

FrameWeights
WeighFrames(const std::vector<double> & gamma)
{
  const double squares = std::inner_product(gamma.begin(), gamma.end(), gamma.begin(), 0.0);
  const double rms = std::sqrt(squares / std::max(1.0, static_cast<double>(gamma.size()) - 1.0));
  const bool   isStrong = rms > InMoments.strongIlluminationChange;
  FrameWeights weights;
  for (const double change : gamma)
  {
    const double illumination = 1.0 + change;
    const bool   hasShift = !(illumination < InSeries.leastIlluminationOfShift); // also if it is NaN
    const double weight = !hasShift ? 0.0 : isStrong ? illumination * illumination : 1.0;
    weights.ofFrames.push_back(weight);
    weights.sum += weight;
    weights.squares += weight * weight;
    weights.frames += hasShift ? 1.0 : 0.0;
  }
  return weights;
}

/** Shifts from the coefficients of a derivative, and the variance of the shifts. A coefficient is (1 + gamma_t) times
 * the shift. */
struct ShiftVariance
{
  std::vector<double> series;        ///< shift of every frame [pixel]; 0 for a frame without a weight
  double              square{ 0.0 }; ///< variance over time without the variance of the noise [pixel^2]
};

/** Returns the shifts of \a coefficients; \a noiseSquare is the mean variance of their noise over the frames [pixel^2].
 */
template <typename TCoefficients>
ShiftVariance
SpreadOf(const TCoefficients &       coefficients,
         const std::vector<double> & gamma,
         const FrameWeights &        weights,
         double                      noiseSquare)
{
  ShiftVariance spread;
  spread.series.assign(gamma.size(), 0.0);
  double mean = 0.0;
  for (std::size_t t = 0; t < gamma.size(); ++t)
  {
    if (weights.ofFrames[t] > 0.0)
    {
      spread.series[t] = coefficients(static_cast<Eigen::Index>(t)) / (1.0 + gamma[t]);
      mean += weights.ofFrames[t] * spread.series[t] / weights.sum;
    }
  }
  double sum = 0.0;
  for (std::size_t t = 0; t < gamma.size(); ++t)
  {
    if (weights.ofFrames[t] > 0.0)
    {
      spread.series[t] -= mean;
      sum += weights.ofFrames[t] * spread.series[t] * spread.series[t];
    }
  }
  spread.square = sum / weights.Dof() - noiseSquare;
  return spread;
}

/** Shifts along one axis by either method, for the offset of the flicker that was subtracted. */
struct AxisShifts
{
  Eigen::VectorXd    coefficients;   ///< (1 + gamma_t) times the shift [pixel]
  Eigen::RowVector2d ofIllumination; ///< apparent shifts by a change of level, and by a change of contrast
  double             noise{ 0.0 };   ///< variance of the coefficient of one frame [pixel^2]

  /** Returns the shifts for another offset, where another flicker is subtracted. */
  AxisShifts
  About(const OffsetLine & before, const OffsetLine & after) const
  {
    AxisShifts   moved = *this;
    const double off = ofIllumination.dot(Eigen::RowVector2d(-after.offset, 1.0));
    const double on = ofIllumination.dot(Eigen::RowVector2d(-before.offset, 1.0));
    for (std::size_t t = 0; t < before.gamma.size(); ++t)
    {
      moved.coefficients(static_cast<Eigen::Index>(t)) += before.gamma[t] * on - after.gamma[t] * off;
    }
    return moved;
  }
};

AxisShifts
ByLeastSquares(const ReestimatedComponents & reestimated, Eigen::Index k)
{
  AxisShifts   shifts{ reestimated.motion.coefficients.col(k), reestimated.motion.ofIllumination.row(k), 0.0 };
  const double ofFlicker = shifts.ofIllumination.dot(Eigen::RowVector2d(-reestimated.line.offset, 1.0));
  shifts.noise = reestimated.motion.covariance(k, k) + ofFlicker * ofFlicker / reestimated.line.precision;
  return shifts;
}

AxisShifts
ByInstruments(const ReestimatedComponents & reestimated, Eigen::Index axis)
{
  const InstrumentShifts & shifts = *reestimated.shifts;
  return { shifts.coefficients.col(axis), shifts.ofIllumination.row(axis), shifts.covariance(axis, axis) };
}

/** Flicker that is subtracted from the shifts, with its error. */
struct IlluminationOfShifts
{
  const OffsetLine & solved; ///< flicker at which the shifts were found
  OffsetLine         inUse;  ///< flicker that is reported
  double             offsetErrorDn{ 0.0 };
  double             phi{ 1.0 }; ///< dispersion of the frames' illumination [1]

  OffsetLine
  Beyond(double sds) const
  {
    OffsetLine line = inUse;
    line.UseOffset(inUse.offset + sds * offsetErrorDn);
    return line;
  }
};

/** Returns the relative error of the noise by the dispersion of the frames' illumination: half of the excess over 1
 * [1]. */
double
Slack(double phi)
{
  return 0.5 * (phi - 1.0);
}

/** Returns the shifts, their variance over time without the variance of their noise, and its squared error. The noise
 * lies between white noise and white noise times the dispersion of the frames' illumination, which need not be caused
 * by motion. A wrong offset leaves a part of the flicker in the shifts. On average this part adds its square to the
 * variance. The square is estimated and subtracted: it is half of the sum of the increases of the variance at an offset
 * too low and at an offset too high. */
ShiftVariance
SpreadAbout(const AxisShifts &           shifts,
            const IlluminationOfShifts & illumination,
            const FrameWeights &         weights,
            double &                     errorSquare)
{
  const double white = std::max(0.0, shifts.noise) * weights.MeanNoise(); // a difference of sums may be below 0
  const double noise = white * (1.0 + Slack(illumination.phi));
  const auto   spreadAt = [&](const OffsetLine & line) {
    return SpreadOf(shifts.About(illumination.solved, line).coefficients, line.gamma, weights, noise);
  };
  ShiftVariance spread = spreadAt(illumination.inUse);
  const double  low = spreadAt(illumination.Beyond(-1.0)).square - spread.square;
  const double  high = spreadAt(illumination.Beyond(1.0)).square - spread.square;
  const double  ofFlicker = std::max(0.0, 0.5 * (low + high));
  spread.square -= ofFlicker;
  const double square = std::max(0.0, spread.square);
  errorSquare = 4.0 * square * noise / weights.EffectiveDof() + 2.0 * noise * noise / weights.EffectiveDof() +
                0.25 * (high - low) * (high - low) + 2.0 * ofFlicker * ofFlicker +
                std::pow(white * Slack(illumination.phi), 2);
  return spread;
}

/** Returns the relative errors of the motion along x and y by the approximation of derivatives [1]. Instruments average
 * over the edges, which helps less where \a isSharp edges lie within pixels. */
Eigen::Vector2d
ScaleErrors(const ReestimatedComponents & reestimated, bool isSharp)
{
  if (!reestimated.shifts)
  {
    return reestimated.scaleErrors;
  }
  const double ofEdges = isSharp ? InRefined.errorOfSharpEdges : 0.0;
  return (reestimated.shifts->scaleErrors.cwiseAbs2() + (ofEdges * reestimated.scaleErrors).cwiseAbs2()).cwiseSqrt();
}

/** Returns the deviation of the blocks' shifts along an axis; 0 without instruments. */
DeviationOfBlocks
OfBlocks(const ReestimatedComponents & reestimated, Eigen::Index axis)
{
  return reestimated.shifts ? reestimated.shifts->ofBlocks[static_cast<std::size_t>(axis)] : DeviationOfBlocks();
}

/** Returns the motion along \a axis, whose derivative is \a stencil: by instruments where they are available, else by
 * least squares. \a scaleErrors are the relative systematic errors, see ScaleErrors(). With instruments a part of the
 * difference between both methods is added. */
AxisMotion
MotionAlong(Eigen::Index                  axis,
            std::size_t                   stencil,
            const ReestimatedComponents & reestimated,
            const Eigen::Vector2d &       scaleErrors,
            const IlluminationOfShifts &  illumination,
            const FrameWeights &          weights)
{
  AxisMotion   result;
  const auto & stencils = reestimated.motion.stencils;
  const auto   place = std::find(stencils.begin(), stencils.end(), stencil);
  if (place == stencils.end())
  {
    return result;
  }
  result.place = static_cast<Eigen::Index>(place - stencils.begin());
  double        errorSquare = 0.0;
  ShiftVariance spread = SpreadAbout(ByLeastSquares(reestimated, result.place), illumination, weights, errorSquare);
  double        systematic = 2.0 * std::max(0.0, spread.square) * scaleErrors(axis);
  result.leastSquares = spread.series;
  if (reestimated.shifts)
  {
    const double leastSquares = std::sqrt(std::max(0.0, spread.square));
    spread = SpreadAbout(ByInstruments(reestimated, axis), illumination, weights, errorSquare);
    const double sd = std::sqrt(std::max(0.0, spread.square));
    systematic = 2.0 * sd * std::hypot(InRefined.errorOfMotion * (sd - leastSquares), sd * scaleErrors(axis));
  }
  if (!(std::abs(reestimated.motion.ofOtherAxis) > InRefined.largestFractionOfOtherAxis))
  {
    const double square = std::hypot(std::sqrt(errorSquare), systematic);
    // Without motion, the shifts are noise, which differs by blocks.
    const bool              moves = RootOf(spread.square, square).status == EstimateStatus::Identified;
    const DeviationOfBlocks ofBlocks = moves ? OfBlocks(reestimated, axis) : DeviationOfBlocks();
    const Quantity          sd = RootOf(spread.square, std::hypot(square, 2.0 * spread.square * ofBlocks.error));
    result.highestSd = sd.interval95 ? sd.interval95->high : std::nullopt;
    result.deviationOfBlocks = ofBlocks.rms;
    if (!(ofBlocks.rms > InCommon.largestRelativeError))
    {
      result.sd = sd;
    }
  }
  result.series = std::move(spread.series);
  return result;
}

/** Returns the weighted mean product of two series of mean 0. */
double
ProductOf(const std::vector<double> & a, const std::vector<double> & b, const FrameWeights & weights)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < a.size(); ++t)
  {
    sum += weights.ofFrames[t] * a[t] * b[t];
  }
  return sum / weights.Dof();
}

/** Returns the covariance of the shifts along both axes without the covariance of their noise. Its error is the error
 * of a mean product of shifts with Gaussian noise, whose covariance in one frame is known. The systematic error is the
 * systematic error of MotionAlong(). */
Quantity
CovarianceOf(const AxisMotion &            x,
             const AxisMotion &            y,
             const ReestimatedComponents & reestimated,
             const Eigen::Vector2d &       scaleErrors,
             const FrameWeights &          weights)
{
  const Eigen::MatrixXd & ofAll = reestimated.motion.covariance;
  Eigen::Matrix2d         noise;
  noise << ofAll(x.place, x.place), ofAll(x.place, y.place), ofAll(y.place, x.place), ofAll(y.place, y.place);
  const double slack = Slack(reestimated.motionPhi);
  const double scale = weights.MeanNoise() * (1.0 + slack);
  noise *= scale;
  double value = ProductOf(x.leastSquares, y.leastSquares, weights) - noise(0, 1);
  double systematic = scaleErrors.norm() * value;
  if (reestimated.shifts)
  {
    const double leastSquares = value;
    noise = reestimated.shifts->covariance * scale;
    value = ProductOf(x.series, y.series, weights) - noise(0, 1);
    systematic = std::hypot(2.0 * InRefined.errorOfMotion * (value - leastSquares), scaleErrors.norm() * value);
  }
  const double squareX = std::max(0.0, ProductOf(x.series, x.series, weights) - noise(0, 0));
  const double squareY = std::max(0.0, ProductOf(y.series, y.series, weights) - noise(1, 1));
  const double shiftsAndNoise = squareX * noise(1, 1) + squareY * noise(0, 0) + 2.0 * value * noise(0, 1);
  const double noiseAlone = noise(0, 0) * noise(1, 1) + noise(0, 1) * noise(0, 1);
  const double variance = (std::max(0.0, shiftsAndNoise) + noiseAlone) / weights.EffectiveDof();
  const double ofNoise = noise(0, 1) * slack / (1.0 + slack);
  return WithError(value, AddInQuadrature(std::sqrt(variance), systematic, ofNoise));
}
} // namespace

SeriesOfMotion
EstimateMotion(const RefinedResults & found, const std::vector<double> & gamma, const UsedOffset & offset)
{
  const ReestimatedComponents & reestimated = found.reestimated;
  const FrameWeights            weights = WeighFrames(gamma);
  SeriesOfMotion                motion;
  motion.covariance = Quantity::Without(EstimateStatus::NotIdentifiable);
  if (reestimated.line.isLevelMotion || found.IsFlatUnderChange() || weights.frames < 2.0)
  {
    motion.sdX = motion.sdY = Quantity::Without(EstimateStatus::NotIdentifiable);
    return motion;
  }
  IlluminationOfShifts illumination{ reestimated.line, reestimated.line, 0.0, reestimated.motionPhi };
  const double         offsetFromCentre = offset.valueDn - found.scene.model.centreDn;
  if (std::isfinite(offsetFromCentre) && std::isfinite(offset.errorDn))
  {
    illumination.offsetErrorDn = offset.errorDn;
    illumination.inUse.offset = offsetFromCentre;
    illumination.inUse.UseOffset(offsetFromCentre);
  }
  Eigen::Vector2d  scaleErrors = ScaleErrors(reestimated, found.scene.model.isSharp);
  const AxisMotion x = MotionAlong(0, StencilX, reestimated, scaleErrors, illumination, weights);
  const AxisMotion y = MotionAlong(1, StencilY, reestimated, scaleErrors, illumination, weights);
  motion.sdX = x.sd;
  motion.sdY = y.sd;
  motion.highestSds = { x.highestSd, y.highestSd };
  motion.deviationOfBlocks = std::max(x.deviationOfBlocks, y.deviationOfBlocks);
  if (x.series.empty() || y.series.empty())
  {
    return motion;
  }
  for (std::size_t t = 0; t < x.series.size(); ++t)
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN(); // motion of a dark frame
    const bool       isKnown = weights.ofFrames[t] > 0.0;
    motion.shifts.push_back({ isKnown ? x.series[t] : unknown, isKnown ? y.series[t] : unknown });
  }
  if (motion.deviationOfBlocks > InCommon.largestRelativeError)
  {
    return motion;
  }
  for (const Eigen::Index axis : { 0, 1 })
  {
    scaleErrors(axis) = std::hypot(scaleErrors(axis), OfBlocks(reestimated, axis).error);
  }
  const Quantity covariance = CovarianceOf(x, y, reestimated, scaleErrors, weights);
  if (std::isfinite(covariance.value.value_or(0.0))) // NaN: the illumination is not known
  {
    motion.covariance = covariance;
  }
  return motion;
}

} // namespace sensornoise
