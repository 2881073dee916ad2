// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_GainByParts_h
#define sensornoise_pixels_GainByParts_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "pixels/PartTiles.h"
#include "pixels/Partition.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** How the gain of the parts of a frame differs from the common one. Estimator.md, 3.15. */
struct SensorNoise_EXPORT PartGains
{
  Partition           partition{ Partition::LeftRight };
  std::vector<double> excess; ///< of each part's gain over the pixel-weighted mean, relative to it [1]
  std::vector<double> error;  ///< its standard error [1]
  std::vector<double> dark;   ///< the same of the variance without signal; of a smooth field one number [1]
  std::vector<double> pixels;
  Eigen::VectorXd     field;         ///< of a smooth field: its coefficients [1]
  double              size{ 0 };     ///< rms of the excess over the pixels, beyond chance [1]
  double              z{ 0 };        ///< standard deviations of chi-square by which the parts differ [1]
  double              darkSize{ 0 }; ///< as size, of dark [1]
  double              darkZ{ 0 };    ///< as z [1]
  double              scale{ 1 };    ///< scatter of the tiles over that of sampling, 1 or more [1]

  /** The variance of a pixel over that of the common line [1]. \a shotFraction is that of the common line there. */
  double
  RatioAt(double x, double y, std::size_t phase, double shotFraction) const;

  /** Whether the gains differ by as much as counts, beyond chance. */
  bool
  Differ() const;
  /** The same of the variance without signal: of the read noise. */
  bool
  DifferInTheDark() const;
  /** Whether they differ by so much that the rejection of pixels and the line have to know. */
  bool
  DifferMuch() const;
};

/** The pattern of the gains: the partition by place, that by phase, and that of the frames, that describe them best;
 * null: the gain is one. */
struct GainByParts
{
  std::optional<PartGains> places;
  std::optional<PartGains> phases;
  std::optional<PartGains> frames;

  /** That of places and phases with the larger effect; null: neither. */
  const PartGains *
  Larger() const
  {
    return !phases ? (places ? &*places : nullptr) : !places || phases->size > places->size ? &*phases : &*places;
  }
};

/** Compares the parts of every partition, and chooses between partitions by Schwarz' criterion. */
SensorNoise_EXPORT GainByParts
CompareParts(const PartTiles & tiles);

/** Compares the groups of frames in the same way, of which each of \a tiles has one at a place. */
SensorNoise_EXPORT std::optional<PartGains>
CompareFrameParts(const std::vector<TileExcess> & tiles);

/** The ratio of every pixel's variance to the common line, as \a parts have it [1]. */
SensorNoise_EXPORT std::vector<float>
MapOfRatios(const GainByParts &         parts,
            const std::vector<double> & mean,
            const FrameGeometry &       geometry,
            const PartReference &       reference,
            const ParallelFor &         parallelFor);

} // namespace sensornoise

#endif
