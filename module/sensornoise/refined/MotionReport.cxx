// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/refined/MotionReport.h"

#include "sensornoise/base/Stencils.h"
#include "sensornoise/base/Text.h"
#include "sensornoise/refined/Constants.h"
#include "sensornoise/report/Quantities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** One axis of the motion. */
struct AxisMotion
{
  std::vector<double> series;       ///< of every frame, mean 0 [pixel]; empty: its derivative is not active
  std::vector<double> leastSquares; ///< the same by least squares
  Eigen::Index        place{ 0 };   ///< of its derivative among those of the motion
  Quantity            sd{ Quantity::Without(EstimateStatus::NotIdentifiable) };
};

/** What coefficients of a derivative, (1 + gamma_t) times the shift, say of the shifts. */
struct ShiftSpread
{
  std::vector<double> series;
  double              square{ 0.0 }; ///< their variance over time, without that of their noise [pixel^2]
};

template <typename TCoefficients>
ShiftSpread
SpreadOf(const TCoefficients & coefficients, const std::vector<double> & gamma, double noiseSquare)
{
  const auto  frames = static_cast<double>(gamma.size());
  ShiftSpread spread;
  spread.series.assign(gamma.size(), 0.0);
  double mean = 0.0;
  for (std::size_t t = 0; t < gamma.size(); ++t)
  {
    spread.series[t] = coefficients(static_cast<Eigen::Index>(t)) / (1.0 + gamma[t]);
    mean += spread.series[t] / frames;
  }
  double sum = 0.0;
  for (double & value : spread.series)
  {
    value -= mean;
    sum += value * value;
  }
  spread.square = sum / (frames - 1.0) - noiseSquare;
  return spread;
}

/** The motion along \a axis, whose derivative is \a stencil: by least squares, or better by instruments where they see
 * it. Half of what both differ by is a systematic error. */
AxisMotion
MotionAlong(Eigen::Index axis, std::size_t stencil, const PolishedSeries & polished, const std::vector<double> & gamma)
{
  AxisMotion   result;
  const auto & stencils = polished.motion.stencils;
  const auto   place = std::find(stencils.begin(), stencils.end(), stencil);
  if (place == stencils.end())
  {
    return result;
  }
  const auto frames = static_cast<double>(gamma.size());
  const auto k = static_cast<Eigen::Index>(place - stencils.begin());
  result.place = k;
  const double leastVariance = polished.motion.covariance(k, k) * polished.motionPhi;
  ShiftSpread  spread = SpreadOf(polished.motion.coefficients.col(k), gamma, leastVariance);
  double       errorSquare = leastVariance;
  double       systematic = 0.0;
  result.leastSquares = spread.series;
  if (polished.shifts)
  {
    const double leastSquares = std::sqrt(std::max(0.0, spread.square));
    errorSquare = polished.shifts->covariance(axis, axis) * polished.motionPhi;
    spread = SpreadOf(polished.shifts->coefficients.col(axis), gamma, errorSquare);
    systematic = InRefined.errorOfMotion * std::abs(std::sqrt(std::max(0.0, spread.square)) - leastSquares);
  }
  const double sd = std::sqrt(std::max(0.0, spread.square));
  const double error = std::hypot(2.0 * sd * std::sqrt(errorSquare / (frames - 1.0)),
                                  errorSquare * std::sqrt(2.0 / (frames - 1.0)),
                                  2.0 * sd * systematic);
  result.sd = RootOf(spread.square, error);
  result.series = std::move(spread.series);
  return result;
}

/** The mean product of two series of mean 0. */
double
ProductOf(const std::vector<double> & a, const std::vector<double> & b)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < a.size(); ++t)
  {
    sum += a[t] * b[t];
  }
  return sum / (static_cast<double>(a.size()) - 1.0);
}

/** The covariance of the shifts along both axes, without that of their noise. Its error is that of a mean product of
 * shifts with Gaussian noise, whose covariance in one frame is known; half of what it differs by from least squares, if
 * it is by instruments, is a systematic one, as of the standard deviations. */
Quantity
CovarianceOf(const AxisMotion & x, const AxisMotion & y, const PolishedSeries & polished)
{
  const Eigen::MatrixXd & ofAll = polished.motion.covariance;
  Eigen::Matrix2d         noise;
  noise << ofAll(x.place, x.place), ofAll(x.place, y.place), ofAll(y.place, x.place), ofAll(y.place, y.place);
  noise *= polished.motionPhi;
  double value = ProductOf(x.leastSquares, y.leastSquares) - noise(0, 1);
  double systematic = 0.0;
  if (polished.shifts)
  {
    const double leastSquares = value;
    noise = polished.shifts->covariance * polished.motionPhi;
    value = ProductOf(x.series, y.series) - noise(0, 1);
    systematic = 0.5 * std::abs(value - leastSquares);
  }
  const double squareX = std::max(0.0, ProductOf(x.series, x.series) - noise(0, 0));
  const double squareY = std::max(0.0, ProductOf(y.series, y.series) - noise(1, 1));
  const double shiftsAndNoise = squareX * noise(1, 1) + squareY * noise(0, 0) + 2.0 * value * noise(0, 1);
  const double noiseAlone = noise(0, 0) * noise(1, 1) + noise(0, 1) * noise(0, 1);
  const double variance = (std::max(0.0, shiftsAndNoise) + noiseAlone) / (static_cast<double>(x.series.size()) - 1.0);
  return WithError(value, std::hypot(std::sqrt(variance), systematic));
}
} // namespace

void
FillFlicker(Report & report, const RefinedResults & found, double offset, double offsetErrorDn, double scaleError)
{
  OffsetLine line = found.polished.line;
  line.UseOffset(offset);
  report.flicker = line.gamma;
  const auto   frames = static_cast<double>(line.gamma.size());
  const double noise = line.Widening() / line.precision;
  double       squares = 0.0;
  for (const double gamma : line.gamma)
  {
    squares += gamma * gamma;
  }
  const double variance = squares / (frames - 1.0) - noise;
  const double fromOffset = 2.0 * variance * std::hypot(line.sensitivity * offsetErrorDn, scaleError);
  const double ownError =
    2.0 * std::sqrt(std::max(0.0, variance) * noise / (frames - 1.0)) + noise * std::sqrt(2.0 / (frames - 1.0));
  report.flickerSd = RootOf(variance, std::hypot(ownError, fromOffset));
  const double ofScale = std::abs(line.sensitivity) * offsetErrorDn;
  const auto & limit = report.flickerSd.interval95;
  if (ofScale > InRefined.largestScaleError || !(limit && limit->high.value_or(2.0) < 1.0))
  {
    report.flickerSd = Quantity::Without(EstimateStatus::NotIdentifiable);
    report.Warn(WarningCode::FlickerNotIdentifiable,
                (std::isfinite(ofScale)
                   ? "the light is known to " + Percent(ofScale) + " only, and so is the flicker (expected " +
                       Percent(InRefined.largestScaleError) + " at most)"
                   : std::string("the light is not known, and neither is the flicker")) +
                  ": a known offset would tell, or a scene with dark and bright areas");
  }
  if (found.HasLocalLight())
  {
    const LocalFlicker & local = found.polished.localFlicker;
    const double         sd = local.Sd(offset);
    const double         step = 1.0 + offsetErrorDn;
    const double         slope = (local.Sd(offset + step) - local.Sd(offset - step)) / (2.0 * step);
    report.flickerSd = WithError(sd, std::hypot(slope * offsetErrorDn, sd * std::sqrt(noise), sd * scaleError));
  }
}

void
FillMotion(Report & report, const RefinedResults & found)
{
  const PolishedSeries & polished = found.polished;
  if (polished.line.isLevelMotion)
  {
    report.vibrationSdX = report.vibrationSdY = Quantity::Without(EstimateStatus::NotIdentifiable);
    report.vibrationCovariance = Quantity::Without(EstimateStatus::NotIdentifiable);
    return;
  }
  const AxisMotion x = MotionAlong(0, StencilX, polished, report.flicker);
  const AxisMotion y = MotionAlong(1, StencilY, polished, report.flicker);
  report.vibrationSdX = x.sd;
  report.vibrationSdY = y.sd;
  report.vibrationCovariance = Quantity::Without(EstimateStatus::NotIdentifiable);
  if (x.series.empty() || y.series.empty())
  {
    return;
  }
  for (std::size_t t = 0; t < x.series.size(); ++t)
  {
    report.motion.push_back({ x.series[t], y.series[t] });
  }
  report.vibrationCovariance = CovarianceOf(x, y, polished);
}

} // namespace sensornoise
