// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_GainByParts_h
#define sensornoise_pixels_GainByParts_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "pixels/Constants.h"
#include "pixels/VarianceLine.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Ways to divide a burst into parts that may differ in their gain: the pixels by place or by phase, which is their
 * position in a repeating pattern, and the frames. */
enum class Partition : std::uint8_t
{
  LeftRight,
  UpperLower,
  Quadrants,
  Blocks,
  SmoothField, ///< a polynomial of the place; reported for the parts of Blocks
  Columns2,
  Rows2,
  Phases2,
  Columns4,
  Rows4,
  Phases4,
  FrameHalves,
  FrameQuarters,
  FrameParities
};

/** Objects that a partition divides. */
enum class Divided : std::uint8_t
{
  Places,
  Phases,
  Frames
};

/** Entry of the table of partitions. */
struct PartitionKind
{
  Partition    partition;
  const char * name;  ///< name in the record, stable for programs
  const char * words; ///< description of the parts in messages
  std::size_t  parts; ///< number of parts
  Divided      divided;
};

/** Blocks along either axis, and the longest period of a pattern of phases [pixel]. */
inline constexpr std::size_t BlocksAcross = 4;
inline constexpr std::size_t LargestPeriod = 4;
/** Groups of frames: the quarters of the burst, each divided into its even and its odd frames. */
inline constexpr std::size_t FrameGroups = 8;

inline constexpr std::array<PartitionKind, 14> PartitionTable{ {
  { Partition::LeftRight, "left-right", "the left and the right half", 2, Divided::Places },
  { Partition::UpperLower, "upper-lower", "the upper and the lower half", 2, Divided::Places },
  { Partition::Quadrants, "quadrants", "the quadrants", 4, Divided::Places },
  { Partition::Blocks, "blocks", "4 x 4 blocks", 16, Divided::Places },
  { Partition::SmoothField,
    "smooth-field",
    "a smooth field, as where vignetting was divided out",
    16,
    Divided::Places },
  { Partition::Columns2, "columns-2", "even and odd columns", 2, Divided::Phases },
  { Partition::Rows2, "rows-2", "even and odd rows", 2, Divided::Phases },
  { Partition::Phases2, "phases-2x2", "the pixels of a 2 x 2 mosaic", 4, Divided::Phases },
  { Partition::Columns4, "columns-4", "every fourth column", 4, Divided::Phases },
  { Partition::Rows4, "rows-4", "every fourth row", 4, Divided::Phases },
  { Partition::Phases4, "phases-4x4", "the pixels of a 4 x 4 mosaic", 16, Divided::Phases },
  { Partition::FrameHalves, "frame-halves", "the first and the last half of the frames", 2, Divided::Frames },
  { Partition::FrameQuarters, "frame-quarters", "the quarters of the burst", 4, Divided::Frames },
  { Partition::FrameParities, "frame-parities", "even and odd frames", 2, Divided::Frames },
} };

/** Returns the entry of \a partition. */
constexpr const PartitionKind &
KindOf(Partition partition)
{
  return PartitionTable[static_cast<std::size_t>(partition)];
}

/** Returns the part of a pixel or frame, from 0. \a x and \a y are in units of the frame's width and height, from 0 to
 * 1 [1]. \a phase is 4 (row mod 4) + (column mod 4) for a pixel, and 2 quarter + (frame mod 2) for a frame. */
SensorNoise_EXPORT std::size_t
PartOf(Partition partition, double x, double y, std::size_t phase);

/** Returns the part in words, such as "left half" or "column 1, row 0 of 2 x 2". */
SensorNoise_EXPORT std::string
NameOfPart(Partition partition, std::size_t part);

/** Mean excess of the variance over a line, of the pixels of a tile or of one phase in a tile. */
struct TileExcess
{
  double      x{ 0.0 };            ///< horizontal centre of the tile, in units of the frame's width [1]
  double      y{ 0.0 };            ///< vertical centre, in units of the frame's height [1]
  std::size_t phase{ 0 };          ///< see PartOf()
  double      pixels{ 0.0 };       ///< number of pixels
  double      levelDn{ 0.0 };      ///< mean level [DN]
  double      shotFraction{ 0.0 }; ///< fraction of the line's variance that is shot noise [1]
  double      excess{ 0.0 };       ///< mean variance over the line, relative to the line, minus 1 [1]
  double      error{ 0.0 };        ///< sampling error of the excess [1]
};

/** Sums over pixels, or over pixels in some frames. */
struct SensorNoise_EXPORT PartSums
{
  double pixels{ 0.0 };   ///< number of values
  double level{ 0.0 };    ///< sum of the means [DN]
  double variance{ 0.0 }; ///< sum of the variances [DN^2]
  double expected{ 0.0 }; ///< sum of the variances by the line [DN^2]
  double shot{ 0.0 };     ///< sum of the shot noise by the line [DN^2]
  double chance{ 0.0 };   ///< sampling variance of the sum of variances, without spatial noise correlation [DN^4]

  PartSums &
  operator+=(const PartSums & other);
  /** Returns the mean excess; the place is not set. \a varianceInflation: see RejectionModel [1]. */
  TileExcess
  Excess(double varianceInflation) const;
};

/** Line that the variance of the pixels is compared with. */
struct PartReference
{
  VarianceLine line;
  double       blackDn{ 0.0 };           ///< dark offset, or a level that it is not below [DN]
  double       varianceInflation{ 1.0 }; ///< variance inflation, see RejectionModel [1]
};

/** Excess variance of the pixels of a mask in tiles of the frame, at most 32 along each axis. */
struct SensorNoise_EXPORT PartTiles
{
  std::vector<TileExcess> places; ///< one entry per tile
  std::vector<TileExcess> phases; ///< one entry per larger tile and phase
};

/** Computes the excess variance in tiles of 16 x 16 pixels, of 8 x 8 pixels in small frames, and of a multiple of these
 * in large frames. */
SensorNoise_EXPORT PartTiles
MakePartTiles(const VarianceData &  data,
              const FrameGeometry & geometry,
              const PartReference & reference,
              const ParallelFor &   parallelFor);

/** Returns whether gains differ by more than InParts.leastDifference, and beyond chance. \a size is their rms deviation
 * beyond chance, relative to their mean [1], and \a z its significance, in standard deviations [1]. */
SensorNoise_EXPORT bool
DoGainsDiffer(double size, double z);

/** Relative differences between the gains of the parts of a frame. Estimator.md, 3.15. */
struct SensorNoise_EXPORT PartGains
{
  Partition           partition{ Partition::LeftRight };
  std::vector<double> excess; ///< gain of each part relative to the pixel-weighted mean gain, minus 1 [1]
  std::vector<double> error;  ///< standard error of each excess [1]
  /** Relative excess of each part's variance without signal [1]. */
  std::vector<double> dark;
  std::vector<double> pixels;          ///< number of pixels of each part
  Eigen::VectorXd     field;           ///< coefficients of excess, if it is a smooth field [1]; otherwise empty
  Eigen::VectorXd     darkField;       ///< coefficients of dark, if it is a smooth field [1]; otherwise empty
  double              meanExcess{ 0 }; ///< excess of the mean gain over the gain of the line, relative to that [1]
  double meanDark{ 0 };          ///< excess of the mean variance without signal over the line's, relative to that [1]
  std::vector<double> knotsDn;   ///< levels of the common curve of the excess, in rising order [DN]
  std::vector<double> curve;     ///< common excess at these levels [1]
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
  Eigen::VectorXd meanOfTerms; ///< mean over the pixels of the terms that these coefficients are multiplied by [1]

  /** Makes the mean that \a excess and \a dark are relative to the mean over the pixels of \a mask. Nothing is done for
   * a smooth field. */
  void
  CentreOn(const std::vector<std::uint8_t> & mask, const FrameGeometry & geometry);
  /** Adds to \a sums, 2 x coefficients, the terms that the coefficients of dark are multiplied by at a place, each
   * times both \a weights. The place is given as in RatioAt(). */
  void
  AddDarkTerms(double x, double y, std::size_t phase, const Eigen::Vector2d & weights, Eigen::MatrixXd & sums) const;
  /** Returns the variance of a pixel over its mean over the parts at the same level [1]. \a x and \a y are the place
   * in units of the frame's width and height [1]; \a shotFraction is the fraction of the line's variance there that is
   * shot noise [1], and \a levelDn the level [DN]. */
  double
  RatioAt(double x, double y, std::size_t phase, double shotFraction, double levelDn) const;

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

/** Returns the contribution of the errors of the variances without signal of \a parts to the covariance of gain and
 * intercept, where the variance of \a data was divided by their ratios, or may have to be. Estimator.md, 3.15. */
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
 * The model is excess = s d_part + (1 - s) h_part + curve(level). Here s is the fraction of the common line's variance
 * that is shot noise. d is the relative excess of the part's gain, and h the relative excess of its variance without
 * signal. The curve is common to all parts. Estimator.md, 3.15. */
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

  /** Returns whether the partition is a smooth field over the frame. */
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
