// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_GainByParts_h
#define sensornoise_pixels_GainByParts_h

#include "SensorNoiseExport.h"
#include "pixels/PartTiles.h"
#include "base/Eigen.h"
#include "pixels/Constants.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
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

/** \class PartRegression
 * \brief Robust regression of the excess variance of tiles on the parts of a frame.
 *
 * The model is excess = s d_part + (1 - s) h_part + curve(level). s is the fraction of the common line's variance that
 * is shot noise. d is the relative excess of the part's gain, and h the relative excess of its variance without signal.
 * The curve is common to all parts. Estimator.md, 3.15. */
struct SensorNoise_EXPORT PartRegression
{
  Partition             partition{ Partition::LeftRight };
  Eigen::Index          gains{ 0 };   ///< number of coefficients d, which come first
  Eigen::Index          darks{ 0 };   ///< number of coefficients h, which follow
  std::vector<double>   knotsDn;      ///< levels of the coefficients of the curve, which follow [DN]
  std::optional<double> stepDn;       ///< level of a step of the curve, the last coefficient [DN]; null: no step
  Eigen::VectorXd       theta;        ///< the coefficients [1]
  Eigen::MatrixXd       covariance;   ///< covariance of theta, scaled by the dispersion of the tiles [1]
  double                scale{ 1.0 }; ///< dispersion of the tiles over their sampling error, 1 or more [1]
  bool                  isDetermined{ false };

  /** Returns whether what differs is a smooth field over the frame. */
  bool
  IsSmooth() const
  {
    return partition == Partition::SmoothField;
  }

  /** Returns the products of Legendre polynomials at a place of the frame, of a total degree up to 4. \a x and \a y are
   * in units of the frame's width and height [1]. */
  static Eigen::VectorXd
  FieldAt(double x, double y);

  /** Returns the matrix that gives a number for each part when it is multiplied by theta: the mean over the part of the
   * quantity whose \a count coefficients start at \a first, d or h. */
  Eigen::MatrixXd
  ToParts(const std::vector<TileExcess> & tiles, Eigen::Index first, Eigen::Index count) const;

  /** Returns the Schwarz criterion: the robust loss with the dispersion \a common [1], plus the logarithm of the number
   * of tiles for each coefficient of the parts. The best model has the lowest criterion. */
  double
  Criterion(const std::vector<TileExcess> & tiles, double common) const;

  using Terms = std::vector<std::pair<Eigen::Index, double>>;
  /** Sets \a terms to the nonzero columns of a tile, with their values. */
  void
  FillTerms(const TileExcess & tile, Terms & terms) const;
};

/** Quantities that may differ between parts. */
enum class PartsDiffer : std::uint8_t
{
  InBoth,   ///< gain and variance without signal
  InGain,   ///< gain
  InTheDark ///< variance without signal, as by the read noise
};

/** Fits the parts of \a partition. */
SensorNoise_EXPORT PartRegression
FitParts(Partition partition, PartsDiffer differ, const std::vector<TileExcess> & tiles);

/** Fits one part that has all pixels. With \a stepDn the curve has a step at that level [DN], as with two amplifiers
 * that read every pixel. With more \a knots the curve follows a strongly non-linear response. */
SensorNoise_EXPORT PartRegression
FitUniform(const std::vector<TileExcess> & tiles,
           std::optional<double>           stepDn = std::nullopt,
           std::size_t                     knots = InParts.knots);

/** Compares the parts of every partition by place and by phase, and chooses between partitions by the Schwarz
 * criterion. */
SensorNoise_EXPORT GainByParts
CompareParts(const PartTiles & tiles);

/** Returns the partitions by place that may have unlike variances without signal, where CompareParts() finds no places.
 * The covariance of each has its differences as an error: their square beyond chance, times the probability of the
 * partition. Estimator.md, 3.15. */
SensorNoise_EXPORT std::vector<PartGains>
FindPossibleParts(const std::vector<TileExcess> & tiles);

/** Compares groups of frames in the same way; \a tiles has an entry for each group at each place. Null if the gains do
 * not differ. */
SensorNoise_EXPORT std::optional<PartGains>
CompareFrameParts(const std::vector<TileExcess> & tiles);

} // namespace sensornoise

#endif
