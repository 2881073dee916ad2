// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_BandTile_h
#define sensornoise_single_BandTile_h

#include "base/PixelLayout.h"
#include "single/Wavelet.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** A frame, or a plane of a mosaic, and the unit in which its levels are computed. */
template <typename TPixel>
struct SingleFrame
{
  const TPixel *       pixels{ nullptr };
  PixelLayout          layout; ///< its width is the plane's
  std::size_t          height{ 0 };
  const std::uint8_t * mask{ nullptr }; ///< by place, as the pixels: 0 is left out; null: none is
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
 * Level and roughness are made of the approximation alone, whose white noise is independent of the noise of the
 * details: a selection by them does not change the distribution of the details. Positions whose windows hold a pixel
 * that is not finite or masked have a roughness of NaN. */
class BandTile
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

  std::vector<float> level; ///< mean of the approximation in the window
  std::vector<float>
    roughness; ///< unbiased variance of a pixel's noise, by the approximation's deviations in the window
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
  std::vector<float> m_Rows;              ///< the last 6 rows of pixels: the even ones, then the odd ones
  std::vector<float> m_Mixed;             ///< sums of these rows, with the weights of approximation and details
  std::vector<float> m_Approximation;     ///< of the tile and its surroundings
  std::vector<float> m_SquaredDeviations; ///< of the approximation from its smooth
  std::vector<float> m_Sums;              ///< sums of rows
};

} // namespace sensornoise

#endif
