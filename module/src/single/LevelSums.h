// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_LevelSums_h
#define sensornoise_single_LevelSums_h

#include "SensorNoiseExport.h"
#include "base/PixelLayout.h"
#include "single/NoiseLine.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Daubechies' orthonormal wavelet with three vanishing moments (Comm. Pure Appl. Math. 41, 1988, DOI
 * 10.1002/cpa.3160410705). Details of white noise are uncorrelated with each other and with the approximation; details
 * of a polynomial of degree 2 along a row or a column are 0. */
struct Wavelet
{
  static constexpr std::size_t Taps = 6;

  /** Weights of the approximation, whose sum is the square root of 2: (1 + s + q, 5 + s + 3 q, 10 - 2 s + 2 q, 10 - 2 s
   * - 2 q, 5 + s - 3 q, 1 + s - q) / (16 sqrt(2)), with s = sqrt(10) and q = sqrt(5 + 2 s). */
  static constexpr std::array<float, Taps> low{ { 0.3326705529500826F,
                                                  0.8068915093110926F,
                                                  0.4598775021184915F,
                                                  -0.1350110200102546F,
                                                  -0.0854412738820267F,
                                                  0.0352262918857095F } };
  /** Weights of the details: the weights of the approximation in reverse, with alternating sign. */
  static constexpr std::array<float, Taps> high{ { low[5], -low[4], low[3], -low[2], low[1], -low[0] } };
};

/** Geometry of the windows of a position, in coefficients of the approximation. The centre of the approximation's
 * weights is 0.8 pixels from its first tap, the centre of the squared weights of the details 3.8 pixels: 1.5
 * coefficients apart. A window of an even number of coefficients has its centre half between two of them, so both
 * centres are equal. Without that the level of a ramp would be off by 3 pixels of its slope. */
struct WaveletWindow
{
  /** Width of the window of the level and of the roughness. */
  static constexpr std::size_t Size = 6;
  /** Weights of the level along an axis. They have the variance of the squared weights of a detail along an axis,
   * 0.4537 pixels^2. The level is therefore unbiased where the image is a parabola. A mean with equal weights would
   * lower maxima and raise minima. Among all weights with this variance, these have the least sum of squares. The
   * standard deviation of the level is 0.19 of the noise of a pixel.
   */
  static constexpr std::array<float, Size> level{
    { -0.08362313F, 0.21672463F, 0.3668985F, 0.3668985F, 0.21672463F, -0.08362313F }
  };
  /** Width of the mean from which the approximation's deviations are taken: a ramp has none. */
  static constexpr std::size_t Smooth = 5;
  /** Coefficients that a position's windows reach along an axis, less 1. */
  static constexpr std::size_t Reach = Size + Smooth - 2;
  /** First coefficient of the window of the level. */
  static constexpr std::size_t LevelFirst = Smooth / 2;
  /** The detail coefficient of the position. */
  static constexpr std::size_t Detail = LevelFirst + Size / 2 - 2;
};

/** A frame, or a plane of a mosaic, and the unit in which its levels are computed. */
template <typename TPixel>
struct SingleFrame
{
  const TPixel *       pixels{ nullptr };
  PixelLayout          layout; ///< width: the width of the plane
  std::size_t          height{ 0 };
  const std::uint8_t * mask{ nullptr }; ///< values at the places of the pixels; 0: left out; null: no mask
  double               originDn{ 0.0 }; ///< level that becomes 0 [DN]
  double               unitDn{ 1.0 };   ///< difference of levels that becomes 1 [DN]: floats do not overflow

  /** Positions along an axis of \a pixels pixels: one for each detail coefficient whose windows are inside. */
  static std::size_t
  PositionsAlong(std::size_t pixels)
  {
    const std::size_t coefficients = pixels < Wavelet::Taps ? 0 : (pixels - Wavelet::Taps) / 2 + 1;
    return coefficients < WaveletWindow::Reach ? 0 : coefficients - WaveletWindow::Reach;
  }
};

/** Positions of a tile: [x, x + width) times [y, y + height). */
struct TileOfPositions
{
  std::size_t x{ 0 };
  std::size_t y{ 0 };
  std::size_t width{ 0 };
  std::size_t height{ 0 };
};

/** \class BandTile
 * \brief Level, roughness and squared details of the positions of a tile, in units of SingleFrame.
 *
 * Level and roughness are computed from the approximation alone, whose white noise is independent of the noise of the
 * details: a selection by them does not change the distribution of the details. Positions whose windows hold a pixel
 * that is not finite or masked have a roughness of NaN. */
class SensorNoise_EXPORT BandTile
{
public:
  /** Computes all positions of the tile. */
  template <typename TPixel>
  void
  Compute(const SingleFrame<TPixel> & frame, const TileOfPositions & tile);

  std::size_t
  Positions() const
  {
    return m_Tile.width * m_Tile.height;
  }
  std::size_t
  Width() const
  {
    return m_Tile.width;
  }

  std::vector<float> level; ///< mean of the approximation in the window
  std::vector<float>
    roughness;               ///< unbiased variance of a pixel's noise, by the approximation's deviations in the window
  std::vector<float> detail; ///< diagonal detail
  std::vector<float> diagonal;   ///< square of the diagonal detail
  std::vector<float> horizontal; ///< square of the horizontal detail
  std::vector<float> vertical;   ///< square of the vertical detail

private:
  template <typename TPixel>
  void
  LoadRow(const SingleFrame<TPixel> & frame, std::size_t y);

  void
  TransformRow(std::size_t row, bool hasDetails);
  void
  MeasureWindows();

  TileOfPositions    m_Tile;
  std::size_t        m_Columns{ 0 };      ///< coefficients of the approximation along a row
  std::size_t        m_Half{ 0 };         ///< even, or odd, pixels of a row
  std::vector<float> m_Rows;              ///< the last 6 rows of pixels: the even pixels, then the odd pixels of each
  std::vector<float> m_Mixed;             ///< sums of these rows, with the weights of approximation and details
  std::vector<float> m_Approximation;     ///< approximation of the tile and its surroundings
  std::vector<float> m_SquaredDeviations; ///< squared deviations of the approximation from its local mean
  std::vector<float> m_Sums;              ///< sums of rows
};

class BandTile;
struct LevelLimits;

/** Positions of a sample with about one level: the half of the positions with the least roughness. Its numbers are in
 * units of SingleFrame. */
struct StartingGroup
{
  double level{ 0.0 };
  double variance{ 0.0 }; ///< variance from the median of the squared diagonal details
};

/** Groups of a sample, made before any line is known. */
struct StartingGroups
{
  std::vector<StartingGroup> groups;     ///< groups of equal count, from dark to bright; empty: no value is finite
  double                     low{ 0.0 }; ///< levels between which nearly all positions lie
  double                     high{ 0.0 };
  double                     medianVariance{ 0.0 };
};

SensorNoise_EXPORT StartingGroups
MakeStartingGroups(const std::vector<BandTile> & sample);

/** Returns the line through the groups that are no closer to a clip level than two standard deviations, by least
 * squares relative to the variance; a constant where there are fewer than two. [DN] */
SensorNoise_EXPORT CentredLine
FitStartingLine(const StartingGroups & groups, const LevelLimits & limits, double originDn, double unitDn);

/** Level sets of equal width, and the variance that is expected of each, in units of SingleFrame. Levels beyond the
 * ends belong to the first and the last set. */
struct LevelGrid
{
  double             low{ 0.0 };
  double             perLevel{ 1.0 }; ///< sets per unit of level
  std::vector<float> variance;        ///< expected, of each set

  double
  CentreOf(std::size_t set) const
  {
    return low + (static_cast<double>(set) + 0.5) / perLevel;
  }
  /** Returns the set of a level; the first one for NaN. */
  std::size_t
  SetOf(float level) const
  {
    const auto last = static_cast<float>(variance.size() - 1);
    // std::max replaces NaN by 0
    return static_cast<std::size_t>(
      std::min(std::max(0.0F, (level - static_cast<float>(low)) * static_cast<float>(perLevel)), last));
  }
};

/** Sums over the positions of each level set whose windows are even. Squares are relative to the expected variance. */
struct LevelSums
{
  struct Set
  {
    double positions{ 0.0 };
    double level{ 0.0 };
    double diagonals{ 0.0 };       ///< number of details that are not too large
    double diagonalSquares{ 0.0 }; ///< their squares
    double sides{ 0.0 };           ///< number of horizontal and vertical details that are not too large
    double sideSquares{ 0.0 };
  };
  std::vector<Set> sets;
  double           finite{ 0.0 }; ///< positions, even or not, without a pixel that is not finite
  double           even{ 0.0 };   ///< positions in all sets

  /** Adds the positions of a tile. */
  void
  Add(const BandTile & tile, const LevelGrid & grid);

  void
  Add(const LevelSums & other);
};

/** Details from which the variance is computed. */
enum class DetailBand
{
  Diagonal, ///< with the least texture, and free of noise of rows and columns
  Sides     ///< horizontal and vertical
};

/** Returns the level sets with their variances [DN^2]: the scale of the normal distribution whose squares, truncated at
 * Significance.oneTest expected standard deviations, have the mean that was found. All sets of the grid; empty ones
 * have no details. */
SensorNoise_EXPORT std::vector<LevelSet>
MakeLevelSets(const LevelSums & sums, const LevelGrid & grid, DetailBand band, double originDn, double unitDn);

/** Returns the variance of the normal distribution whose squares, of the values below \a limit, have the mean \a
 * square; infinite if no normal distribution has. */
SensorNoise_EXPORT double
VarianceOfTruncated(double square, double limit);

/** \class DetailCorrelation
 * \brief Correlation of the diagonal details of neighbouring positions without edges, by lag.
 *
 * The details of white noise are uncorrelated, because the wavelet is orthonormal. Fine periodic texture, such as a
 * weave, has the same power in all bands of details and passes as noise, but its details repeat from position to
 * position. The correlation is about the fraction of their variance that is texture. */
class SensorNoise_EXPORT DetailCorrelation
{
public:
  /** Correlation of a lag. */
  struct Lag
  {
    int    x{ 0 };               ///< lag along a row [coefficients, 2 pixels each]
    int    y{ 0 };               ///< lag across the rows
    double value{ 0.0 };         ///< [1]
    double standardError{ 0.0 }; ///< standard error for white noise [1]
  };

  /** Adds the pairs of positions of a tile. Positions with edges, or with a detail that is too large, are left out. */
  void
  Add(const BandTile & tile, const LevelGrid & grid);

  void
  Add(const DetailCorrelation & other);

  /** Returns the lag with the largest size of the correlation; all 0: there is no pair. */
  Lag
  Largest() const;

private:
  struct Place
  {
    int x;
    int y;
  };
  struct Sums
  {
    double pairs{ 0.0 };
    double products{ 0.0 };
    double squares{ 0.0 }; ///< mean squares of the two positions of a pair, relative to the expected variance
  };
  static constexpr std::array<Place, 6> Places{ { { 1, 0 }, { 0, 1 }, { 1, 1 }, { -1, 1 }, { 2, 0 }, { 0, 2 } } };

  std::array<Sums, Places.size()> m_Sums{};
};

} // namespace sensornoise

#endif
