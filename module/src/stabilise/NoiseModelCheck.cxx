// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "stabilise/NoiseModelCheck.h"

#include "base/Quantiles.h"
#include "base/Text.h"
#include "sensornoise/NoiseModel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Limit of the integration of a normal distribution [standard deviations]: the probability beyond is less than
 * 1e-23. */
constexpr double Reach = 10.0;

double
NormalDensity(double n)
{
  return std::exp(-0.5 * n * n) * 0.39894228040143268;
}

double
NormalDistribution(double n)
{
  return 0.5 * std::erfc(-n * 0.70710678118654752);
}

/** Returns E sqrt(max(0, m + s n)) for standard normal n. The trapezoidal rule is exact but for rounding if the
 * integrand is analytic and vanishes at both ends. The integral is over n if the branch point of the root is out of
 * reach, else over w = sqrt(m + s n), in which the integrand is even and analytic. */
double
MeanRoot(double m, double s)
{
  if (s == 0.0)
  {
    return std::sqrt(std::max(0.0, m));
  }
  double sum = 0.0;
  if (m > (Reach + 2.0) * s)
  {
    constexpr int    nodes = 80;
    constexpr double step = 2.0 * Reach / nodes;
    for (int i = 0; i <= nodes; ++i)
    {
      const double n = i * step - Reach;
      sum += std::sqrt(m + s * n) * NormalDensity(n);
    }
    return sum * step;
  }
  constexpr int nodes = 800;
  const double  step = std::sqrt(std::max(0.0, m + Reach * s)) / nodes;
  for (int i = 1; i <= nodes; ++i) // the integrand is 0 at w = 0
  {
    const double w = i * step;
    sum += 2.0 * w * w * NormalDensity((w * w - m) / s) / s;
  }
  return sum * step;
}

/** Returns E max(0, m + s n) for standard normal n. */
double
MeanArgument(double m, double s)
{
  return s == 0.0 ? std::max(0.0, m) : m * NormalDistribution(m / s) + s * NormalDensity(m / s);
}
} // namespace

StabilisedMoments
MomentsOfStabilised(double electrons, double readNoiseElectrons)
{
  if (!(electrons >= 0.0 && electrons <= 1e6 && readNoiseElectrons >= 0.0 && readNoiseElectrons <= 1000.0))
  {
    throw std::invalid_argument("the law of " + Text(electrons) + " electrons and a read noise of " +
                                Text(readNoiseElectrons) + " electrons; expected 0 to 1e6, and 0 to 1000");
  }
  const double s = readNoiseElectrons;
  const double least = s * s + 0.375;
  const double reach = 9.0 * std::sqrt(electrons) + 40.0;
  const double first = std::max(0.0, std::floor(electrons - reach));
  const double last = electrons > 0.0 ? std::ceil(electrons + reach) : 0.0;
  // Sums about the middle, so that the variance is not lost by cancellation.
  const double middle = std::sqrt(electrons + least);
  double       total = 0.0;
  double       root = 0.0;
  double       square = 0.0;
  double       negative = 0.0;
  for (double k = first; k <= last; ++k)
  {
    // The sign that lgamma stores for all threads is not used. NOLINTNEXTLINE(concurrency-mt-unsafe)
    const double logFactorial = std::lgamma(k + 1.0);
    const double probability = electrons > 0.0 ? std::exp(k * std::log(electrons) - electrons - logFactorial) : 1.0;
    const double meanRoot = MeanRoot(k + least, s);
    total += probability;
    root += probability * (meanRoot - middle);
    square += probability * (MeanArgument(k + least, s) - 2.0 * middle * meanRoot + middle * middle);
    negative += s == 0.0 ? 0.0 : probability * NormalDistribution(-(k + least) / s);
  }
  root /= total; // the rounding error of lgamma is common to all terms
  square /= total;
  return { 2.0 * (middle + root), 4.0 * (square - root * root), negative / total };
}

namespace
{
using Band = NoiseModelCheck::Band;

/** Number of bands. They have equal widths in the square root of the level, so that each spans a similar multiple of
 * the noise. */
constexpr std::size_t Bands = 12;
/** Deviation of a band's ratio from 1 that is accepted in a check of a noise model, whatever its error [1]. */
constexpr double Tolerance = 0.02;
// Deviation in standard errors that is accepted. With three, one of a dozen bands of a correct model would fail by
// chance in every 30th check, and the model has errors, too.
constexpr double StandardErrors = 4.0;
/** Standard error of a ratio below which the ratio counts as measured [1]. */
constexpr double LargestError = 0.05;
/** Number of electrons above which the variance after the transform is 1 within 0.016 for any read noise [e-]. */
constexpr double EnoughElectrons = 10.0;
/** Median of chi-square with one degree of freedom. */
constexpr double MedianOfSquare = 0.4549364;

/** Returns the variance of the error of each bin's ratio, relative to the square of the ratio. */
std::vector<double>
RelativeErrors2(const Report & frames)
{
  const double        dof = std::max(1.0, static_cast<double>(frames.framesDistinct) - 1.0);
  std::vector<double> errors2;
  for (const std::size_t count : frames.scatter.count)
  {
    errors2.push_back(2.0 / (static_cast<double>(count) * dof));
  }
  return errors2;
}

/** Returns the squared difference of the ratios of neighbouring bins over its expectation from the number of pixels and
 * frames, as a median over the bins; at least 1. */
double
ExcessScatter(const Report::Scatter & scatter, const VarianceModel & model, const std::vector<double> & errors2)
{
  std::vector<double> squares;
  for (std::size_t i = 1; i < errors2.size(); ++i)
  {
    const double before = model(scatter.mean[i - 1]);
    const double after = model(scatter.mean[i]);
    if (before > 0.0 && after > 0.0 && scatter.correctedVariance[i] > 0.0)
    {
      const double a = scatter.correctedVariance[i - 1] / before;
      const double b = scatter.correctedVariance[i] / after;
      squares.push_back((b - a) * (b - a) / (a * a * errors2[i - 1] + b * b * errors2[i]));
    }
  }
  constexpr std::size_t least = 16;
  return squares.size() < least ? 1.0 : std::max(1.0, QuantileOf(std::move(squares), 0.5) / MedianOfSquare);
}

/** Returns the bins [begin, end) as one band. */
NoiseModelCheck::Band
MakeBand(const Report::Scatter &     scatter,
         std::size_t                 begin,
         std::size_t                 end,
         const VarianceModel &       model,
         const std::vector<double> & errors2,
         double                      excess)
{
  NoiseModelCheck::Band band;
  band.lowDn = scatter.mean[begin];
  band.highDn = scatter.mean[end - 1];
  double sum = 0.0;
  double weights = 0.0;
  bool   hasVariance = true;
  for (std::size_t i = begin; i < end; ++i)
  {
    const double expected = model(scatter.mean[i]);
    hasVariance = hasVariance && expected > 0.0;
    sum += scatter.correctedVariance[i] / expected / errors2[i];
    weights += 1.0 / errors2[i];
    band.pixels += scatter.count[i];
  }
  if (!hasVariance)
  {
    return band;
  }
  band.ratio = sum / weights;
  band.standardError = std::abs(*band.ratio) * std::sqrt(excess / weights);
  return band;
}

/** Returns the error that sorting adds to the ratio of the first and the last band, for one standard deviation of a
 * mean and a band of \a bins bins [1]. The means by which pixels are sorted have noise. The first and the last bin hold
 * the pixels whose mean is lower, or higher, by chance. */
double
SortingError(const NoiseModelCheck::Band & band, const VarianceModel & model, double frames, std::size_t bins)
{
  const double variance = model(band.lowDn);
  if (!(variance > 0.0))
  {
    return 0.0;
  }
  const double step = std::sqrt(variance); // within this step the model is nearly a line
  const double slope = std::abs(model(band.lowDn + step) - variance) / step;
  return slope / std::sqrt(variance * frames) / static_cast<double>(bins);
}

/** Returns whether a band's ratio is near 1. \a sortingError is 0 except for the first and the last band. */
bool
Fits(const NoiseModelCheck::Band & band, double tolerance, double sortingError)
{
  const double deviation = std::abs(band.ratio.value_or(0.0) - 1.0);
  return band.ratio && (deviation <= tolerance + sortingError || deviation <= StandardErrors * band.standardError);
}

/** Returns the variance after the transform at a level for a correct model [1]; null if it cannot be computed. */
std::optional<double>
TransformVariance(const NoiseModel & model, double levelDn, std::optional<double> readNoiseElectrons)
{
  const double electrons2 = model.VarianceAt(levelDn) / (model.varianceSlopeDn * model.varianceSlopeDn);
  if (!(electrons2 > 0.0) || (!readNoiseElectrons && electrons2 < EnoughElectrons))
  {
    return std::nullopt;
  }
  const double readNoise = std::clamp(readNoiseElectrons.value_or(0.0), 0.0, std::min(1000.0, std::sqrt(electrons2)));
  const double electrons = std::clamp(electrons2 - readNoise * readNoise, 0.0, 1e6); // rounding could make it negative
  return MomentsOfStabilised(electrons, readNoise).variance;
}

NoiseModelCheck::Verdict
VerdictOf(const std::vector<NoiseModelCheck::Band> & bands)
{
  const auto isDetermined = [](const NoiseModelCheck::Band & band) { return band.standardError < LargestError; };
  if (!std::all_of(bands.begin(), bands.end(), [](const auto & band) { return band.fits; }))
  {
    return NoiseModelCheck::Verdict::DoesNotFit;
  }
  const auto determined = static_cast<std::size_t>(std::count_if(bands.begin(), bands.end(), isDetermined));
  return 2 * determined >= bands.size() ? NoiseModelCheck::Verdict::Fits : NoiseModelCheck::Verdict::NotDetermined;
}
} // namespace

NoiseModelCheck
CheckVariance(const Report & frames, const VarianceModel & model, const std::function<double(double)> & tolerance)
{
  NoiseModelCheck         check;
  const Report::Scatter & scatter = frames.scatter;
  const std::size_t       bins = scatter.mean.size();
  const bool              isMeasured = bins > 0 && std::all_of(scatter.correctedVariance.begin(),
                                                  scatter.correctedVariance.end(),
                                                  [](double variance) { return std::isfinite(variance); });
  if (isMeasured)
  {
    const std::vector<double> errors2 = RelativeErrors2(frames);
    const double              excess = ExcessScatter(scatter, model, errors2);
    const double              zero = scatter.mean.front();
    const auto                bandOf = [&](std::size_t bin) {
      const double fraction = std::sqrt((scatter.mean[bin] - zero) / std::max(scatter.mean.back() - zero, 1e-300));
      return std::min(Bands - 1, static_cast<std::size_t>(fraction * Bands));
    };
    for (std::size_t begin = 0; begin < bins;)
    {
      std::size_t end = begin + 1;
      while (end < bins && bandOf(end) == bandOf(begin))
      {
        ++end;
      }
      check.bands.push_back(MakeBand(scatter, begin, end, model, errors2, excess));
      Band &     band = check.bands.back();
      const bool isEnd = begin == 0 || end == bins;
      const auto distinct = static_cast<double>(frames.framesDistinct);
      band.fits = Fits(band,
                       std::max(tolerance(band.lowDn), tolerance(0.5 * (band.lowDn + band.highDn))),
                       isEnd ? SortingError(band, model, distinct, end - begin) : 0.0);
      begin = end;
    }
    check.verdict = VerdictOf(check.bands);
  }
  check.sentence = MakeCheckSentence(check, frames);
  return check;
}

NoiseModelCheck
CheckNoiseModel(const Report & frames, const NoiseModel & model, std::optional<double> readNoiseElectrons)
{
  model.Validate();
  const auto      variance = [&model](double levelDn) { return model.VarianceAt(levelDn); };
  NoiseModelCheck check = CheckVariance(frames, variance, [](double) { return Tolerance; });
  for (Band & band : check.bands)
  {
    band.transformVariance = TransformVariance(model, 0.5 * (band.lowDn + band.highDn), readNoiseElectrons);
  }
  return check;
}

NoiseModelCheck
CheckReport(const Report & frames, const Report & report)
{
  NoiseModelCheck check = CheckNoiseModel(frames, NoiseModelOf(report), report.readNoiseElectrons.value);
  if (frames.quantisationStepDn && report.quantisationStepDn &&
      *frames.quantisationStepDn != *report.quantisationStepDn)
  {
    check.sentence += "; its digital numbers are " + Text(*report.quantisationStepDn) +
                      " DN apart, the numbers of these frames " + Text(*frames.quantisationStepDn) +
                      " DN: it may be of another scale";
  }
  return check;
}

} // namespace sensornoise
