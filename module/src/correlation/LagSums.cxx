// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/LagSums.h"

#include "base/Simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns weights of \a count positions in a row that decrease towards both ends. Positions two, three or four apart
 * have the same sum of weights, wherever one begins: the noise of binned or doubled pixels has these periods. */
std::vector<double>
PeriodlessWeights(std::size_t count)
{
  std::vector<double> weights{ 1.0 };
  const auto          blur = [&weights](std::size_t length) {
    std::vector<double> wider(weights.size() + length - 1, 0.0);
    for (std::size_t k = 0; k < weights.size() * length; ++k)
    {
      wider[k / length + k % length] += weights[k / length] / static_cast<double>(length);
    }
    weights = std::move(wider);
  };
  for (const std::size_t period : { 2U, 3U, 4U })
  {
    if (weights.size() + period <= count)
    {
      blur(period);
    }
  }
  blur(count + 1 - weights.size());
  const double top = *std::max_element(weights.begin(), weights.end());
  std::transform(weights.begin(), weights.end(), weights.begin(), [top](double weight) { return weight / top; });
  return weights;
}

/** Terms that the pairs of one row of a tile add to the sums. */
struct PairTerms
{
  using OfRow = std::array<double, SampleTiles::Side>;
  OfRow pairs;
  OfRow covariance;
  OfRow constant;
  OfRow signal;
  OfRow square;

  void
  AddTo(PairSums & sums, std::size_t k) const
  {
    sums.pairs += pairs[k];
    sums.covariance += covariance[k];
    sums.constant += constant[k];
    sums.signal += signal[k];
    sums.square += square[k];
  }
};

/** Pixels of one row at one end of the pairs. */
struct RowOfPixels
{
  const double * root; // square root of the weight
  const float *  signal;
};

/** Returns the terms of one row of pairs. \a weights are the weights of the positions in the row, \a ofRow the weight
 * of the row. \a products are the sums over time of the products of both ends, by the pixel in \a here. */
PairTerms
MakeTerms(const RowOfPixels &         here,
          const RowOfPixels &         there,
          const float *               products,
          const std::vector<double> & weights,
          double                      ofRow,
          double                      inverseDof)
{
  PairTerms terms{};
  for (std::size_t k = 0; k < weights.size(); ++k)
  {
    const double weight = ofRow * weights[k];
    const double root = here.root[k] * there.root[k];
    const double inverse = weight * root;
    const double z = 0.5 * (static_cast<double>(here.signal[k]) + there.signal[k]);
    terms.pairs[k] = root > 0.0 ? weight : 0.0;
    terms.covariance[k] = inverseDof * products[k] * inverse;
    terms.constant[k] = inverse;
    terms.signal[k] = z * inverse;
    terms.square[k] = z * z * inverse;
  }
  return terms;
}

/** Adds the products of \a VTogether frames of \a size values. The values of \a there lie \a shift values behind
 * \a here. */
template <std::size_t VTogether>
void
AddProductsOfFrames(const float * here, const float * there, std::size_t size, std::ptrdiff_t shift, float * products)
{
  const std::size_t first = shift < 0 ? static_cast<std::size_t>(-shift) : 0;
  const std::size_t last = shift < 0 ? size : size - static_cast<std::size_t>(shift);
  for (std::size_t p = first; p < last; ++p)
  {
    float sum = products[p];
    for (std::size_t k = 0; k < VTogether; ++k)
    {
      sum += here[p + k * size] * there[p + k * size];
    }
    products[p] = sum;
  }
}

/** Restores covariance that a regression removed: adds it to the products of a tile's pixels with the pixels \a shift
 * places behind them. \a projection are the values of NoiseResiduals::LineProjectionsOf() or WaveProjectionsOf(). */
void
RestoreCovariance(const float * projection, double dof, std::ptrdiff_t shift, std::vector<float> & products)
{
  const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -shift));
  const auto last = products.size() - static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, shift));
  for (std::size_t p = first; p < last; ++p)
  {
    products[p] += static_cast<float>(dof) * projection[p] *
                   projection[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) + shift)];
  }
}

/** Number of frames whose products are added together: the sums are loaded and stored a quarter as often. */
constexpr std::size_t FramesOfProducts = 4;

/** Adds the products of FramesOfProducts frames, or of \a frames if these are fewer, see AddProductsOfFrames(). */
void
AddProducts(const float *  here,
            const float *  there,
            std::size_t    frames,
            std::size_t    size,
            std::ptrdiff_t shift,
            float *        products)
{
  if (frames >= FramesOfProducts)
  {
    AddProductsOfFrames<FramesOfProducts>(here, there, size, shift, products);
    return;
  }
  for (std::size_t t = 0; t < frames; ++t)
  {
    AddProductsOfFrames<1>(here + t * size, there + t * size, size, shift, products);
  }
}

/** Adds the products of the frames of \a tile that are \a lag.t frames apart in time, where some frames are missing. */
void
AddProductsOfTimes(const NoiseResiduals & residuals, std::size_t tile, const Lag & lag, std::vector<float> & products)
{
  const SampleTiles &  tiles = residuals.GetTiles();
  const std::size_t    size = tiles.Pixels();
  const std::ptrdiff_t shift = static_cast<std::ptrdiff_t>(lag.y) * static_cast<std::ptrdiff_t>(tiles.side) + lag.x;
  const float * const  values = residuals.OfTile(tile);
  for (const auto & [first, second] : residuals.GetTimes().PairsAt(static_cast<std::size_t>(lag.t), tiles.frames))
  {
    AddProductsOfFrames<1>(values + first * size, values + second * size + shift, size, shift, products.data());
  }
}
} // namespace

std::vector<float>
SumProducts(const float * own, const float * other, const SampleTiles & tiles, std::ptrdiff_t shift)
{
  const std::size_t  size = tiles.Pixels();
  std::vector<float> products(size, 0.0F);
  CallWithAvx2([&] {
    for (std::size_t first = 0; first < tiles.frames; first += FramesOfProducts)
    {
      AddProducts(own + first * size, other + first * size + shift, tiles.frames - first, size, shift, products.data());
    }
  });
  return products;
}

std::vector<std::vector<float>>
SumProducts(const NoiseResiduals & residuals, std::size_t tile, const std::vector<Lag> & lags)
{
  const SampleTiles &             tiles = residuals.GetTiles();
  const std::size_t               size = tiles.Pixels();
  std::vector<std::vector<float>> products(lags.size(), std::vector<float>(size, 0.0F));
  const auto                      areFramesMissing = [&residuals](const Lag & lag) {
    return lag.t != 0 && !residuals.GetTimes().AreConsecutive();
  };
  CallWithAvx2([&] {
    // All lags of a few frames, which stay in the first-level cache, precede the next frames.
    for (std::size_t first = 0; first < tiles.frames; first += FramesOfProducts)
    {
      const float * here = residuals.OfTile(tile) + first * size;
      for (std::size_t k = 0; k < lags.size(); ++k)
      {
        if (areFramesMissing(lags[k]))
        {
          continue;
        }
        const auto           later = static_cast<std::size_t>(lags[k].t);
        const std::ptrdiff_t shift =
          static_cast<std::ptrdiff_t>(lags[k].y) * static_cast<std::ptrdiff_t>(tiles.side) + lags[k].x;
        const float * there = here + later * size + shift;
        const auto    frames = tiles.frames - std::min(tiles.frames, first + later);
        AddProducts(here, there, frames, size, shift, products[k].data());
      }
    }
  });
  for (std::size_t k = 0; k < lags.size(); ++k)
  {
    if (areFramesMissing(lags[k]))
    {
      AddProductsOfTimes(residuals, tile, lags[k], products[k]);
    }
  }
  const auto axis = residuals.GetSubtractedLines();
  const auto waves = residuals.WaveProjectionsOf(tile);
  for (std::size_t k = 0; k < lags.size(); ++k)
  {
    const std::ptrdiff_t shift =
      static_cast<std::ptrdiff_t>(lags[k].y) * static_cast<std::ptrdiff_t>(tiles.side) + lags[k].x;
    if (lags[k].t != 0 || shift == 0)
    {
      continue;
    }
    for (const float * const projection : waves)
    {
      RestoreCovariance(projection, residuals.GetDof(), shift, products[k]);
    }
    if (axis && (*axis == LineAxis::Rows ? lags[k].y : lags[k].x) == 0)
    {
      for (const float * const projection : residuals.LineProjectionsOf(tile))
      {
        RestoreCovariance(projection, residuals.GetDof(), shift, products[k]);
      }
    }
  }
  return products;
}

LagSummation::LagSummation(const NoiseResiduals & residuals, std::vector<Lag> lags)
  : m_Residuals(residuals)
  , m_Lags(std::move(lags))
{
  const auto side = static_cast<int>(residuals.GetTiles().side);
  for (const Lag & lag : m_Lags)
  {
    m_Weights.push_back({ PeriodlessWeights(static_cast<std::size_t>(side - std::abs(lag.x))),
                          PeriodlessWeights(static_cast<std::size_t>(side - std::abs(lag.y))) });
  }
}

std::vector<LagSums>
LagSummation::OfTile(std::size_t tile) const
{
  const std::vector<std::vector<float>> products = SumProducts(m_Residuals, tile, m_Lags);
  const std::size_t                     side = m_Residuals.GetTiles().side;
  const float *                         signal = m_Residuals.SignalOf(tile);
  const float *                         weight = m_Residuals.WeightOf(tile);
  const std::uint8_t *                  bin = m_Residuals.BinOf(tile);
  const double                          inverseDof = 1.0 / m_Residuals.GetDof();
  std::vector<double>                   roots(side * side);
  std::transform(weight, weight + side * side, roots.begin(), [](double w) { return std::sqrt(w); });
  std::vector<LagSums> sums(m_Lags.size());
  CallWithAvx2([&] {
    for (std::size_t k = 0; k < m_Lags.size(); ++k)
    {
      const PlaceWeights & weights = m_Weights[k];
      const auto           x = static_cast<std::size_t>(std::max(0, -m_Lags[k].x));
      const auto           firstY = static_cast<std::size_t>(std::max(0, -m_Lags[k].y));
      LagSums              odd; // two independent sums, so that an addition need not wait for the previous one
      for (std::size_t y = 0; y < weights.rows.size(); ++y)
      {
        const std::size_t p = (firstY + y) * side + x;
        const std::size_t q = static_cast<std::size_t>(
          static_cast<std::ptrdiff_t>(p) +
          static_cast<std::ptrdiff_t>(m_Lags[k].y) * static_cast<std::ptrdiff_t>(side) + m_Lags[k].x);
        const PairTerms terms = MakeTerms({ roots.data() + p, signal + p },
                                          { roots.data() + q, signal + q },
                                          products[k].data() + p,
                                          weights.columns,
                                          weights.rows[y],
                                          inverseDof);
        for (std::size_t i = 0; i < weights.columns.size(); ++i)
        {
          terms.AddTo((i % 2 == 0 ? sums[k] : odd).bins[bin[p + i]], i);
        }
      }
      sums[k] += odd;
    }
  });
  return sums;
}

PairSums &
PairSums::operator+=(const PairSums & other)
{
  pairs += other.pairs;
  covariance += other.covariance;
  constant += other.constant;
  signal += other.signal;
  square += other.square;
  return *this;
}

LagSums &
LagSums::operator+=(const LagSums & other)
{
  for (std::size_t b = 0; b < bins.size(); ++b)
  {
    bins[b] += other.bins[b];
  }
  return *this;
}

PairSums
LagSums::Total() const
{
  PairSums total;
  for (const PairSums & bin : bins)
  {
    total += bin;
  }
  return total;
}

std::vector<std::vector<LagSums>>
SumLags(const NoiseResiduals & residuals, const std::vector<Lag> & lags, const ParallelFor & parallelFor)
{
  const LagSummation                summation(residuals, lags);
  std::vector<std::vector<LagSums>> sums(residuals.GetTiles().origins.size());
  parallelFor(sums.size(), [&](std::size_t i) { sums[i] = summation.OfTile(i); });
  return sums;
}

} // namespace sensornoise
