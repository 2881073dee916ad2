// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/DarkFrames.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Quantiles.h"
#include "moments/Constants.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{

/** Factors that are the same for all pixels. */
struct IntervalFactors
{
  double student; ///< half width of the interval of the offset, in standard errors
  double low;     ///< lower bound of the interval of the variance, in units of the variance
  double high;    ///< upper bound, in the same unit
  double frames;  ///< number of frames T
  double stepDn;  ///< quantization step
};

IntervalFactors
IntervalFactorsOf(const DarkMaps & dark)
{
  const auto   frames = static_cast<double>(dark.frames);
  const double dof = frames - 1.0;
  return { StudentQuantile(0.975, dof),
           dof / ChiSquareUpperQuantile(0.025, dof),
           dof / ChiSquareQuantile(0.025, dof),
           frames,
           dark.stepDn };
}

/** Returns the standard deviation of noise [DN] whose variance together with quantization noise is \a varianceDn2. */
double
NoiseWithoutRounding(double varianceDn2, double stepDn)
{
  return std::sqrt(std::max(0.0, varianceDn2 - stepDn * stepDn / 12.0));
}

IntervalMapDn
EmptyIntervalMap(std::size_t pixels)
{
  const std::vector<double> unknown(pixels, std::numeric_limits<double>::quiet_NaN());
  return { unknown, unknown, unknown };
}

void
FillPixel(PixelCalibration & maps, std::size_t p, double offsetDn, double varianceDn2, const IntervalFactors & factors)
{
  constexpr double worst = 1.57079632679489661923; // pi/2, see RoundingErrorDn()
  const double     half =
    factors.student * std::sqrt(varianceDn2 / factors.frames) + worst * RoundingErrorDn(factors.stepDn, varianceDn2);
  maps.offset.value[p] = offsetDn;
  maps.offset.low[p] = offsetDn - half;
  maps.offset.high[p] = offsetDn + half;
  const double stepDn = factors.stepDn;
  const bool   isHidden = varianceDn2 < InCommon.hiddenVariance * stepDn * stepDn;
  const double high = NoiseWithoutRounding(varianceDn2 * factors.high, stepDn);
  maps.readNoise.value[p] = NoiseWithoutRounding(varianceDn2, stepDn);
  maps.readNoise.low[p] = isHidden ? 0.0 : NoiseWithoutRounding(varianceDn2 * factors.low, stepDn);
  maps.readNoise.high[p] = isHidden ? std::max(std::sqrt(InCommon.hiddenVariance) * stepDn, high) : high;
}

} // namespace

PixelCalibration
MakePixelCalibration(const DarkMaps & dark, const ParallelFor & parallelFor)
{
  const std::size_t pixels = dark.offsetDn.size();
  if (dark.frames < 2 || dark.varianceDn2.size() != pixels)
  {
    throw std::invalid_argument("the dark maps are of " + std::to_string(dark.frames) + " frames, with " +
                                std::to_string(pixels) + " offsets and " + std::to_string(dark.varianceDn2.size()) +
                                " variances; expected two frames or more, and as many variances as offsets");
  }
  const IntervalFactors factors = IntervalFactorsOf(dark);
  PixelCalibration      maps{ EmptyIntervalMap(pixels), EmptyIntervalMap(pixels) };
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (std::isfinite(dark.offsetDn[p]) && std::isfinite(dark.varianceDn2[p]))
      {
        FillPixel(maps, p, dark.offsetDn[p], dark.varianceDn2[p], factors);
      }
    }
  });
  return maps;
}

std::size_t
LogBinning::BinOf(double variance) const
{
  const double bin = std::floor((std::log(variance) - low) / width); // -infinity for 0
  return static_cast<std::size_t>(std::clamp(bin, static_cast<double>(first), NumberOfLogBins - 1.0));
}

void
LogBinning::Add(double begin, double end, LogBins & one, LogBins & other) const
{
  const std::size_t last = BinOf(end);
  std::size_t       bin = BinOf(begin);
  double            from = begin;
  for (; bin < last; ++bin)
  {
    const double to = std::exp(low + width * (static_cast<double>(bin) + 1.0));
    const double fraction = (to - from) / (end - begin);
    one[bin] += fraction;
    other[bin] += fraction;
    from = to;
  }
  const double fraction = from < end ? (end - from) / (end - begin) : from == begin ? 1.0 : 0.0;
  one[last] += fraction;
  other[last] += fraction;
}

LogBinning
MakeLogBinning(std::vector<double> variances, double cellDn2)
{
  const double median = Quantile(variances, 0.5);
  const double quarters = std::log(Quantile(variances, 0.75) / std::max(Quantile(variances, 0.25), 1e-9 * median));
  // Narrow enough for any shape, and wide enough that 60 bins on either side cover noise 6 times as large.
  const double width = std::clamp(quarters / 8.0, 0.005, 0.1);
  LogBinning   binning{ std::log(median) - 0.5 * NumberOfLogBins * width, width, 0 };
  // The positions of the lowest variances are arbitrary: one bin holds all of them.
  binning.first = binning.BinOf(std::min(2.0 * cellDn2, median / 8.0));
  return binning;
}

std::vector<LogBins>
ChiSquareKernel(double dof, const LogBinning & binning)
{
  std::vector<LogBins>  kernel(NumberOfLogBins);
  constexpr std::size_t edges = 2 * NumberOfLogBins;
  std::vector<double>   below(edges); // probability below an edge between measured bins, by its distance from the
                                      // middle of a true bin
  for (std::size_t k = 0; k < edges; ++k)
  {
    const double bins = static_cast<double>(k) - NumberOfLogBins + 0.5;
    below[k] = ChiSquareCdf(dof * std::exp(bins * binning.width), dof);
  }
  for (std::size_t j = 0; j < NumberOfLogBins; ++j)
  {
    for (std::size_t b = binning.first; b < NumberOfLogBins; ++b)
    {
      const double low = b == binning.first ? 0.0 : below[NumberOfLogBins + b - j - 1];
      const double high = b + 1 == NumberOfLogBins ? 1.0 : below[NumberOfLogBins + b - j];
      kernel[j][b] = high - low;
    }
  }
  return kernel;
}

LogDeconvolution::LogDeconvolution(const LogBins & counts, const std::vector<LogBins> & kernel)
  : m_Kernel(kernel)
{
  double total = 0.0;
  for (const double count : counts)
  {
    total += count;
  }
  for (std::size_t b = 0; b < counts.size(); ++b)
  {
    m_Measured[b] = counts[b] / total;
    m_True[b] = m_Measured[b] + 1e-6; // a value of 0 would stay 0 in all iterations
  }
}

void
LogDeconvolution::Iterate(int times)
{
  for (int i = 0; i < times; ++i)
  {
    LogBins expected{};
    for (std::size_t j = 0; j < m_True.size(); ++j)
    {
      for (std::size_t b = 0; b < expected.size(); ++b)
      {
        expected[b] += m_Kernel[j][b] * m_True[j];
      }
    }
    LogBins ratio{};
    for (std::size_t b = 0; b < ratio.size(); ++b)
    {
      ratio[b] = expected[b] > 1e-15 ? m_Measured[b] / expected[b] : 0.0;
    }
    double sum = 0.0;
    for (std::size_t j = 0; j < m_True.size(); ++j)
    {
      double factor = 0.0;
      for (std::size_t b = 0; b < ratio.size(); ++b)
      {
        factor += m_Kernel[j][b] * ratio[b];
      }
      m_True[j] *= factor;
      sum += m_True[j];
    }
    std::for_each(m_True.begin(), m_True.end(), [sum](double & fraction) { fraction /= sum; });
  }
}

double
LogDeconvolution::GetMedianBin() const
{
  double sum = 0.0;
  for (std::size_t b = 0; b < m_True.size(); ++b)
  {
    if (sum + m_True[b] >= 0.5)
    {
      return static_cast<double>(b) + (0.5 - sum) / m_True[b];
    }
    sum += m_True[b];
  }
  return static_cast<double>(m_True.size());
}

namespace
{

constexpr std::size_t NumberOfGroups = 20;

/** Median of the logarithm of the variances [log DN^2]. */
struct LogMedian
{
  double value{ 0.0 };
  double standardError{ 0.0 };
};

/** Estimates the median of the true variances.
 * \param stepDn quantization step [DN] */
LogMedian
MedianOfTrueVariances(const std::vector<double> & variances, double dof, double stepDn)
{
  // The sum of the squares of T integers is even where their sum is even. The sums of squared deviations of pixels with
  // the same mean are therefore 2 step^2 apart. Each sum is spread over this distance, for a smooth distribution.
  const double                        cellDn2 = stepDn * stepDn / dof;
  const LogBinning                    binning = MakeLogBinning(variances, cellDn2);
  std::array<LogBins, NumberOfGroups> groups{};
  LogBins                             all{};
  for (std::size_t i = 0; i < variances.size(); ++i)
  {
    const double begin = std::max(0.0, variances[i] - cellDn2);
    binning.Add(begin, variances[i] + cellDn2, groups[i % NumberOfGroups], all);
  }
  const std::vector<LogBins> kernel = ChiSquareKernel(dof, binning);
  LogDeconvolution           whole(all, kernel);
  // Chosen for 6 to 100 frames: fewer iterations are biased by 1 %, more iterations follow the noise of the counts.
  constexpr int iterations = 30;
  whole.Iterate(iterations);
  const double median = whole.GetMedianBin();
  whole.Iterate(2 * iterations);
  const double unsettled = 2.0 * (whole.GetMedianBin() - median);

  std::array<double, NumberOfGroups> without{};
  double                             mean = 0.0;
  for (std::size_t g = 0; g < NumberOfGroups; ++g)
  {
    LogBins rest = all;
    std::transform(
      rest.begin(), rest.end(), groups[g].begin(), rest.begin(), [](double a, double part) { return a - part; });
    LogDeconvolution part(rest, kernel);
    part.Iterate(iterations);
    without[g] = part.GetMedianBin();
    mean += without[g] / NumberOfGroups;
  }
  double scatter = 0.0;
  for (const double other : without)
  {
    scatter += (other - mean) * (other - mean) * (NumberOfGroups - 1.0) / NumberOfGroups;
  }
  const double value = binning.low + binning.width * median;
  // Bias of the logarithm by the width of the intervals.
  const double spreading = std::pow(cellDn2 / std::exp(value), 2) / 3.0;
  return { value, AddInQuadrature(binning.width * std::sqrt(scatter), binning.width * unsettled, spreading) };
}

} // namespace

std::optional<MedianReadNoise>
MedianReadNoiseOf(const std::vector<double> & variancesDn2, double dof, double stepDn)
{
  if (dof < InMoments.leastDofOfMedian || variancesDn2.size() < InMoments.fewestPixelsOfMedian)
  {
    return std::nullopt;
  }
  const double leastDn2 = InCommon.hiddenVariance * stepDn * stepDn;
  const double medianDn2 = QuantileOf(variancesDn2, 0.5);
  if (!(medianDn2 > leastDn2))
  {
    return std::nullopt;
  }
  const LogMedian median = MedianOfTrueVariances(variancesDn2, dof, stepDn);
  const double    trueDn2 = std::exp(median.value);
  if (!(trueDn2 > leastDn2))
  {
    return std::nullopt;
  }
  const double noiseDn = std::sqrt(trueDn2 - stepDn * stepDn / 12.0);
  return MedianReadNoise{ noiseDn, 0.5 * trueDn2 * median.standardError / noiseDn };
}

} // namespace sensornoise
