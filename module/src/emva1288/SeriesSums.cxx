// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"

#include "sensornoise/Emva1288.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace sensornoise
{

namespace
{
constexpr std::size_t Taps = 2 * EmvaFilterRadius + 1;

/** Returns the convolution of two kernels. */
std::vector<double>
Convolve(const std::vector<double> & a, const std::vector<double> & b)
{
  std::vector<double> result(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      result[i + j] += a[i] * b[j];
    }
  }
  return result;
}

std::array<double, Taps>
MakeKernel()
{
  const auto box = [](std::size_t taps) { return std::vector<double>(taps, 1.0 / static_cast<double>(taps)); };
  const std::vector<double> taps = Convolve(Convolve(box(7), box(11)), { 0.25, 0.5, 0.25 });
  std::array<double, Taps>  kernel{};
  for (std::size_t k = 0; k < Taps; ++k)
  {
    kernel[k] = taps[k];
  }
  return kernel;
}
} // namespace

const std::array<double, Taps> &
EmvaLowpassKernel()
{
  static const std::array<double, Taps> kernel = MakeKernel();
  return kernel;
}

bool
HasRoomForHighpass(std::size_t width, std::size_t height)
{
  constexpr std::size_t least = Taps + 2; // the filter leaves three columns and rows
  return width >= least && height >= least;
}

HighpassImage
FilterHighpass(const std::vector<double> & image,
               std::size_t                 width,
               std::size_t                 height,
               const ParallelFor &         parallelFor)
{
  const auto &  kernel = EmvaLowpassKernel();
  HighpassImage result{ width - Taps + 1, height - Taps + 1, {} };
  result.pixels.resize(result.columns * result.rows);
  parallelFor(result.rows, [&](std::size_t row) {
    std::vector<double> columns(width, 0.0); // lowpass along y
    for (std::size_t k = 0; k < Taps; ++k)
    {
      const double * const source = image.data() + (row + k) * width;
      const double         weight = kernel[k];
      for (std::size_t x = 0; x < width; ++x)
      {
        columns[x] += weight * source[x];
      }
    }
    double * const out = result.pixels.data() + row * result.columns;
    for (std::size_t x = 0; x < result.columns; ++x)
    {
      out[x] = image[(row + EmvaFilterRadius) * width + x + EmvaFilterRadius];
    }
    for (std::size_t k = 0; k < Taps; ++k)
    {
      for (std::size_t x = 0; x < result.columns; ++x)
      {
        out[x] -= kernel[k] * columns[x + k];
      }
    }
  });
  return result;
}

namespace
{
/** Returns the mean square of the values about \a centre. */
double
MeanSquareAbout(const std::vector<double> & values, double centre)
{
  const double squares = std::accumulate(values.begin(), values.end(), 0.0, [centre](double sum, double value) {
    return sum + (value - centre) * (value - centre);
  });
  return squares / static_cast<double>(values.size());
}
} // namespace

EmvaSpatialVariance
MeasureSpatialVariance(const std::vector<double> & mean,
                       std::size_t                 columns,
                       std::size_t                 rows,
                       double                      stackDn2,
                       std::size_t                 frames)
{
  std::vector<double> ofColumns(columns, 0.0);
  std::vector<double> ofRows(rows, 0.0);
  for (std::size_t y = 0; y < rows; ++y)
  {
    for (std::size_t x = 0; x < columns; ++x)
    {
      const double value = mean[y * columns + x];
      ofColumns[x] += value / static_cast<double>(rows);
      ofRows[y] += value / static_cast<double>(columns);
    }
  }
  const auto   width = static_cast<double>(columns);
  const auto   height = static_cast<double>(rows);
  const double centre = std::accumulate(ofRows.begin(), ofRows.end(), 0.0) / height;
  const double noise = stackDn2 / static_cast<double>(frames); // noise variance of a pixel of the mean image [DN^2]
  EmvaSpatialVariance result;
  result.columns = columns;
  result.rows = rows;
  result.stackDn2 = stackDn2;
  result.measuredDn2 = MeanSquareAbout(mean, centre);
  result.totalDn2 = result.measuredDn2 - noise;
  result.columnMeanDn2 = MeanSquareAbout(ofColumns, centre) - noise / height;
  result.rowMeanDn2 = MeanSquareAbout(ofRows, centre) - noise / width;
  result.pixelDn2 = (result.totalDn2 - result.columnMeanDn2 - result.rowMeanDn2) / (1.0 - 1.0 / height - 1.0 / width);
  result.columnDn2 = result.columnMeanDn2 - result.pixelDn2 / height;
  result.rowDn2 = result.rowMeanDn2 - result.pixelDn2 / width;
  return result;
}

namespace
{
/** Sum over the pixels of a frame, its highest value, and the number of pixels that have it. */
struct FrameSummary
{
  double sum{ 0.0 };
  double highest{ -std::numeric_limits<double>::infinity() };
  double atHighest{ 0.0 };
  bool   isFinite{ true };

  void
  Add(double value)
  {
    sum += value;
    isFinite = isFinite && std::isfinite(value);
    if (value > highest)
    {
      highest = value;
      atHighest = 0.0;
    }
    atHighest += value == highest ? 1.0 : 0.0;
  }
};

double
SumOfSquares(const std::vector<double> & values, const ParallelFor & parallelFor)
{
  return SumOverBlocks<1>(
    values.size(), parallelFor, [&values](std::size_t p, auto & sums) { sums[0] += values[p] * values[p]; })[0];
}

/** Returns the mean over the pixels of the temporal variance. \a squares is the sum of the squares of all pixels in all
 * frames, \a squaresOfMean the sum of the squares of the mean image. */
double
StackVariance(double squares, double squaresOfMean, double frames, double pixels)
{
  return std::max(0.0, squares - frames * squaresOfMean) / ((frames - 1.0) * pixels);
}
} // namespace

EmvaSeriesSums::EmvaSeriesSums(std::size_t width, std::size_t height)
  : m_Width(width)
  , m_Height(height)
{
  if (width < 3 || height < 3)
  {
    throw std::invalid_argument("frames of " + std::to_string(width) + " x " + std::to_string(height) +
                                " pixels have no rows and columns to compare; expected 3 x 3 or more");
  }
  for (std::vector<double> * const map : { &m_Sum, &m_SquareSum, &m_Frame })
  {
    map->resize(width * height, 0.0);
  }
}

template <typename TPixel>
void
EmvaSeriesSums::AddFrame(const TPixel * frame, const ParallelFor & parallelFor)
{
  const auto add = [this, frame](std::size_t begin, std::size_t end, FrameSummary & part) {
    for (std::size_t p = begin; p < end; ++p)
    {
      const auto value = static_cast<double>(frame[p]);
      m_Frame[p] = value;
      m_Sum[p] += value;
      m_SquareSum[p] += value * value;
      part.Add(value);
    }
  };
  double sum = 0.0;
  bool   isFinite = true;
  for (const FrameSummary & part : PartsOfBlocks<FrameSummary>(m_Frame.size(), parallelFor, add))
  {
    sum += part.sum;
    isFinite = isFinite && part.isFinite;
    m_AtHighest = part.highest > m_HighestDn ? 0.0 : m_AtHighest;
    m_HighestDn = std::max(m_HighestDn, part.highest);
    m_AtHighest += part.highest == m_HighestDn ? part.atHighest : 0.0;
  }
  if (!isFinite)
  {
    throw std::invalid_argument("frame " + std::to_string(m_FrameMeans.size()) +
                                " of a series holds NaN or infinity; expected numbers alone. Leave this frame out.");
  }
  m_FrameMeans.push_back(sum / static_cast<double>(m_Frame.size()));
  if (HasRoomForHighpass(m_Width, m_Height))
  {
    m_HighpassSquares += SumOfSquares(FilterHighpass(m_Frame, m_Width, m_Height, parallelFor).pixels, parallelFor);
  }
}

template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const unsigned char *, const ParallelFor &);
template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const unsigned short *, const ParallelFor &);
template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const short *, const ParallelFor &);
template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const float *, const ParallelFor &);
template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const double *, const ParallelFor &);

EmvaSeries
EmvaSeriesSums::Measure(const ParallelFor & parallelFor) const
{
  const std::size_t count = m_FrameMeans.size();
  if (count < 2)
  {
    throw std::invalid_argument("a series has " + std::to_string(count) +
                                " frame; expected 2 or more frames of each exposure");
  }
  const auto          frames = static_cast<double>(count);
  const auto          pixels = static_cast<double>(m_Sum.size());
  std::vector<double> mean(m_Sum.size());
  ForPixels(m_Sum.size(), parallelFor, [&](std::size_t p) { mean[p] = m_Sum[p] / frames; });
  // squares about the mean of each pixel, so that no digits are lost at high levels
  const double excess = SumOverBlocks<1>(m_Sum.size(), parallelFor, [&](std::size_t p, auto & sums) {
    sums[0] += m_SquareSum[p] - m_Sum[p] * m_Sum[p] / frames;
  })[0];
  const double stackDn2 = std::max(0.0, excess) / ((frames - 1.0) * pixels);

  EmvaSeries series;
  series.width = m_Width;
  series.height = m_Height;
  series.frames = count;
  series.meanDn = std::accumulate(m_FrameMeans.begin(), m_FrameMeans.end(), 0.0) / frames;
  for (const double level : m_FrameMeans)
  {
    series.frameSquaresDn2 += (level - series.meanDn) * (level - series.meanDn);
  }
  series.temporalVarianceDn2 = std::max(0.0, stackDn2 - series.frameSquaresDn2 / (frames - 1.0));
  series.highestDn = m_HighestDn;
  series.fractionAtHighest = m_AtHighest / (pixels * frames);
  series.unfiltered = MeasureSpatialVariance(mean, m_Width, m_Height, stackDn2, count);
  if (HasRoomForHighpass(m_Width, m_Height))
  {
    const HighpassImage filtered = FilterHighpass(mean, m_Width, m_Height, parallelFor);
    const auto          kept = static_cast<double>(filtered.pixels.size());
    const double        squaresOfMean = SumOfSquares(filtered.pixels, parallelFor);
    series.highpass = MeasureSpatialVariance(filtered.pixels,
                                             filtered.columns,
                                             filtered.rows,
                                             StackVariance(m_HighpassSquares, squaresOfMean, frames, kept),
                                             count);
  }
  return series;
}

} // namespace sensornoise
