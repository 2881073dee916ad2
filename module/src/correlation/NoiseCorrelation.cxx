// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"

#include "base/Eigen.h"
#include "base/Constants.h"
#include "base/ChiSquare.h"
#include "correlation/TotalCovariance.h"
#include "correlation/Constants.h"
#include "correlation/CorrelationSums.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Spatial distance [pixels] and temporal lags [frames] that are always evaluated. */
constexpr int FirstRings = 2;
constexpr int FirstTimeLags = 3;
/** Largest distance of a ring [pixels]. */
constexpr int AllRings = 16;

/** Returns the variance of line noise with its complete error. The jackknife does not include the scatter of the lines
 * themselves, as tiles side by side have the same \a lines. */
MeasuredNumber
LineVariance(const MeasuredNumber & ofTiles, double lines, double dof)
{
  const double chance = ofTiles.value * std::sqrt(2.0 / std::max(1.0, lines * dof));
  return { ofTiles.value,
           AddInQuadrature(ofTiles.standardError, chance, InCorrelation.fractionLostToComponents * ofTiles.value) };
}

/** Returns the numbers of rows and of columns of the frame that the tiles cover. */
std::pair<double, double>
LinesOf(const SampleTiles & tiles)
{
  std::set<std::size_t> rows;
  std::set<std::size_t> columns;
  for (const SampleTiles::Origin & origin : tiles.origins)
  {
    rows.insert(origin.y);
    columns.insert(origin.x);
  }
  const auto side = static_cast<double>(tiles.side);
  return { side * static_cast<double>(rows.size()), side * static_cast<double>(columns.size()) };
}

/** Sets coefficients, variances of line noise and kurtosis, with their errors. */
void
FindCoefficients(const CorrelationSums & sums, NoiseCorrelation & found)
{
  const CorrelationSums::Lags space = sums.Within(AllRings);
  const CorrelationSums::Lags within = sums.Within(found.reach);
  const CorrelationSums::Lags time = sums.TimeLags();
  const AutocovarianceFit     fit(sums.GetResiduals().GetBasis(), time.size(), sums.GetResiduals().GetTimes());
  const JackknifeEstimate     estimate = Jackknife(sums.GetTiles(), [&](const TileSums & tiles) {
    const CommonNoise   common = FindCommonNoise(tiles.shared);
    std::vector<double> figures{ common.rows[0], common.columns[0] };
    for (std::size_t k = 0; k < KurtosisSums::Kinds; ++k)
    {
      figures.push_back(tiles.kurtosis.Excess(k));
    }
    figures.push_back(tiles.kurtosis.UpperTailExcess());
    double total = 1.0;
    for (const std::size_t k : within)
    {
      total += 2.0 * sums.CoefficientOf(tiles, common, k);
    }
    figures.push_back(total);
    const Eigen::VectorXd inBins = sums.CovarianceInBins(tiles, within);
    figures.insert(figures.end(), inBins.data(), inBins.data() + inBins.size());
    for (const std::size_t k : space)
    {
      figures.push_back(sums.CoefficientOf(tiles, common, k));
    }
    const Eigen::VectorXd covariance = fit.Autocovariances(sums.ProductsOfFrames(tiles));
    for (Eigen::Index j = 1; j < covariance.size(); ++j)
    {
      figures.push_back(covariance(j) / covariance(0));
    }
    return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(figures.data(), static_cast<Eigen::Index>(figures.size())));
  });
  Eigen::Index                k = 0;
  const auto                  next = [&] {
    const MeasuredNumber number{ estimate.value(k), estimate.StandardError(k) };
    ++k;
    return number;
  };
  const NoiseResiduals & residuals = sums.GetResiduals();
  const auto [rows, columns] = LinesOf(residuals.GetTiles());
  found.rowsDn2 = LineVariance(next(), rows, residuals.GetDof());
  found.columnsDn2 = LineVariance(next(), columns, residuals.GetDof());
  std::generate(found.kurtosis.begin(), found.kurtosis.end(), next);
  found.upperTail = next();
  if (found.upperTail.value < 0.0)
  {
    // Tiles without a value in the tail do not scatter; the count of all tiles still does.
    const double significance = sums.Total().kurtosis.SignificanceOfDeficit();
    found.upperTail.standardError = std::max(found.upperTail.standardError, -found.upperTail.value / significance);
  }
  found.spaceFactor = next();
  for (MeasuredNumber & factor : found.spaceFactorOfBins)
  {
    factor = next();
    factor.value += 1.0;
  }
  found.space.clear();
  found.time.clear();
  for (const std::size_t lag : space)
  {
    found.space.push_back({ sums.GetLag(lag), next() });
  }
  for (const std::size_t lag : time)
  {
    found.time.push_back({ sums.GetLag(lag), next() });
  }
}

/** Corrects the kurtosis for temporal correlation. The kurtosis of a series is relative to its own variance, whose
 * scatter depends on the correlation of the frames. For normal noise of the covariance S = P R P, E[sum r^4] = 3 sum_t
 * S_tt^2 and E[(sum r^2)^2] = (tr S)^2 + 2 tr S^2. */
void
CorrectKurtosisForTemporalCorrelation(const NoiseResiduals & residuals, NoiseCorrelation & found)
{
  const Eigen::MatrixXd & basis = residuals.GetBasis();
  const Eigen::MatrixXd   shared = CorrelationOfFrames(found.time, basis.rows(), residuals.GetTimes());
  const Eigen::MatrixXd   projection = ResidualProjection(basis);
  const auto              kurtosisOf = [](const Eigen::MatrixXd & covariance) {
    const double trace = covariance.trace();
    return covariance.diagonal().squaredNorm() / (trace * trace + 2.0 * covariance.squaredNorm());
  };
  const double factor = kurtosisOf(projection) / kurtosisOf(projection * shared * projection);
  for (MeasuredNumber & kurtosis : found.kurtosis)
  {
    kurtosis.value = factor * (kurtosis.value + 3.0) - 3.0;
    kurtosis.standardError *= factor;
  }
}

/** Sets NoiseCorrelation::kurtosisOfSteps. */
void
CompareSteps(const NoiseResiduals & residuals, const ParallelFor & parallelFor, NoiseCorrelation & found)
{
  const Eigen::MatrixXd  shared = CorrelationOfFrames(found.time, residuals.GetBasis().rows(), residuals.GetTimes());
  const MeasuredNumber & own = found.kurtosis.front();
  const double           ratio = KurtosisRatioOfRecursion(found.time.front().coefficient.value);
  found.kurtosisOfSteps = KurtosisOfFrameDifferences(residuals, shared, parallelFor);
  found.kurtosisOfSteps.value -= ratio * std::max(0.0, own.value);
  found.kurtosisOfSteps.standardError = std::hypot(found.kurtosisOfSteps.standardError, ratio * own.standardError);
}

/** Returns whether the distribution agrees with normal noise, or with few electrons, after a linear filter. */
bool
IsLinear(const CorrelationSums & sums, const NoiseCorrelation & found)
{
  // Rounding to a step has the variance q = step^2 / 12, and an excess kurtosis of -1.2 (q / V)^2.
  const TileSums all = sums.Total();
  double         square = 0.0;
  for (const PairSums & bin : all.lags[0].bins)
  {
    const double inverse = bin.pairs > 0.0 ? bin.constant / bin.pairs : 0.0;
    square += inverse * inverse / static_cast<double>(NoiseResiduals::IntensityBins);
  }
  MeasuredNumber own = found.kurtosis[0];
  own.value += 1.2 * sums.GetQuantisationDn2() * sums.GetQuantisationDn2() * square;
  if (found.LacksTail() || (own.value < 0.0 && own.Exceeds(InCorrelation.largestExcess, Significance.severalTests)))
  {
    return false;
  }
  return std::none_of(found.kurtosis.begin() + 1, found.kurtosis.end(), [&](MeasuredNumber more) {
    // Few electrons and a strong change of the illumination increase both kurtoses, and the kurtosis of single pixels
    // more.
    more.value -= std::max(0.0, own.value);
    return more.value > 0.0 && more.Exceeds(InCorrelation.largestExcess, Significance.severalTests);
  });
}

/** Returns the covariance of a frame with the two beside it, relative to the variance, if it is significant; else 0. */
double
CovarianceBeside(const std::vector<LagCoefficient> & time)
{
  if (time.empty() || !time.front().coefficient.Exceeds(0.0, Significance.oneTest))
  {
    return 0.0;
  }
  return 2.0 * std::abs(time.front().coefficient.value);
}

void
AddIfSignificant(const MeasuredNumber & variance, MeasuredNumber & sum)
{
  if (variance.value > Significance.severalTests * variance.standardError)
  {
    sum.value += variance.value;
    sum.standardError = std::hypot(sum.standardError, variance.standardError);
  }
}
} // namespace

const char *
NameOf(NoiseKind kind)
{
  switch (kind)
  {
    case NoiseKind::White:
      return "white";
    case NoiseKind::Crosstalk:
      return "crosstalk";
    case NoiseKind::Filtered:
      return "filtered";
    case NoiseKind::Temporal:
      return "temporal";
    case NoiseKind::Enlarged:
      return "enlarged";
    case NoiseKind::BrighterFatter:
      return "brighter-fatter";
    case NoiseKind::NotLinear:
      return "not-linear";
    case NoiseKind::NotMeasured:
      break;
  }
  return "not-measured";
}

bool
MeasuredNumber::Exceeds(double least, double z) const
{
  return std::abs(value) > least + z * standardError;
}

MeasuredNumber
NoiseCorrelation::LineNoise() const
{
  MeasuredNumber sum;
  AddIfSignificant(rowsDn2, sum);
  AddIfSignificant(columnsDn2, sum);
  return sum;
}

MeasuredNumber
NoiseCorrelation::SignificantStructuredNoise() const
{
  MeasuredNumber sum = this->LineNoise();
  for (const PeriodicInterference & wave : interference)
  {
    AddIfSignificant(wave.varianceDn2, sum);
  }
  return sum;
}

MeasuredNumber
NoiseCorrelation::StructuredNoiseWithScatter() const
{
  // A wave along the columns makes distant pixels of a column opposite, and their covariance negative.
  MeasuredNumber sum{ std::max(0.0, rowsDn2.value) + std::max(0.0, columnsDn2.value),
                      std::hypot(rowsDn2.standardError, columnsDn2.standardError) };
  for (const PeriodicInterference & wave : interference)
  {
    sum.value += wave.varianceDn2.value;
    sum.standardError = std::hypot(sum.standardError, wave.varianceDn2.standardError);
  }
  return sum;
}

bool
NoiseCorrelation::LacksTail() const
{
  return upperTail.value < -InCorrelation.largestTailDeficit &&
         upperTail.value < -Significance.severalTests * upperTail.standardError;
}

bool
NoiseCorrelation::MixesByDifference() const
{
  return kurtosisOfSteps.value > 0.0 &&
         kurtosisOfSteps.Exceeds(InCorrelation.largestExcessOfSteps, Significance.severalTests);
}

bool
NoiseCorrelation::DetailsChange() const
{
  return brightCovariance.value > 0.0 &&
         brightCovariance.Exceeds(InCorrelation.leastBrightCovariance, Significance.severalTests);
}

bool
NoiseCorrelation::HasLocalMotion() const
{
  return localMotion.value > 0.0 && localMotion.Exceeds(InCorrelation.leastLocalMotion, Significance.severalTests);
}

double
NoiseCorrelation::ProbabilityOfLateNoise() const
{
  const auto half = shapes.begin() + static_cast<std::size_t>(CovarianceShape::FirstPart) + PartsAfterFilter / 2 - 1;
  return std::accumulate(
    half, shapes.end(), 0.0, [](double sum, const WeightedShape & shape) { return sum + shape.probability; });
}

double
VarianceInflation(const std::vector<LagCoefficient> & lags)
{
  double sum = 1.0;
  for (const LagCoefficient & lag : lags)
  {
    const double chance = lag.coefficient.standardError * lag.coefficient.standardError;
    sum += 2.0 * std::max(0.0, lag.coefficient.value * lag.coefficient.value - chance);
  }
  return sum;
}

NoiseCorrelation
MeasureNoiseCorrelation(const NoiseResiduals & residuals, double quantisationDn2, const ParallelFor & parallelFor)
{
  if (!residuals.HasEnoughPixels() || residuals.GetDof() < InCorrelation.leastDof)
  {
    return {};
  }
  CorrelationSums sums(residuals, quantisationDn2, FirstRings, FirstTimeLags, parallelFor);
  sums.AddEchoes();
  NoiseCorrelation found;
  found.kind = NoiseKind::White;
  found.interference = residuals.GetInterference();
  FindCoefficients(sums, found);
  const bool inTime = IsCorrelatedInTime(sums, found.time);
  const bool inSpace = sums.HasEchoes() || IsCorrelatedInSpace(sums, found.space);
  if (inTime)
  {
    SumOverTime(sums, found);
  }
  else
  {
    found.timeFactor.standardError = CovarianceBeside(found.time);
  }
  if (inSpace)
  {
    SumOverSpace(sums, found);
    found.covarianceLines = FitCovarianceLines(sums, sums.Within(found.reach));
  }
  else if (!inTime)
  {
    const BrightCovariance bright = MeasureBrightCovariance(sums, parallelFor);
    if (bright.sum.value > InCorrelation.leastBrightCovariance && bright.z > Significance.severalTests)
    {
      found.brightCovariance = bright.sum;
    }
  }
  if (inTime || inSpace)
  {
    FindCoefficients(sums, found); // for all lags that were added
  }
  if (inTime)
  {
    CorrectKurtosisForTemporalCorrelation(residuals, found);
    CompareSteps(residuals, parallelFor, found);
    found.upperTail = {}; // common changes of the frames, as flicker, need not be normally distributed
  }
  if (found.isBySensitivity || found.DetailsChange() || found.MixesByDifference() || !IsLinear(sums, found))
  {
    found.kind = NoiseKind::NotLinear;
  }
  if (inSpace && found.kind != NoiseKind::NotLinear)
  {
    found.enlargement = FindEnlargementTrace(residuals, parallelFor);
    found.kind = found.enlargement ? NoiseKind::Enlarged : found.kind;
  }
  return found;
}

void
MeasureSettledFrames(NoiseCorrelation &  correlation,
                     NoiseResiduals &    residuals,
                     double              quantisationDn2,
                     const ParallelFor & parallelFor)
{
  if (correlation.kind == NoiseKind::Temporal)
  {
    residuals.DropFirst(
      std::min(InCorrelation.firstFrames, residuals.GetTiles().frames / InCorrelation.firstFramesOneIn), parallelFor);
    correlation = MeasureNoiseCorrelation(residuals, quantisationDn2, parallelFor);
  }
}

} // namespace sensornoise
