// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FramePhotonTransfer.h"

#include "correlation/TotalCovariance.h"
#include "pixels/RoughnessClasses.h"
#include "refined/Constants.h"
#include "report/StackReport.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the lines of the frames and of the pixels, as far as they are determined. The line with the more precise
 * slope is first. */
std::vector<SlopeOfLine>
LinesByError(const StaticVariance & variance)
{
  const VarianceCurve & frames = variance.fromFrames;
  const auto   errorOf = [](const VarianceLine & line) { return std::sqrt(std::max(0.0, line.covariance(0, 0))); };
  const double ofPattern = variance.pattern.LargestFraction() * variance.line.gain;
  const double ofPixels = std::hypot(errorOf(variance.line), ofPattern);
  const double chi2 = frames.ReducedChi2(variance.varianceInflation);
  const double ofFrames =
    errorOf(frames.line) * std::sqrt(BeyondChance(chi2, static_cast<double>(frames.bins.size()) - 2.0));
  if (!frames.line.isDetermined)
  {
    return { { variance.line, ofPixels } };
  }
  return ofFrames < ofPixels ? std::vector<SlopeOfLine>{ { frames.line, ofFrames }, { variance.line, ofPixels } }
                             : std::vector<SlopeOfLine>{ { variance.line, ofPixels }, { frames.line, ofFrames } };
}
} // namespace

VarianceCurve
LineOfFrames(const StaticVariance & variance, const FrameComparison & by, const ParallelFor & parallelFor)
{
  if (!by.AreUnequal() || by.isIlluminationLocal)
  {
    return {};
  }
  const std::vector<std::uint8_t> used = MaskOfUsed(variance.pixelUse);
  const auto                      count = static_cast<double>(std::count(used.begin(), used.end(), std::uint8_t{ 1 }));
  if (!(count > InRefined.leastUsedFraction * static_cast<double>(by.scene.valid)))
  {
    return {};
  }
  return FitFramePhotonTransfer({ by.residuals, used, parallelFor }, by.levels, variance.line);
}

SlopeOfLine
BetterLine(const StaticVariance & variance)
{
  return LinesByError(variance).front();
}

bool
MovesLittle(const InitialNoiseModel & model)
{
  return std::max(model.vibrationXPixels2, model.vibrationYPixels2) <
         InRefined.strongVibration * InRefined.strongVibration;
}

namespace
{
struct Thresholds
{
  double varianceInflation; ///< variance inflation by the noise correlation of neighbours [1]
  double least;             ///< difference of the noise variance of two groups of frames [1]
};

FrameNoise
CompareByEnergies(const FrameEnergies &            energies,
                  const std::vector<SlopeOfLine> & lines,
                  const FrameComparison &          by,
                  const Thresholds &               thresholds)
{
  const double chance = std::sqrt(2.0 * thresholds.varianceInflation / std::max(1.0, energies.Pixels().sum()));
  FrameNoise   noise;
  for (const auto & [line, error] : lines)
  {
    noise = GroupFramesByNoise(NoiseOfFrames(energies, by.levels, line, error), chance, thresholds.least);
    for (int round = 0; round < InRefined.roundsOfFrameNoise && noise.groups.size() > 1; ++round)
    {
      const Eigen::VectorXd known = noise.OfFrames(energies.Frames());
      noise = GroupFramesByNoise(NoiseOfFrames(energies, by.levels, line, error, known), chance, thresholds.least);
    }
    noise.areFramesEqual = !by.AreUnequal();
    if (noise.HasSeveralGroups())
    {
      break;
    }
  }
  return noise;
}

/** Returns the quadrants of tiles: the halves are divided at the medians of their \a origins. */
std::vector<std::size_t>
QuadrantsOf(const std::vector<SampleTiles::Origin> & origins)
{
  const auto medianOf = [&](std::size_t SampleTiles::Origin::* axis) {
    std::vector<std::size_t> all;
    std::transform(
      origins.begin(), origins.end(), std::back_inserter(all), [&](const auto & own) { return own.*axis; });
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
    return all.empty() ? std::size_t{ 0 } : all[all.size() / 2];
  };
  const std::size_t        x = medianOf(&SampleTiles::Origin::x);
  const std::size_t        y = medianOf(&SampleTiles::Origin::y);
  std::vector<std::size_t> quadrants;
  std::transform(origins.begin(), origins.end(), std::back_inserter(quadrants), [&](const auto & own) {
    return std::size_t{ own.y < y ? 0U : 2U } + std::size_t{ own.x < x ? 0U : 1U };
  });
  return quadrants;
}

/** Returns the pixels of \a mask in even rows and even columns. */
std::vector<std::uint8_t>
EvenOf(std::vector<std::uint8_t> mask, std::size_t width)
{
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    mask[p] = (p / width) % 2 == 0 && (p % width) % 2 == 0 ? mask[p] : std::uint8_t{ 0 };
  }
  return mask;
}
} // namespace

FrameNoise
CompareFrames(const StaticVariance &   variance,
              const FrameComparison &  by,
              const NoiseCorrelation & correlation,
              const ParallelFor &      parallelFor)
{
  // Remaining motion of a frame is not noise, and levels of tiles are not known under local illumination. Noise that is
  // correlated in time may be taken for local illumination.
  const bool       isTemporal = correlation.kind == NoiseKind::Temporal;
  const bool       isLocal = by.isIlluminationLocal && !isTemporal;
  const double     leastUnlike = isLocal ? InRefined.leastUnlikeUnderLocalIllumination : InRefined.leastUnlikeNoise;
  const Thresholds thresholds{ std::max(1.0, VarianceInflation(correlation.space)),
                               MovesLittle(by.scene.model) ? leastUnlike
                                                           : std::max(InRefined.leastUnlikeUnderMotion, leastUnlike) };
  const std::vector<std::uint8_t> flat = MaskOfFlatClasses(by.squares, MaskOfUsed(variance.pixelUse), parallelFor);
  const std::vector<SlopeOfLine>  lines = LinesByError(variance);
  Eigen::VectorXd                 remaining = Eigen::VectorXd::Ones(by.residuals.GetBasis().rows());
  if (isTemporal)
  {
    const Eigen::MatrixXd & basis = by.residuals.GetBasis();
    remaining =
      RemainingOfCorrelated(basis, CorrelationOfFrames(correlation.time, basis.rows(), by.residuals.GetTimes()));
  }
  const auto compareOn = [&](const std::vector<std::uint8_t> & pixels) {
    FrameEnergies energies(by.residuals, pixels, parallelFor);
    energies.DivideBy(remaining);
    return CompareByEnergies(energies, lines, by, thresholds);
  };
  FrameNoise noise = compareOn(flat);
  if (noise.HasSeveralGroups() || !correlation.IsCorrelated())
  {
    return noise;
  }
  // A camera may compute other pixels in each frame, as a deinterlacer does.
  FrameNoise ofEven = compareOn(EvenOf(flat, by.scene.frame.geometry.width));
  return ofEven.HasSeveralGroups() ? ofEven : noise;
}

FrameEnergies::FrameEnergies(const NoiseResiduals &            residuals,
                             const std::vector<std::uint8_t> & take,
                             const ParallelFor &               parallelFor)
  : m_Basis(residuals.GetBasis())
{
  const SampleTiles & tiles = residuals.GetTiles();
  const std::size_t   count = tiles.origins.size();
  const auto          frames = static_cast<Eigen::Index>(tiles.frames);
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(frames, static_cast<Eigen::Index>(count)); // a column for each tile
  Eigen::VectorXd signal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  Eigen::VectorXd pixels = signal;
  parallelFor(count, [&](std::size_t i) {
    const auto     tile = static_cast<Eigen::Index>(i);
    const auto     size = static_cast<Eigen::Index>(tiles.Pixels());
    Eigen::ArrayXf taken(size); // 1: the pixel is used
    for (Eigen::Index p = 0; p < size; ++p)
    {
      const auto pixel = static_cast<std::size_t>(p);
      taken(p) = residuals.WeightOf(i)[pixel] > 0.0F && take[residuals.PixelOf(i, pixel)] != 0 ? 1.0F : 0.0F;
    }
    pixels(tile) = static_cast<double>(taken.sum());
    if (!(pixels(tile) > 0.0))
    {
      return;
    }
    using Values = Eigen::Map<const Eigen::ArrayXf>;
    signal(tile) = (Values(residuals.SignalOf(i), size) * taken).cast<double>().sum() / pixels(tile);
    for (Eigen::Index t = 0; t < frames; ++t)
    {
      const Values values(residuals.OfTile(i) + t * size, size);
      squares(t, tile) = (values.cast<double>().square() * taken.cast<double>()).sum() / pixels(tile);
    }
  });
  std::vector<Eigen::Index> filled;
  for (Eigen::Index tile = 0; tile < pixels.size(); ++tile)
  {
    if (pixels(tile) > 0.0)
    {
      filled.push_back(tile);
    }
  }
  const auto                       rows = static_cast<Eigen::Index>(filled.size());
  std::vector<SampleTiles::Origin> origins;
  m_SquaresDn2.resize(rows, frames);
  m_LevelChangesDn.resize(rows, frames);
  m_SignalDn.resize(rows);
  m_Pixels.resize(rows);
  for (Eigen::Index row = 0; row < rows; ++row)
  {
    const Eigen::Index tile = filled[static_cast<std::size_t>(row)];
    m_SquaresDn2.row(row) = squares.col(tile).transpose();
    m_LevelChangesDn.row(row) = residuals.LevelChangesOf(static_cast<std::size_t>(tile)).transpose();
    m_SignalDn(row) = signal(tile);
    m_Pixels(row) = pixels(tile);
    origins.push_back(tiles.origins[static_cast<std::size_t>(tile)]);
  }
  m_Quadrants = QuadrantsOf(origins);
  this->FillRemainingFraction();
}

FrameEnergies::FrameEnergies(Eigen::MatrixXd squaresDn2,
                             Eigen::VectorXd signalDn,
                             Eigen::VectorXd pixels,
                             Eigen::MatrixXd basis)
  : m_SquaresDn2(std::move(squaresDn2))
  , m_SignalDn(std::move(signalDn))
  , m_Pixels(std::move(pixels))
  , m_Basis(std::move(basis))
{
  for (Eigen::Index tile = 0; tile < m_Pixels.size(); ++tile)
  {
    m_Quadrants.push_back(static_cast<std::size_t>(tile % 4));
  }
  this->FillRemainingFraction();
}

void
FrameEnergies::FillRemainingFraction()
{
  m_RemainingFraction = 1.0 - m_Basis.rowwise().squaredNorm().array();
}

void
FrameEnergies::DivideBy(const Eigen::VectorXd & factors)
{
  m_SquaresDn2.array().rowwise() /= factors.transpose().array();
}

Eigen::VectorXd
FrameEnergies::ExpectedSquares(const Eigen::VectorXd & variances) const
{
  // Row t of (Q Q') o (Q Q') times V is q_t' (Q' V Q) q_t.
  const Eigen::MatrixXd inner = m_Basis.transpose() * variances.asDiagonal() * m_Basis;
  const Eigen::VectorXd shared = (m_Basis * inner).cwiseProduct(m_Basis).rowwise().sum();
  return (2.0 * m_RemainingFraction.array() - 1.0) * variances.array() + shared.array();
}

} // namespace sensornoise
