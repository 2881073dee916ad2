// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"

#include "base/BytesFingerprint.h"
#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Quantiles.h"
#include "base/Text.h"
#include "report/JsonWriter.h"
#include "report/Quantities.h"
#include "report/ReportParts.h"
#include "sensornoise/Version.h"
#include "correlation/ProcessingSigns.h"
#include "correlation/NoiseResiduals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
double
EstimateBlackLevel(const CorrelationSettings &       settings,
                   const std::vector<double> &       mean,
                   const std::vector<std::uint8_t> & take)
{
  if (!std::isnan(settings.offsetDn))
  {
    return settings.offsetDn;
  }
  std::vector<double> levels;
  for (const std::size_t p : SamplePixels(take))
  {
    levels.push_back(mean[p]);
  }
  if (levels.empty())
  {
    return 0.0;
  }
  const double darkest = Quantile(levels, InCommon.darkestQuantile);
  return ZeroOfSignal(darkest, Quantile(levels, 1.0 - InCommon.darkestQuantile), 0.0);
}

/** Returns the frames of a sample that do not equal an earlier frame. */
std::vector<std::size_t>
DistinctOf(const NoiseSample & sample)
{
  const SampleTiles &           tiles = sample.GetTiles();
  std::set<BytesFingerprint>    prints;
  std::vector<std::size_t>      distinct;
  std::vector<BytesFingerprint> ofTiles(tiles.origins.size());
  const std::size_t             bytes = tiles.Pixels() * sizeof(float);
  for (std::size_t t = 0; t < tiles.frames; ++t)
  {
    for (std::size_t i = 0; i < ofTiles.size(); ++i)
    {
      ofTiles[i] = FingerprintOfBlock(sample.OfTile(i) + t * tiles.Pixels(), bytes);
    }
    if (prints.insert(FingerprintOfBlocks(ofTiles.data(), ofTiles.data() + ofTiles.size())).second)
    {
      distinct.push_back(t);
    }
  }
  return distinct;
}

/** Returns the sums of the sampled pixels in each frame, unweighted and weighted with the signal: frames x 2. */
Eigen::MatrixXd
SumFrames(const NoiseSample &               sample,
          const std::vector<double> &       mean,
          const std::vector<std::uint8_t> & take,
          double                            blackDn,
          const ParallelFor &               parallelFor)
{
  const SampleTiles & tiles = sample.GetTiles();
  Eigen::MatrixXd     means = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(tiles.frames), 2);
  parallelFor(tiles.frames, [&](std::size_t t) {
    std::array<double, 2> sums{};
    for (std::size_t i = 0; i < tiles.origins.size(); ++i)
    {
      const float * values = sample.OfTile(i) + t * tiles.Pixels();
      for (std::size_t p = 0; p < tiles.Pixels(); ++p)
      {
        const std::size_t pixel = sample.PixelOf(i, p);
        if (take[pixel] != 0)
        {
          sums[0] += values[p];
          sums[1] += values[p] * (mean[pixel] - blackDn);
        }
      }
    }
    means.row(static_cast<Eigen::Index>(t)) << sums[0], sums[1];
  });
  return means;
}

/** Returns the given series and \a means at the frames of a sample: frames x series. */
Eigen::MatrixXd
SeriesOf(const CorrelationSettings & settings, const std::vector<std::size_t> & frames, const Eigen::MatrixXd & means)
{
  const auto      given = static_cast<Eigen::Index>(settings.series.size());
  Eigen::MatrixXd series(static_cast<Eigen::Index>(frames.size()), given + means.cols());
  for (std::size_t t = 0; t < frames.size(); ++t)
  {
    for (Eigen::Index k = 0; k < given; ++k)
    {
      series(static_cast<Eigen::Index>(t), k) = settings.series[static_cast<std::size_t>(k)][frames[t]];
    }
  }
  series.rightCols(means.cols()) = means;
  return series;
}

/** Returns the factor from the variance to the total covariance over lags. Its error includes the temporal correlation
 * and the lags beyond reach. */
Quantity
SumOverLags(const NoiseCorrelation & correlation, const MeasuredNumber & space)
{
  if (correlation.kind == NoiseKind::NotMeasured || correlation.kind == NoiseKind::NotLinear)
  {
    return Quantity::Without(EstimateStatus::Failed);
  }
  const MeasuredNumber & time = correlation.timeFactor;
  const double           error = std::hypot(space.standardError, correlation.beyondReach);
  const Quantity         sum =
    WithError(space.value * time.value, std::hypot(error * time.value, space.value * time.standardError));
  return Filed(sum, QuantityDomain::Positive);
}

std::vector<LightNoise>
NoiseByLevel(const NoiseResiduals & residuals, const NoiseCorrelation & correlation)
{
  struct Sums
  {
    double pixels{ 0.0 };
    double signal{ 0.0 };
    double variance{ 0.0 };
  };
  std::array<Sums, NoiseResiduals::IntensityBins> bins;
  const SampleTiles &                             tiles = residuals.GetTiles();
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    for (std::size_t p = 0; p < tiles.Pixels(); ++p)
    {
      const float weight = residuals.WeightOf(i)[p];
      if (weight > 0.0F)
      {
        Sums & bin = bins[residuals.BinOf(i)[p]];
        bin.pixels += 1.0;
        bin.signal += residuals.SignalOf(i)[p];
        bin.variance += 1.0 / static_cast<double>(weight);
      }
    }
  }
  std::vector<LightNoise> lights;
  const double            shared = VarianceInflation(correlation.space) * VarianceInflation(correlation.time);
  for (std::size_t b = 0; b < bins.size(); ++b)
  {
    if (bins[b].pixels > 0.0)
    {
      const double variance = bins[b].variance / bins[b].pixels;
      const double error = variance * std::sqrt(2.0 * shared / (residuals.GetDof() * bins[b].pixels));
      lights.push_back({ bins[b].signal / bins[b].pixels,
                         { variance, error },
                         SumOverLags(correlation, correlation.spaceFactorOfBins[b]) });
    }
  }
  return lights;
}
} // namespace

void
CorrelationSettings::Validate(std::size_t frames) const
{
  if (std::isinf(offsetDn))
  {
    throw std::invalid_argument("the offset is infinite; expected a level [DN], or NaN where it is not known");
  }
  if (!(quantisationStepDn >= 0.0) || std::isinf(quantisationStepDn))
  {
    throw std::invalid_argument("the quantization step is " + Text(quantisationStepDn) +
                                " DN; expected a number from 0 on");
  }
  for (std::size_t k = 0; k < series.size(); ++k)
  {
    if (series[k].size() != frames)
    {
      throw std::invalid_argument("series " + std::to_string(k) + " has " + std::to_string(series[k].size()) +
                                  " values, but the stack has " + std::to_string(frames) +
                                  " frames; expected a value a frame");
    }
    for (const double value : series[k])
    {
      if (!std::isfinite(value))
      {
        throw std::invalid_argument("series " + std::to_string(k) + " holds a value that is not finite");
      }
    }
  }
}

CorrelationEstimate
EstimateCorrelation(NoiseSample                       sample,
                    const std::vector<double> &       mean,
                    const std::vector<std::uint8_t> & take,
                    const CorrelationSettings &       settings,
                    const ParallelFor &               parallelFor)
{
  std::vector<std::uint8_t> taken(take);
  for (std::size_t p = 0; p < taken.size(); ++p)
  {
    taken[p] = taken[p] != 0 && std::isfinite(mean[p]) ? 1 : 0;
  }
  CorrelationEstimate            estimate;
  const double                   blackDn = EstimateBlackLevel(settings, mean, taken);
  const std::vector<std::size_t> distinct = DistinctOf(sample);
  sample.KeepFrames(distinct);
  const Eigen::MatrixXd means = settings.frameMeans ? SumFrames(sample, mean, taken, blackDn, parallelFor)
                                                    : Eigen::MatrixXd(static_cast<Eigen::Index>(distinct.size()), 0);
  const double          quantisationDn2 = settings.quantisationStepDn * settings.quantisationStepDn / 12.0;
  NoiseResiduals        residuals(std::move(sample),
                           SeriesOf(settings, distinct, means),
                                  { mean, taken, blackDn, !std::isnan(settings.offsetDn) },
                           parallelFor);
  residuals.SetTimes(FindFrameTimes(residuals, distinct, parallelFor));
  if (const InterpolatedPixels found = FindInterpolatedPixels(residuals, parallelFor); !found.pixels.empty())
  {
    found.LeaveOutOf(taken);
    residuals.Take(taken, parallelFor);
  }
  NoiseCorrelation correlation = MeasureWithoutInterference(residuals, quantisationDn2, parallelFor);
  MeasureSettledFrames(correlation, residuals, quantisationDn2, parallelFor);

  estimate.framesUsed = residuals.GetTiles().frames;
  estimate.pixelsUsed = residuals.GetNumberOfPixels();
  estimate.correlation = RecordOf(correlation);
  if (correlation.kind != NoiseKind::NotMeasured)
  {
    estimate.sumOverLags = SumOverLags(correlation, correlation.spaceFactor);
    estimate.lights = NoiseByLevel(residuals, correlation);
  }
  return estimate;
}

/** Stands beside LightNoise, where JsonWriter finds it. */
void
WriteJson(JsonWriter & json, const LightNoise & noise)
{
  json.Object([&] {
    json.Member("light", noise.lightDn).Member("variance", noise.varianceDn2.value);
    json.Member("variance_standard_error", noise.varianceDn2.standardError);
    WriteQuantity(json, "sum_over_lags", noise.sumOverLags, "1");
  });
}

std::string
ToJson(const CorrelationEstimate & estimate)
{
  std::string text;
  JsonWriter  json(text);
  json.Object([&] {
    json.Member("schema", CorrelationSchema).Member("version", GetModuleVersion());
    json.Member("frames", estimate.frames).Member("width", estimate.width).Member("height", estimate.height);
    json.Member("frames_used", estimate.framesUsed).Member("pixels_used", estimate.pixelsUsed);
    json.Member("noise_correlation", estimate.correlation);
    WriteQuantity(json, "sum_over_lags", estimate.sumOverLags, "1");
    json.Member("lights", estimate.lights);
  });
  text += '\n';
  return text;
}

namespace
{
Quantity
LineNoise(const MeasuredNumber & variance)
{
  if (variance.value < Significance.severalTests * variance.standardError)
  {
    return UpperLimit(std::sqrt(std::max(0.0, variance.value) + 2.0 * variance.standardError));
  }
  return RootOf(variance.value, variance.standardError, 2.0);
}
} // namespace

NoiseCorrelationRecord
RecordOf(const NoiseCorrelation & correlation)
{
  NoiseCorrelationRecord record;
  record.kind = NameOf(correlation.kind);
  if (correlation.kind == NoiseKind::NotMeasured)
  {
    return record;
  }
  const auto lagOf = [](const LagCoefficient & lag) {
    return NoiseCorrelationRecord::Lag{
      lag.lag.x, lag.lag.y, lag.lag.t, lag.coefficient.value, lag.coefficient.standardError
    };
  };
  std::transform(correlation.space.begin(), correlation.space.end(), std::back_inserter(record.space), lagOf);
  std::transform(correlation.time.begin(), correlation.time.end(), std::back_inserter(record.time), lagOf);
  for (const CovarianceLine & line : correlation.covarianceLines)
  {
    record.covarianceLines.push_back({ line.lag.x,
                                       line.lag.y,
                                       line.slopeDn.value,
                                       line.slopeDn.standardError,
                                       line.interceptDn2.value,
                                       line.interceptDn2.standardError });
  }
  for (const PeriodicInterference & wave : correlation.interference)
  {
    // A wave of the dark frames need not be significant in the frames.
    if (wave.varianceDn2.value > Significance.severalTests * wave.varianceDn2.standardError)
    {
      const double rms = std::sqrt(wave.varianceDn2.value);
      const double error = wave.varianceDn2.standardError / (2.0 * rms);
      record.interference.push_back({ wave.frequency.cyclesPerColumn, wave.frequency.cyclesPerRow, rms, error });
    }
  }
  record.rowNoise = LineNoise(correlation.rowsDn2);
  record.columnNoise = LineNoise(correlation.columnsDn2);
  record.excessKurtosis =
    WithError(correlation.kurtosis.front().value, correlation.kurtosis.front().standardError, 2.0);
  return record;
}

} // namespace sensornoise
