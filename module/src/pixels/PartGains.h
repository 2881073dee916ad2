// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_PartGains_h
#define sensornoise_pixels_PartGains_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "pixels/PartTiles.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Relative differences between the gains of the parts of a frame. Estimator.md, 3.15. */
struct SensorNoise_EXPORT PartGains
{
  Partition           partition{ Partition::LeftRight };
  std::vector<double> excess; ///< gain of each part relative to the pixel-weighted mean gain, minus 1 [1]
  std::vector<double> error;  ///< standard error of each excess [1]
  /** Relative excess of each part's variance without signal [1]. */
  std::vector<double> dark;
  std::vector<double> pixels;    ///< number of pixels of each part
  Eigen::VectorXd     field;     ///< coefficients of excess, if it is a smooth field [1]; otherwise empty
  Eigen::VectorXd     darkField; ///< coefficients of dark, if it is a smooth field [1]; otherwise empty
  double              size{ 0 }; ///< rms of the excess over the pixels, beyond chance [1]
  /** Significance of the differences of the gains, in standard deviations of chi-square [1]. */
  double z{ 0 };
  double darkSize{ 0 }; ///< rms of the differences of dark over the pixels, beyond chance [1]
  /** Significance of the differences of dark, in standard deviations of chi-square [1]. */
  double darkZ{ 0 };
  double scale{ 1 }; ///< dispersion of the tiles over their sampling error, 1 or more [1]
  /** Covariance of the coefficients of dark: a number for each part, the coefficients of the smooth field, or one
   * number that all parts have in common [1]. */
  Eigen::MatrixXd darkCovariance;
  Eigen::VectorXd meanOfTerms; ///< mean over the pixels of what these coefficients are multiplied by [1]

  /** Adds to \a sums, 2 x coefficients, the terms that the coefficients of dark are multiplied by at a place, each
   * times both \a weights. The place is given as in RatioAt(). */
  void
  AddDarkTerms(double x, double y, std::size_t phase, const Eigen::Vector2d & weights, Eigen::MatrixXd & sums) const;
  /** Returns the variance of a pixel over the variance by the common line [1]. \a x and \a y are the place in units of
   * the frame's width and height [1]; \a shotFraction is the fraction of the common line's variance there that is shot
   * noise [1]. */
  double
  RatioAt(double x, double y, std::size_t phase, double shotFraction) const;

  /** Returns whether the gains differ by more than InParts.leastDifference, and beyond chance. */
  bool
  Differ() const;
  /** Returns whether the variances without signal, and so the read noise, differ by more than
   * InCommon.leastDarkDifference, and beyond chance. */
  bool
  DarkVariancesDiffer() const;
  /** Returns whether the parts differ so much that the rejection of pixels and the line have to allow for it. */
  bool
  DifferMuch() const;
};

/** The partitions by place, by phase and by frames that describe the differences of the gain best; null: the gain is
 * uniform. */
struct GainByParts
{
  std::optional<PartGains> places;
  std::optional<PartGains> phases;
  std::optional<PartGains> frames;

  /** Returns the partitions by place and by phase, where they differ. */
  std::vector<PartGains>
  OfPixels() const
  {
    std::vector<PartGains> parts;
    for (const auto * const own : { &places, &phases })
    {
      if (*own)
      {
        parts.push_back(**own);
      }
    }
    return parts;
  }

  /** Returns the partition by place or by phase with the larger differences; null: neither is there. */
  const PartGains *
  Larger() const
  {
    return !phases ? (places ? &*places : nullptr) : !places || phases->size > places->size ? &*phases : &*places;
  }
};

/** Returns what the errors of the variances without signal of \a parts add to the covariance of gain and intercept,
 * where the variance of \a data was divided by their ratios, or may have to be. Estimator.md, 3.15. */
SensorNoise_EXPORT Eigen::Matrix2d
CovarianceByRatios(const std::vector<PartGains> & parts,
                   const VarianceData &           data,
                   const FrameGeometry &          geometry,
                   const PartReference &          reference,
                   const ParallelFor &            parallelFor);

/** Returns a map of every pixel's variance over the variance by the common line, as given by the places and phases of
 * \a parts [1]. \a mean is the map of means [DN]. */
SensorNoise_EXPORT std::vector<float>
MapOfRatios(const GainByParts &         parts,
            const std::vector<double> & mean,
            const FrameGeometry &       geometry,
            const PartReference &       reference,
            const ParallelFor &         parallelFor);

} // namespace sensornoise

#endif
