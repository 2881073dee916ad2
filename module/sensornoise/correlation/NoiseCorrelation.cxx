/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/correlation/NoiseCorrelation.h"

#include "sensornoise/correlation/CommonNoise.h"
#include "sensornoise/correlation/Jackknife.h"
#include "sensornoise/correlation/SharedShapes.h"
#include "sensornoise/correlation/TemporalMixing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace sensornoise
{

namespace
{
/** Tiles and pixels below which nothing is measured. */
constexpr std::size_t LeastTiles = 4;
constexpr std::size_t LeastPixels = 1024;
constexpr double      LeastFreedom = 3.0;

/** Coefficient that is worth a word [1]. Set by hand: charge coupling of 0.3 % makes 0.006 of it, noise of a whole
 * frame's plain sample 0.0004 to 0.0007. */
constexpr double LeastCoefficient = 0.002;
/** What the nearest four share together that is worth a word, relative to the variance of the bright pixels [1]. */
constexpr double LeastEffect = 0.005;
/** The same between frames: slow drifts of a few pixels make 0.003 of it. */
constexpr double LeastTimeCoefficient = 0.01;
/** Standard errors by which a coefficient must exceed it: that of the nearest neighbours, and any of the others. */
constexpr double NearestZ = 3.0;
constexpr double AnyZ = 4.0;

/** What a further ring, or further frames, may add to the sum without being looked at, of the sum [1]. */
constexpr double SmallRing = 0.005;
constexpr int    LargestReach = 5;
constexpr int    FirstTimeLags = 3;
constexpr int    MostTimeLags = 24;

/** Error of the sum over frames per square of the part of the frames' freedom that is projected out [1]. Set by hand:
 * filters of 0.2 to 0.6 of the last frame, 50 frames, 10 to 18 series; half covers 80 %, twice 99 %. */
constexpr double ErrorOfMixing = 0.25;

/** Coefficient up to which charge may be coupled [1]: sensors have a few hundredths. */
constexpr double LargestCrosstalk = 0.06;
/** Evidence that a rarer shape needs, as a difference of chi-squares: 2 ln 20. */
constexpr double EvidenceOfRareShape = 2.0;
/** Probability from which what neighbours share, with the opposite sign, is taken for the rounding of blocks [1]. */
constexpr double RoundingProbability = 0.05;
/** The same, of the best shape: the 99 % quantile for four bins [1]. */
constexpr double LargestChi2OfShapes = 11.3;
/** Excess kurtosis that no linear filter leaves [1]. Set by hand: the correction of defects at 3 standard deviations
 * makes -0.06 to -0.08 of the noise and 0.1 to 0.25 of four neighbours in turn, white and filtered noise 0.01. */
constexpr double LargestExcess = 0.04;
constexpr double ExcessZ = 4.0;

/** All sums of a tile. */
struct TileSums
{
  std::vector<LagSums> lags;
  SharedLight          shared;
  KurtosisSums         kurtosis;

  TileSums &
  operator+=(const TileSums & other)
  {
    lags.resize(other.lags.size());
    for (std::size_t k = 0; k < lags.size(); ++k)
    {
      lags[k] += other.lags[k];
    }
    shared += other.shared;
    kurtosis += other.kurtosis;
    return *this;
  }
};

double
Ratio(double sum, double count)
{
  return count > 0.0 ? sum / count : 0.0;
}

MeasuredNumber
NumberOf(const JackknifeEstimate & estimate, Eigen::Index k)
{
  return { estimate.value(k), estimate.StandardError(k) };
}

class Measurement
{
public:
  Measurement(const NoiseResiduals & residuals, double codesDn2, const ParallelFor & parallelFor)
    : m_Residuals(residuals)
    , m_CodesDn2(codesDn2)
    , m_ParallelFor(parallelFor)
    , m_Tiles(residuals.GetTiles().origins.size())
  {}

  NoiseCorrelation
  Run()
  {
    const std::vector<SharedLight>  shared = SumSharedLight(m_Residuals, m_ParallelFor);
    const std::vector<KurtosisSums> kurtosis = SumKurtosis(m_Residuals, m_ParallelFor);
    for (std::size_t i = 0; i < m_Tiles.size(); ++i)
    {
      m_Tiles[i].shared = shared[i];
      m_Tiles[i].kurtosis = kurtosis[i];
    }
    this->AddLags({ Lag{} });
    this->AddRing(1);
    this->AddRing(2);
    this->AddTimeLags(FirstTimeLags);
    this->FindCoefficients();
    m_Found.kind = NoiseKind::White;
    if (this->SharesInTime())
    {
      this->SumOverTime();
    }
    if (this->SharesInSpace())
    {
      this->SumOverSpace();
    }
    if (!this->IsLinear())
    {
      m_Found.kind = NoiseKind::NotLinear;
    }
    return m_Found;
  }

private:
  void
  AddLags(const std::vector<Lag> & lags)
  {
    const auto sums = SumLags(m_Residuals, lags, m_ParallelFor);
    for (std::size_t i = 0; i < m_Tiles.size(); ++i)
    {
      m_Tiles[i].lags.insert(m_Tiles[i].lags.end(), sums[i].begin(), sums[i].end());
    }
    m_Lags.insert(m_Lags.end(), lags.begin(), lags.end());
  }
  /** Half of the lags at distance \a reach. */
  void
  AddRing(int reach)
  {
    std::vector<Lag> lags;
    for (int y = 0; y <= reach; ++y)
    {
      for (int x = -reach; x <= reach; ++x)
      {
        if (std::max(std::abs(x), y) == reach && (y > 0 || x > 0))
        {
          lags.push_back({ x, y, 0 });
        }
      }
    }
    this->AddLags(lags);
  }
  void
  AddTimeLags(int last)
  {
    const int        frames = static_cast<int>(m_Residuals.GetTiles().frames);
    std::vector<Lag> lags;
    for (int t = m_TimeLags + 1; t <= std::min(last, frames / 3); ++t)
    {
      lags.push_back({ 0, 0, t });
    }
    m_TimeLags += static_cast<int>(lags.size());
    this->AddLags(lags);
  }
  /** The index of each lag of a kind. */
  template <typename TPredicate>
  std::vector<std::size_t>
  LagsWhere(TPredicate predicate) const
  {
    std::vector<std::size_t> found;
    for (std::size_t k = 1; k < m_Lags.size(); ++k)
    {
      if (predicate(m_Lags[k]))
      {
        found.push_back(k);
      }
    }
    return found;
  }
  std::vector<std::size_t>
  Ring(int first, int last) const
  {
    return this->LagsWhere([=](const Lag & lag) {
      const int reach = std::max(std::abs(lag.x), std::abs(lag.y));
      return lag.t == 0 && reach >= first && reach <= last;
    });
  }
  std::vector<std::size_t>
  TimeLags() const
  {
    return this->LagsWhere([](const Lag & lag) { return lag.t > 0; });
  }

  /** Coefficient of a lag in space, of all bins. */
  double
  CoefficientOf(const TileSums & sums, const CommonNoise & common, std::size_t k) const
  {
    const PairSums total = common.TakeOff(sums.lags[k], m_Lags[k]).Total();
    return Ratio(total.covariance, total.pairs);
  }
  /** Autocovariances over time in units of the typical variance. */
  Eigen::VectorXd
  Autocovariance(const TileSums & sums, const Eigen::MatrixXd & mixing) const
  {
    const std::vector<std::size_t> lags = this->TimeLags();
    Eigen::VectorXd                found(lags.size() + 1);
    for (std::size_t j = 0; j <= lags.size(); ++j)
    {
      const PairSums total = sums.lags[j == 0 ? 0 : lags[j - 1]].Total();
      found(static_cast<Eigen::Index>(j)) = Ratio(total.covariance, total.pairs);
    }
    return mixing.fullPivLu().solve(Eigen::VectorXd(m_Residuals.GetFreedom() * found));
  }

  void
  FindCoefficients()
  {
    const std::vector<std::size_t> space = this->Ring(1, LargestReach + 1);
    const std::vector<std::size_t> time = this->TimeLags();
    const Eigen::MatrixXd          mixing = TemporalMixing(m_Residuals.GetBasis(), time.size());
    const JackknifeEstimate        estimate = Jackknife(m_Tiles, [&](const TileSums & sums) {
      const CommonNoise   common = FindCommonNoise(sums.shared);
      std::vector<double> figures{ common.rows[0], common.columns[0] };
      for (std::size_t k = 0; k < KurtosisSums::Kinds; ++k)
      {
        figures.push_back(sums.kurtosis.Excess(k));
      }
      for (const std::size_t k : space)
      {
        figures.push_back(this->CoefficientOf(sums, common, k));
      }
      const Eigen::VectorXd covariance = this->Autocovariance(sums, mixing);
      for (std::size_t j = 1; j <= time.size(); ++j)
      {
        figures.push_back(covariance(static_cast<Eigen::Index>(j)) / covariance(0));
      }
      return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(figures.data(), static_cast<Eigen::Index>(figures.size())));
    });
    Eigen::Index                   k = 0;
    m_Found.rowsDn2 = NumberOf(estimate, k++);
    m_Found.columnsDn2 = NumberOf(estimate, k++);
    for (MeasuredNumber & kurtosis : m_Found.kurtosis)
    {
      kurtosis = NumberOf(estimate, k++);
    }
    m_Found.space.clear();
    m_Found.time.clear();
    for (const std::size_t lag : space)
    {
      m_Found.space.push_back({ m_Lags[lag], NumberOf(estimate, k++) });
    }
    for (const std::size_t lag : time)
    {
      m_Found.time.push_back({ m_Lags[lag], NumberOf(estimate, k++) });
    }
  }

  /** Whether the nearest neighbours together, or any neighbour, share more than a trifle. What grows with the light is
   * looked for where it is bright. */
  bool
  SharesInSpace() const
  {
    const std::vector<std::size_t> nearest =
      this->LagsWhere([](const Lag & lag) { return lag.t == 0 && std::abs(lag.x) + std::abs(lag.y) == 1; });
    const Eigen::VectorXd   errors = this->ErrorsInBins(nearest);
    const JackknifeEstimate atTheTop = Jackknife(m_Tiles, [&](const TileSums & sums) {
      const Eigen::MatrixXd shapes = PredictShapes(sums.lags[0], m_CodesDn2);
      const auto            fits = FitShapes(shapes, this->SharedInBins(sums, nearest), errors);
      Eigen::VectorXd       effects(NumberOfShapes - 1);
      for (Eigen::Index k = 0; k < effects.size(); ++k)
      {
        effects(k) = fits[static_cast<std::size_t>(k)].coefficient * shapes(shapes.rows() - 1, k);
      }
      return effects;
    });
    for (Eigen::Index k = 0; k < atTheTop.value.size(); ++k)
    {
      if (NumberOf(atTheTop, k).Exceeds(LeastEffect, NearestZ))
      {
        return true;
      }
    }
    return std::any_of(m_Found.space.begin(), m_Found.space.end(), [](const LagCoefficient & lag) {
      return lag.coefficient.Exceeds(LeastCoefficient, AnyZ);
    });
  }

  /** Twice the sum of the coefficients of some lags. */
  MeasuredNumber
  SumOf(const std::vector<std::size_t> & lags) const
  {
    return NumberOf(Jackknife(m_Tiles,
                              [&](const TileSums & sums) {
                                const CommonNoise common = FindCommonNoise(sums.shared);
                                double            sum = 0.0;
                                for (const std::size_t k : lags)
                                {
                                  sum += 2.0 * this->CoefficientOf(sums, common, k);
                                }
                                return Eigen::VectorXd(Eigen::VectorXd::Constant(1, sum));
                              }),
                    0);
  }

  /** The reach grows until the next ring adds little, or nothing that is seen. */
  int
  FindReach()
  {
    for (int reach = 1;; ++reach)
    {
      if (reach > 1)
      {
        this->AddRing(reach + 1);
      }
      const MeasuredNumber next = this->SumOf(this->Ring(reach + 1, reach + 1));
      const double         inside = 1.0 + this->SumOf(this->Ring(1, reach)).value;
      const double         size = std::abs(next.value);
      if (size < SmallRing * std::abs(inside) || size < next.standardError || reach == LargestReach)
      {
        m_Found.beyondReach = std::max(size, 0.5 * next.standardError);
        return reach;
      }
    }
  }

  /** What all neighbours within reach share, relative to the variance, in the bins of the light. */
  Eigen::VectorXd
  SharedInBins(const TileSums & sums, const std::vector<std::size_t> & lags) const
  {
    const CommonNoise common = FindCommonNoise(sums.shared);
    Eigen::VectorXd   shared = Eigen::VectorXd::Zero(NoiseResiduals::LightBins);
    for (const std::size_t k : lags)
    {
      const LagSums lag = common.TakeOff(sums.lags[k], m_Lags[k]);
      for (std::size_t b = 0; b < lag.bins.size(); ++b)
      {
        shared(static_cast<Eigen::Index>(b)) += 2.0 * Ratio(lag.bins[b].covariance, lag.bins[b].pairs);
      }
    }
    return shared;
  }

  Eigen::VectorXd
  ErrorsInBins(const std::vector<std::size_t> & lags) const
  {
    const JackknifeEstimate shared =
      Jackknife(m_Tiles, [&](const TileSums & sums) { return this->SharedInBins(sums, lags); });
    return shared.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  }

  void
  SumOverSpace()
  {
    const int                      reach = this->FindReach();
    const std::vector<std::size_t> lags = this->Ring(1, reach);
    this->FindCoefficients();
    const Eigen::VectorXd   errors = this->ErrorsInBins(lags);
    const JackknifeEstimate fits = Jackknife(m_Tiles, [&](const TileSums & sums) {
      const auto shapes = FitShapes(PredictShapes(sums.lags[0], m_CodesDn2), this->SharedInBins(sums, lags), errors);
      Eigen::VectorXd figures(2 * NumberOfShapes);
      for (std::size_t k = 0; k < NumberOfShapes; ++k)
      {
        figures(static_cast<Eigen::Index>(k)) = shapes[k].coefficient;
        figures(static_cast<Eigen::Index>(NumberOfShapes + k)) = shapes[k].chi2;
      }
      return figures;
    });
    double                  largest = 0.0;
    for (const LagCoefficient & lag : m_Found.space)
    {
      largest = std::max(largest, std::abs(lag.coefficient.value));
    }
    const bool mayBeCharge = largest < LargestCrosstalk && reach <= 2;
    const auto weightOf = [&](ShapeOfShared shape, double evidence) {
      return std::exp(-0.5 * (fits.value(static_cast<Eigen::Index>(NumberOfShapes) + static_cast<Eigen::Index>(shape)) +
                              evidence - fits.value.tail(NumberOfShapes).minCoeff()));
    };
    const double variance = weightOf(ShapeOfShared::Variance, 0.0);
    const double light = mayBeCharge ? weightOf(ShapeOfShared::Light, 0.0) : 0.0;
    const double square = mayBeCharge ? weightOf(ShapeOfShared::Square, EvidenceOfRareShape) : 0.0;
    const double constant = weightOf(ShapeOfShared::Constant, EvidenceOfRareShape);
    const double sum = std::max(1e-300, variance + light + square + constant);
    m_Found.ofVariance = { NumberOf(fits, static_cast<Eigen::Index>(ShapeOfShared::Variance)), variance / sum };
    m_Found.ofLight = { NumberOf(fits, static_cast<Eigen::Index>(ShapeOfShared::Light)), light / sum };
    m_Found.ofSquare = { NumberOf(fits, static_cast<Eigen::Index>(ShapeOfShared::Square)), square / sum };
    // A filter that sharpens takes in proportion to the variance; what blocks of pixels are rounded to does not.
    const bool isExplained = fits.value.tail(NumberOfShapes).minCoeff() < LargestChi2OfShapes;
    const bool isRounding =
      m_Found.ofVariance.coefficient.value < 0.0 && (constant > RoundingProbability * sum || !isExplained);
    if (isRounding)
    {
      m_Found.kind = NoiseKind::NotLinear;
    }
    else if (m_Found.kind != NoiseKind::Temporal)
    {
      const bool isCharge = mayBeCharge && (reach == 1 || light > variance);
      m_Found.kind = 2.0 * square > sum ? NoiseKind::BrighterFatter
                     : isCharge         ? NoiseKind::Crosstalk
                                        : NoiseKind::Filtered;
    }
  }

  bool
  SharesInTime() const
  {
    const bool isLarge = std::any_of(m_Found.time.begin(), m_Found.time.end(), [](const LagCoefficient & lag) {
      return lag.coefficient.Exceeds(LeastTimeCoefficient, AnyZ);
    });
    if (!isLarge)
    {
      return false;
    }
    // A drift of the offsets is shared by frames, too; it is no filter, and does not grow with the light.
    const std::size_t next = this->TimeLags().front();
    const auto        inBins = [next](const TileSums & sums) {
      Eigen::VectorXd shared(NoiseResiduals::LightBins);
      for (std::size_t b = 0; b < NoiseResiduals::LightBins; ++b)
      {
        shared(static_cast<Eigen::Index>(b)) = Ratio(sums.lags[next].bins[b].covariance, sums.lags[next].bins[b].pairs);
      }
      return shared;
    };
    const JackknifeEstimate shared = Jackknife(m_Tiles, inBins);
    TileSums                all;
    for (const TileSums & tile : m_Tiles)
    {
      all += tile;
    }
    const auto fits = FitShapes(
      PredictShapes(all.lags[0], m_CodesDn2), shared.value, shared.covariance.diagonal().cwiseMax(0.0).cwiseSqrt());
    return fits[static_cast<std::size_t>(ShapeOfShared::Constant)].chi2 + EvidenceOfRareShape >
           fits[static_cast<std::size_t>(ShapeOfShared::Variance)].chi2;
  }

  /** The sum over the frames within reach, which grows until the last two share little. More lags than needed are
   * worse: the projection of a short burst leaves little that tells them apart. */
  void
  SumOverTime()
  {
    m_Found.kind = NoiseKind::Temporal;
    double last = 1.0;
    for (int known = 0; last > SmallRing && m_TimeLags > known;)
    {
      const Eigen::MatrixXd   mixing = TemporalMixing(m_Residuals.GetBasis(), static_cast<std::size_t>(m_TimeLags));
      const JackknifeEstimate estimate = Jackknife(m_Tiles, [&](const TileSums & sums) {
        const Eigen::VectorXd covariance = this->Autocovariance(sums, mixing);
        return Eigen::VectorXd(Eigen::Vector2d(2.0 * covariance.sum() - covariance(0),
                                               covariance.tail(2).cwiseAbs().maxCoeff() / covariance(0)));
      });
      m_Found.timeFactor = NumberOf(estimate, 0);
      last = estimate.value(1);
      known = m_TimeLags;
      if (last > SmallRing)
      {
        this->AddTimeLags(std::min(known + 2, MostTimeLags));
      }
    }
    // What is beyond: a tail that falls off as before. What all pixels have in common: the series that are projected
    // out have noise of their own, which knows that of the frames.
    const Eigen::MatrixXd & basis = m_Residuals.GetBasis();
    const double            projected = static_cast<double>(basis.cols()) / static_cast<double>(basis.rows());
    const double            ofMixing = ErrorOfMixing * projected * projected * std::abs(m_Found.timeFactor.value - 1.0);
    m_Found.timeFactor.standardError = std::hypot(m_Found.timeFactor.standardError, 2.0 * last, ofMixing);
    this->FindCoefficients();
  }

  /** Whether the distribution is that of normal noise, or of few electrons, after a linear filter. */
  bool
  IsLinear() const
  {
    // Rounded numbers have a negative excess, a twelfth of the step's square as variance: -1.2 of its square.
    TileSums all;
    for (const TileSums & tile : m_Tiles)
    {
      all += tile;
    }
    double square = 0.0;
    for (const PairSums & bin : all.lags[0].bins)
    {
      const double inverse = Ratio(bin.constant, bin.pairs);
      square += inverse * inverse / static_cast<double>(NoiseResiduals::LightBins);
    }
    MeasuredNumber own = m_Found.kurtosis[0];
    own.value += 1.2 * m_CodesDn2 * m_CodesDn2 * square;
    if (own.value < 0.0 && own.Exceeds(LargestExcess, ExcessZ))
    {
      return false;
    }
    for (std::size_t k = 1; k < KurtosisSums::Kinds; ++k)
    {
      // The fewer electrons or the more the light changes, the larger both are, and that of one value the more so.
      MeasuredNumber more = m_Found.kurtosis[k];
      more.value -= std::max(0.0, own.value);
      if (more.value > 0.0 && more.Exceeds(LargestExcess, ExcessZ))
      {
        return false;
      }
    }
    return true;
  }

  const NoiseResiduals & m_Residuals;
  double                 m_CodesDn2;
  const ParallelFor &    m_ParallelFor;
  std::vector<TileSums>  m_Tiles;
  std::vector<Lag>       m_Lags;
  int                    m_TimeLags{ 0 };
  NoiseCorrelation       m_Found;
};
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

double
NoiseCorrelation::SharedSquares() const
{
  double sum = 1.0;
  for (const LagCoefficient & lag : space)
  {
    const double chance = lag.coefficient.standardError * lag.coefficient.standardError;
    sum += 2.0 * std::max(0.0, lag.coefficient.value * lag.coefficient.value - chance);
  }
  return sum;
}

NoiseCorrelation
MeasureNoiseCorrelation(const NoiseResiduals & residuals, double codesDn2, const ParallelFor & parallelFor)
{
  if (residuals.GetTiles().origins.size() < LeastTiles || residuals.GetNumberOfPixels() < LeastPixels ||
      residuals.GetFreedom() < LeastFreedom)
  {
    return {};
  }
  return Measurement(residuals, codesDn2, parallelFor).Run();
}

} // namespace sensornoise
