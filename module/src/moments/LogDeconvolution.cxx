// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/LogDeconvolution.h"

#include "base/ChiSquare.h"
#include "base/Quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

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
    const double share = (to - from) / (end - begin);
    one[bin] += share;
    other[bin] += share;
    from = to;
  }
  const double share = from < end ? (end - from) / (end - begin) : from == begin ? 1.0 : 0.0;
  one[last] += share;
  other[last] += share;
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
    std::for_each(m_True.begin(), m_True.end(), [sum](double & share) { share /= sum; });
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

} // namespace sensornoise
