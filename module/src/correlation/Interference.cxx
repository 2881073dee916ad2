// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"

#include "base/Constants.h"
#include "correlation/Constants.h"
#include "moments/DarkFrames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

TileSpectrum::TileSpectrum(std::size_t side)
  : m_Transform(2 * side, side)
{
  const double step = std::acos(-1.0) / static_cast<double>(side);
  for (Eigen::Index k = 0; k < m_Transform.rows(); ++k)
  {
    for (Eigen::Index x = 0; x < m_Transform.cols(); ++x)
    {
      const double angle = step * static_cast<double>(k * x);
      m_Transform(k, x) = std::cos(angle) + std::sin(angle);
    }
  }
}

Eigen::ArrayXXd
TileSpectrum::PowerOf(const Eigen::MatrixXd & values) const
{
  // With cas = cos + sin, cas(a) cas(b) = cos(a - b) + sin(a + b). The frequency -k is Size() - k.
  const Eigen::Index    size = this->Size();
  const Eigen::MatrixXd both = m_Transform * values * m_Transform.transpose();
  const auto            minus = [size](Eigen::Index k) { return k == 0 ? 0 : size - k; };
  Eigen::ArrayXXd       power(size, size);
  for (Eigen::Index u = 0; u < size; ++u)
  {
    for (Eigen::Index v = 0; v < size; ++v)
    {
      const double sine = both(v, u) - both(minus(v), minus(u));
      const double cosine = both(v, minus(u)) + both(minus(v), u);
      power(v, u) = 0.25 * (sine * sine + cosine * cosine);
    }
  }
  return power;
}

namespace
{
/** Returns the mean power spectrum of frames of the sample, after division by the typical noise. White noise has the
 * power 1. \a tiles becomes the number of tiles, over the frames, that were used. */
Eigen::ArrayXXd
MeanSpectrum(const NoiseResiduals & residuals, const ParallelFor & parallelFor, std::size_t & tiles)
{
  const SampleTiles &          sample = residuals.GetTiles();
  const auto                   side = static_cast<Eigen::Index>(sample.side);
  const TileSpectrum           spectrum(sample.side);
  const std::size_t            count = sample.origins.size();
  const std::size_t            frames = std::clamp<std::size_t>(InCorrelation.spectra / count, 1, sample.frames);
  std::vector<Eigen::ArrayXXd> ofTiles(count);
  parallelFor(count, [&](std::size_t i) {
    const auto root = Eigen::Map<const Eigen::ArrayXXf>(residuals.WeightOf(i), side, side).sqrt().eval();
    const auto pixels = static_cast<double>((root > 0.0F).count());
    if (pixels < static_cast<double>(InCorrelation.leastPixelsOfWave))
    {
      return;
    }
    ofTiles[i] = Eigen::ArrayXXd::Zero(spectrum.Size(), spectrum.Size());
    for (std::size_t k = 0; k < frames; ++k)
    {
      const std::size_t t = k * sample.frames / frames;
      const auto values = Eigen::Map<const Eigen::ArrayXXf>(residuals.OfTile(i) + t * sample.Pixels(), side, side);
      // A row of pixels is a column of the map.
      ofTiles[i] += spectrum.PowerOf((root * values).cast<double>().matrix().transpose()) / pixels;
    }
  });
  Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(spectrum.Size(), spectrum.Size());
  tiles = 0;
  for (const Eigen::ArrayXXd & own : ofTiles)
  {
    if (own.size() > 0)
    {
      sum += own;
      tiles += frames;
    }
  }
  // The projection of the temporal components takes this fraction of the variance.
  const double left = residuals.GetDof() / static_cast<double>(residuals.GetBasis().rows());
  return sum / std::max(1.0, left * static_cast<double>(tiles));
}

/** Returns the place of the maximum of a parabola through the logarithms of three values, relative to the middle one.
 */
double
MaximumOfParabola(double before, double here, double after)
{
  const double slope = 0.5 * std::log(after / before);
  const double curvature = std::log(before * after / (here * here));
  return curvature < 0.0 ? std::clamp(-slope / curvature, -0.5, 0.5) : 0.0;
}
} // namespace

std::optional<WaveFrequency>
FindLine(const Eigen::ArrayXXd & power, std::size_t tiles)
{
  const Eigen::Index size = power.rows();
  const auto         at = [&](Eigen::Index v, Eigen::Index u) { return power((v + size) % size, (u + size) % size); };
  // The largest power at a distance of two resolved frequencies.
  constexpr Eigen::Index distance = 4;
  const auto             largestAround = [&](Eigen::Index v, Eigen::Index u) {
    double largest = 0.0;
    for (Eigen::Index k = -distance; k <= distance; ++k)
    {
      for (const Eigen::Index side : { -distance, distance })
      {
        largest = std::max({ largest, at(v + side, u + k), at(v + k, u + side) });
      }
    }
    return largest;
  };
  const double significant =
    1.0 + Significance.manyTests / std::sqrt(std::max<double>(1.0, static_cast<double>(tiles)));
  const double least = std::max(InCorrelation.leastPeak, significant);
  double       highest = 0.0;
  Eigen::Index foundV = 0;
  Eigen::Index foundU = 0;
  for (Eigen::Index v = 0; v <= size / 2; ++v)
  {
    for (Eigen::Index u = -size / 2; u < size / 2; ++u)
    {
      const bool isLow = std::max(v, std::abs(u)) <= distance / 2; // residual illumination and smoothing are there
      if (!isLow && at(v, u) > highest && at(v, u) > least * largestAround(v, u))
      {
        highest = at(v, u);
        foundV = v;
        foundU = u;
      }
    }
  }
  if (!(highest > 0.0))
  {
    return std::nullopt;
  }
  const auto   value = [&](Eigen::Index v, Eigen::Index u) { return std::max(at(v, u), 1e-12 * highest); };
  const double x = MaximumOfParabola(value(foundV, foundU - 1), highest, value(foundV, foundU + 1));
  const double y = MaximumOfParabola(value(foundV - 1, foundU), highest, value(foundV + 1, foundU));
  const auto   frequencies = static_cast<double>(size);
  return WaveFrequency{ (static_cast<double>(foundU) + x) / frequencies,
                        (static_cast<double>(foundV) + y) / frequencies };
}

NoiseCorrelation
MeasureWithoutInterference(NoiseResiduals & residuals, double quantisationDn2, const ParallelFor & parallelFor)
{
  NoiseCorrelation  found = MeasureNoiseCorrelation(residuals, quantisationDn2, parallelFor);
  const std::size_t before = residuals.GetInterference().size();
  if (found.kind == NoiseKind::White || found.kind == NoiseKind::NotMeasured)
  {
    return found;
  }
  while (residuals.GetInterference().size() < InCorrelation.mostWaves)
  {
    std::size_t           tiles = 0;
    const Eigen::ArrayXXd power = MeanSpectrum(residuals, parallelFor, tiles);
    const auto            line = FindLine(power, tiles);
    if (!line)
    {
      break;
    }
    residuals.SubtractWave(*line, parallelFor);
  }
  return residuals.GetInterference().size() > before ? MeasureNoiseCorrelation(residuals, quantisationDn2, parallelFor)
                                                     : found;
}

namespace
{
/** Subtracts from each frame the mean of its usable pixels. As a temporal component the mean would take a part of any
 * noise that moves it, such as half of the power of a wave. */
void
SubtractLevels(NoiseSample & sample, const std::vector<std::uint8_t> & usable)
{
  const SampleTiles & tiles = sample.GetTiles();
  for (std::size_t t = 0; t < tiles.frames; ++t)
  {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < tiles.origins.size(); ++i)
    {
      const float * values = sample.OfTile(i) + t * tiles.Pixels();
      for (std::size_t p = 0; p < tiles.Pixels(); ++p)
      {
        const double take = usable[sample.PixelOf(i, p)] != 0 ? 1.0 : 0.0;
        sum += take * static_cast<double>(values[p]);
        count += take;
      }
    }
    const auto level = static_cast<float>(count > 0.0 ? sum / count : 0.0);
    for (std::size_t i = 0; i < tiles.origins.size(); ++i)
    {
      float * values = sample.OfTile(i) + t * tiles.Pixels();
      std::transform(values, values + tiles.Pixels(), values, [level](float value) { return value - level; });
    }
  }
}
} // namespace

std::optional<StructuredNoise>
MeasureStructuredNoise(FrameSample sample, std::size_t frames, const DarkMaps & dark, const ParallelFor & parallelFor)
{
  constexpr std::size_t fewest = 3; // a mean, and two degrees of freedom
  if (frames < fewest)
  {
    return std::nullopt;
  }
  NoiseSample              noise = sample.TakeNoise(dark.offsetDn, parallelFor);
  std::vector<std::size_t> kept(frames);
  std::iota(kept.begin(), kept.end(), std::size_t{ 0 });
  noise.KeepFrames(kept);
  SubtractLevels(noise, dark.usable);
  const Eigen::MatrixXd none(static_cast<Eigen::Index>(frames), 0);
  // Without signal no covariance is taken for illumination.
  const std::vector<double> signal(dark.usable.size(), 0.0);
  NoiseResiduals            residuals(std::move(noise), none, { signal, dark.usable, 0.0, true }, parallelFor);
  const double              quantisationDn2 = dark.stepDn * dark.stepDn / 12.0;
  const NoiseCorrelation    correlation = MeasureWithoutInterference(residuals, quantisationDn2, parallelFor);
  if (correlation.kind == NoiseKind::NotMeasured)
  {
    return std::nullopt;
  }
  const MeasuredNumber sum = correlation.StructuredNoiseWithScatter();
  StructuredNoise      found{ { sum.value, sum.standardError }, {} };
  for (const PeriodicInterference & wave : correlation.interference)
  {
    found.waves.push_back(wave.frequency);
  }
  return found;
}

} // namespace sensornoise
