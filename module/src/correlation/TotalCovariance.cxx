// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/TotalCovariance.h"

#include "base/Constants.h"
#include "correlation/Constants.h"
#include "correlation/ProcessingSigns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace sensornoise
{

namespace
{
/** Returns the evidence that is required for a shape, as a difference of chi-squares from the most probable shapes;
 * null: the shape is impossible. Charge coupling is weak and short. Stronger filters may lie before the read-out, or
 * between two parts of its noise. Where black is not known, V - x stands for the signal, too. */
std::optional<double>
RequiredEvidence(CovarianceShape shape, bool mayBeCharge, bool isBlackKnown)
{
  switch (shape)
  {
    case CovarianceShape::Variance:
      return 0.0;
    case CovarianceShape::Signal:
    case CovarianceShape::Square:
      return mayBeCharge ? std::optional(0.0) : std::nullopt;
    case CovarianceShape::Constant:
      return InCorrelation.evidenceOfConstant;
    default:
      return mayBeCharge && isBlackKnown ? std::nullopt : std::optional(InCorrelation.evidenceOfPart);
  }
}
} // namespace

std::array<double, NumberOfShapes>
ProbabilitiesOf(const Eigen::VectorXd & chi2, bool mayBeCharge, bool isBlackKnown)
{
  std::array<double, NumberOfShapes> probabilities{};
  double                             sum = 0.0;
  for (std::size_t k = 0; k < NumberOfShapes; ++k)
  {
    if (const auto evidence = RequiredEvidence(static_cast<CovarianceShape>(k), mayBeCharge, isBlackKnown))
    {
      probabilities[k] = std::exp(-0.5 * (chi2(static_cast<Eigen::Index>(k)) + *evidence - chi2.minCoeff()));
      sum += probabilities[k];
    }
  }
  for (double & probability : probabilities)
  {
    probability /= std::max(1e-300, sum);
  }
  return probabilities;
}

std::array<WeightedShape, NumberOfShapes>
WeighShapes(const JackknifeEstimate &                  fits,
            const std::array<double, NumberOfShapes> & probabilities,
            const CovarianceShapes &                   predicted)
{
  std::array<WeightedShape, NumberOfShapes> shapes;
  for (std::size_t k = 0; k < NumberOfShapes; ++k)
  {
    shapes[k] = predicted.UnitOf(k);
    shapes[k].coefficient = NumberAt(fits, k);
    shapes[k].probability = probabilities[k];
  }
  return shapes;
}

namespace
{
/** Returns twice the sum of the coefficients at some lags. */
MeasuredNumber
SumOfCoefficients(const CorrelationSums & sums, const CorrelationSums::Lags & lags)
{
  return NumberAt(Jackknife(sums.GetTiles(),
                            [&](const TileSums & tiles) {
                              const CommonNoise common = FindCommonNoise(tiles.shared);
                              double            sum = 0.0;
                              for (const std::size_t k : lags)
                              {
                                sum += 2.0 * sums.CoefficientOf(tiles, common, k);
                              }
                              return Eigen::VectorXd(Eigen::VectorXd::Constant(1, sum));
                            }),
                  0);
}

/** Returns the reach [pixels], and in \a beyond the largest covariance beyond it [1]. \a sums must hold two rings. */
int
FindReach(CorrelationSums & sums, double & beyond)
{
  for (int reach = 1;; ++reach)
  {
    if (reach > 1)
    {
      sums.AddRing(reach + 1);
    }
    const MeasuredNumber next = SumOfCoefficients(sums, sums.Ring(reach + 1, reach + 1));
    const double         inside = 1.0 + SumOfCoefficients(sums, sums.Ring(1, reach)).value;
    const double         size = std::abs(next.value);
    const bool           isLast = size < InCorrelation.leastRing * std::abs(inside) || size < next.standardError;
    if (isLast || reach == InCorrelation.largestReach)
    {
      beyond = std::max((isLast ? 1.0 : InCorrelation.ringsBeyondReach) * size,
                        InCorrelation.unseenErrors * next.standardError);
      return reach;
    }
  }
}

/** Returns the chi-square of \a variance about a line of the signal. \a variance is given in bins, relative to its
 * typical value. */
double
Chi2OfLine(const Eigen::MatrixXd & shapes, const Eigen::VectorXd & variance, const Eigen::VectorXd & errors)
{
  Eigen::MatrixXd design(variance.size(), 2);
  design.col(0) = shapes.col(static_cast<Eigen::Index>(CovarianceShape::Signal));
  design.col(1) = shapes.col(static_cast<Eigen::Index>(CovarianceShape::Constant));
  const Eigen::VectorXd weights = errors.unaryExpr([](double error) { return error > 0.0 ? 1.0 / error : 0.0; });
  const Eigen::MatrixXd weighted = weights.asDiagonal() * design;
  const Eigen::VectorXd values = weights.cwiseProduct(variance);
  return (values - weighted * weighted.colPivHouseholderQr().solve(values)).squaredNorm();
}

/** Returns the chi-square of the sum of variance and neighbours' covariance about a line of the signal, for each shape.
 * The brighter-fatter effect curves the variance of a pixel, but not the total covariance over all neighbours. */
Eigen::VectorXd
Chi2OfTotalVariance(const CorrelationSums & sums, const TileSums & all, const Eigen::VectorXd & coefficients)
{
  const CorrelationSums::Lags itself{ 0 };
  const Eigen::MatrixXd       shapes = sums.ShapesOf(all, sums.GetQuantisationDn2()).InBins();
  const Eigen::VectorXd       own = 0.5 * sums.CovarianceInBins(all, itself);
  const Eigen::VectorXd       errors = 0.5 * sums.StandardErrorsInBins(itself);
  const double                straight = Chi2OfLine(shapes, own, errors);
  Eigen::VectorXd             chi2 = Eigen::VectorXd::Constant(NumberOfShapes, straight);
  const auto                  square = static_cast<Eigen::Index>(CovarianceShape::Square);
  const double                left = Chi2OfLine(shapes, own + coefficients(square) * shapes.col(square), errors);
  chi2(square) =
    left < InCorrelation.largestFractionOfCurvature * straight ? left : straight; // else the response is non-linear
  return chi2.cwiseMin(chi2.minCoeff() + InCorrelation.mostEvidenceOfCurvature);
}

/** Returns whether the variance is curved as by the brighter-fatter effect, and the covariance of the nearest
 * neighbours makes it linear. Either one alone may be statistical scatter, or a non-linear response. */
bool
LinearizesVariance(const CorrelationSums & sums, const Eigen::VectorXd & errors, const MeasuredNumber & effect)
{
  if (effect.value < InCorrelation.leastEffect || !effect.Exceeds(0.0, Significance.hint))
  {
    return false;
  }
  const TileSums        all = sums.Total();
  const Eigen::MatrixXd shapes = sums.ShapesOf(all, sums.GetQuantisationDn2()).InBins();
  const auto            fits = FitShapes(shapes, sums.CovarianceInBins(all, sums.Nearest()), errors);
  Eigen::VectorXd       coefficients(NumberOfShapes);
  std::transform(
    fits.begin(), fits.end(), coefficients.data(), [](const FittedShape & fit) { return fit.coefficient; });
  const Eigen::VectorXd chi2 = Chi2OfTotalVariance(sums, all, coefficients);
  return chi2(static_cast<Eigen::Index>(CovarianceShape::Variance)) -
           chi2(static_cast<Eigen::Index>(CovarianceShape::Square)) >
         Significance.oneTest * Significance.oneTest;
}
} // namespace

bool
IsProportionalToSquare(const JackknifeEstimate & fits)
{
  const auto      square = static_cast<Eigen::Index>(CovarianceShape::Square);
  Eigen::VectorXd chi2 = fits.value.tail(NumberOfShapes);
  const double    own = chi2(square);
  chi2(square) = std::numeric_limits<double>::infinity();
  return fits.value(square) > 0.0 && own + InCommon.strongEvidence < chi2.minCoeff();
}

bool
IsCorrelatedInSpace(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients)
{
  const CorrelationSums::Lags nearest = sums.Nearest();
  const Eigen::VectorXd       errors = sums.StandardErrorsInBins(nearest);
  const JackknifeEstimate     atTheTop = Jackknife(sums.GetTiles(), [&](const TileSums & tiles) {
    const Eigen::MatrixXd shapes = sums.ShapesOf(tiles, sums.GetQuantisationDn2()).InBins();
    const auto            fits = FitShapes(shapes, sums.CovarianceInBins(tiles, nearest), errors);
    Eigen::Vector3d       effects;
    for (Eigen::Index k = 0; k < effects.size(); ++k) // all shapes but the constant
    {
      effects(k) = fits[static_cast<std::size_t>(k)].coefficient * shapes(shapes.rows() - 1, k);
    }
    return Eigen::VectorXd(effects);
  });
  for (std::size_t k = 0; k < static_cast<std::size_t>(atTheTop.value.size()); ++k)
  {
    if (NumberAt(atTheTop, k).Exceeds(InCorrelation.leastEffect, Significance.oneTest))
    {
      return true;
    }
  }
  if (LinearizesVariance(sums, errors, NumberAt(atTheTop, static_cast<std::size_t>(CovarianceShape::Square))))
  {
    return true;
  }
  return std::any_of(coefficients.begin(), coefficients.end(), [](const LagCoefficient & lag) {
    return lag.coefficient.Exceeds(InCorrelation.leastCoefficient, Significance.severalTests);
  });
}

BrightCovariance
MeasureBrightCovariance(const CorrelationSums & sums, const ParallelFor & parallelFor)
{
  struct PairCounts
  {
    double weights{ 0.0 };
    double squares{ 0.0 };    // sum of the squared weights
    double covariance{ 0.0 }; // weighted sum of the correlations of the pairs
    double signs{ 0.0 };      // weighted sum
  };
  const std::vector<Lag> lags{ { 1, 0, 0 }, { 0, 1, 0 } };
  const NoiseResiduals & residuals = sums.GetResiduals();
  const CommonNoise      common = FindCommonNoise(sums.Total().shared);
  const double           mean = residuals.GetMeanSignal();
  const std::size_t      side = residuals.GetTiles().side;
  // A mean square of the illumination is not below 0. Few pairs of distant bright pixels determine it in a dark scene,
  // and its error grows with the square of the signal.
  const double illumination = std::max(0.0, common.illumination);

  std::vector<PairCounts> tiles(residuals.GetTiles().origins.size());
  parallelFor(tiles.size(), [&](std::size_t i) {
    const auto          products = SumProducts(residuals, i, lags);
    const float * const weight = residuals.WeightOf(i);
    const float * const signal = residuals.SignalOf(i);
    const auto * const  squares = residuals.SquaresOf(i);
    const auto          rootOfInformation = [&](std::size_t p) { return weight[p] * std::max(0.0, signal[p] - mean); };
    for (std::size_t k = 0; k < lags.size(); ++k)
    {
      const auto        x = static_cast<std::size_t>(lags[k].x);
      const auto        y = static_cast<std::size_t>(lags[k].y);
      const std::size_t shift = y * side + x;
      const double      lines = common.OfLines(lags[k]);
      for (std::size_t p = 0; p + y * side < side * side; ++p)
      {
        const double own = p % side + x < side ? rootOfInformation(p) * rootOfInformation(p + shift) : 0.0;
        if (own > 0.0)
        {
          const double square = double{ signal[p] } * signal[p + shift];
          const double covariance = products[k][p] / residuals.GetDof() - lines - illumination * square;
          tiles[i].weights += own;
          tiles[i].squares += own * own;
          // The variance of the pixels themselves: few bright pixels hardly count in the typical variance.
          const double variance = std::sqrt(double{ squares[p] } * squares[p + shift]) / residuals.GetDof();
          tiles[i].covariance += own * covariance / std::max(smallestDivisor, variance);
          tiles[i].signs += covariance > 0.0 ? own : -own;
        }
      }
    }
  });
  PairCounts all;
  for (const PairCounts & tile : tiles)
  {
    all.weights += tile.weights;
    all.squares += tile.squares;
    all.covariance += tile.covariance;
    all.signs += tile.signs;
  }
  if (all.weights <= 0.0)
  {
    return {};
  }
  // Both lags together are half of the neighbours. The coefficient of one pair of white noise has the variance 1 / dof.
  const double root = std::sqrt(all.squares);
  return { { 4.0 * all.covariance / all.weights, 4.0 * root / (all.weights * std::sqrt(residuals.GetDof())) },
           all.signs / root };
}

void
SumOverSpace(CorrelationSums & sums, NoiseCorrelation & found)
{
  found.reach = FindReach(sums, found.beyondReach);
  const TileSums    all = sums.Total();
  const CommonNoise common = FindCommonNoise(all.shared);
  double            largest = 0.0;
  for (const std::size_t k : sums.Within(found.reach))
  {
    largest = std::max(largest, std::abs(sums.CoefficientOf(all, common, k)));
  }
  const MeasuredNumber far = SumOfCoefficients(sums, sums.Ring(InCorrelation.reachOfCharge + 1, found.reach));
  const bool           mayBeCharge = !sums.HasEchoes() && largest < InCorrelation.largestCrosstalk &&
                           !far.Exceeds(InCorrelation.smallRing, Significance.oneTest);
  if (mayBeCharge && found.reach > InCorrelation.reachOfCharge)
  {
    found.reach = InCorrelation.reachOfCharge; // the rings beyond are not significant
    found.beyondReach = std::max(std::abs(far.value), InCorrelation.unseenErrorsOfCharge * far.standardError);
  }
  const CorrelationSums::Lags lags = sums.Within(found.reach);
  const double                unfilteredDn2 = sums.GetQuantisationDn2() + found.LineNoise().value;
  const JackknifeEstimate     fits = FitAllShapes(
    sums,
    [&](const TileSums & tiles) { return sums.CovarianceInBins(tiles, lags); },
    sums.StandardErrorsInBins(lags),
    unfilteredDn2);
  const Eigen::VectorXd chi2 = fits.value.tail(NumberOfShapes);
  const Eigen::VectorXd withCurvature = chi2 + Chi2OfTotalVariance(sums, all, fits.value.head(NumberOfShapes));
  const auto            probabilities = ProbabilitiesOf(withCurvature, mayBeCharge, sums.GetResiduals().IsBlackKnown());
  found.shapes = WeighShapes(fits, probabilities, sums.ShapesOf(all, unfilteredDn2));
  // The negative covariance of a sharpening filter is proportional to the variance, and the same everywhere. The
  // covariance by rounding of blocks is neither.
  const double constant = probabilities[static_cast<std::size_t>(CovarianceShape::Constant)];
  const auto & shared = found.Shape(CovarianceShape::Variance).coefficient;
  const bool   isUnlikeFilter =
    constant > InCorrelation.roundingProbability || chi2.minCoeff() > InCorrelation.largestChi2;
  const bool isRounding = (shared.value < -Significance.hint * shared.standardError && isUnlikeFilter) ||
                          (shared.value < 0.0 && RmsOfPhases(sums.SumPhases()) > InCorrelation.largestRmsOfPhases);
  found.isByIllumination = !mayBeCharge && IsProportionalToSquare(fits);
  if (isRounding || found.isByIllumination)
  {
    found.kind = NoiseKind::NotLinear;
  }
  else if (found.kind != NoiseKind::Temporal)
  {
    const bool isNear =
      !SumOfCoefficients(sums, sums.Ring(2, found.reach)).Exceeds(InCorrelation.smallRing, Significance.oneTest);
    const auto probabilityOf = [&](CovarianceShape shape) { return found.Shape(shape).probability; };
    const bool isCharge =
      mayBeCharge && (isNear || probabilityOf(CovarianceShape::Signal) > probabilityOf(CovarianceShape::Variance));
    found.kind = probabilityOf(CovarianceShape::Square) > 0.5 ? NoiseKind::BrighterFatter
                 : isCharge                                   ? NoiseKind::Crosstalk
                                                              : NoiseKind::Filtered;
  }
}

} // namespace sensornoise
