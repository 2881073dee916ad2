// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_NoiseResiduals_h
#define sensornoise_correlation_NoiseResiduals_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "correlation/Constants.h"
#include "correlation/FrameSample.h"
#include "correlation/NoiseSample.h"
#include "correlation/UnequalFrames.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** What is known of the pixels of a frame whose noise is looked at. */
struct SampledPixels
{
  const std::vector<double> &       mean;                 ///< of each pixel or its neighbours [DN]
  const std::vector<std::uint8_t> & take;                 ///< 1: static and not clipped
  double                            blackDn{ 0.0 };       ///< level without light, from which light is measured
  bool                              isBlackKnown{ true }; ///< else it is a level that nothing can be below
};

/** The level from which light is measured where nothing tells it [DN]: the darkest if that is near \a blackDn, which it
 * is not below, else that. What is shared in proportion to the variance is in proportion to the light above a level
 * that is below. */
inline double
ZeroOfLight(double darkestDn, double brightestDn, double blackDn)
{
  return darkestDn - blackDn < InCorrelation.darkShare * (brightestDn - blackDn) ? darkestDn : blackDn;
}

/** \class NoiseResiduals
 * \brief What is left of a NoiseSample when the series of the scene are projected out of every pixel: its noise.
 *
 * r = P u with P = I - Q Q', where Q spans the constant and the series. For noise that is white in time,
 * E[sum_t r_t(p) r_t(q)] = C_pq tr P. */
class SensorNoise_EXPORT NoiseResiduals
{
public:
  /** Bins of equal count along the light, in which what is shared is summed: four tell a constant from a line and a
   * parabola. */
  static constexpr std::size_t LightBins = 4;

  /** \a series: frames x series, of all frames or of those of the sample. Takes the sample's memory. */
  NoiseResiduals(NoiseSample             sample,
                 const Eigen::MatrixXd & series,
                 const SampledPixels &   pixels,
                 const ParallelFor &     parallelFor);
  /** Of a sample of frames, above the pixels' means, whose tiles are worked on while they are in the cache. */
  NoiseResiduals(FrameSample             sample,
                 const Eigen::MatrixXd & series,
                 const SampledPixels &   pixels,
                 const ParallelFor &     parallelFor);

  /** Takes other pixels. */
  void
  Take(const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor);

  /** Takes off what the pixels of a line, a row or a column, share in a frame: of each frame and each line of tiles in
   * a row, the regression on 1 and the light, by the pixels of \a take. That is all illumination that lines have of
   * their own, whatever the level without light, and the noise of whole lines. Of a pixel's variance it takes the
   * pixel's leverage h in that regression, for which all values of the pixel are divided by sqrt(1 - h): its variance
   * stays. Returns 1 - h of the pixels, tile by tile [1]; 0 where that is small, or the line has no pixel of \a take.
   * Estimator.md, 3.18. */
  std::vector<float>
  TakeOffLines(LineAxis axis, const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor);

  /** Allows for noise that differs from frame to frame; \a frames are all of the stack, of which the sample has the
   * first. Without it all are alike. */
  void
  SetUnequalFrames(UnequalFrames frames);
  const UnequalFrames &
  GetUnequalFrames() const
  {
    return m_Unequal;
  }

  /** Leaves out the first frames, which may be other than the rest: a recursive filter begins with a frame that it has
   * not filtered. The typical variance stays that of all frames. */
  void
  DropFirst(std::size_t frames, const ParallelFor & parallelFor);

  const SampleTiles &
  GetTiles() const
  {
    return m_Sample.GetTiles();
  }
  /** Residuals of tile \a i as in NoiseSample. */
  const float *
  OfTile(std::size_t i) const
  {
    return m_Sample.OfTile(i);
  }
  /** The pixel of the frame that is pixel \a p of tile \a i. */
  std::size_t
  PixelOf(std::size_t i, std::size_t p) const
  {
    return m_Sample.PixelOf(i, p);
  }
  /** The light of the pixels of tile \a i [DN above black]. */
  const float *
  LightOf(std::size_t i) const
  {
    return m_Light.data() + i * this->GetTiles().Pixels();
  }
  /** The inverse of the noise's typical variance at the light of the pixels of tile \a i; 0: the pixel is left out
   * [1/DN^2]. */
  const float *
  WeightOf(std::size_t i) const
  {
    return m_Weight.data() + i * this->GetTiles().Pixels();
  }
  /** The sums over the frames of the squares of the pixels of tile \a i [DN^2]. */
  const float *
  SquaresOf(std::size_t i) const
  {
    return m_Variance.data() + i * this->GetTiles().Pixels();
  }
  /** The axis along which TakeOffLines() was called, if it was. The residuals of two pixels of a line then have the
   * covariance -(a a' + b b') in a frame, where the noise is white, with a and b the pixels' \a LineSharesOf() [DN]. */
  const std::optional<LineAxis> &
  GetLinesTakenOff() const
  {
    return m_LinesTakenOff;
  }
  std::array<const float *, 2>
  LineSharesOf(std::size_t i) const
  {
    const std::size_t first = i * this->GetTiles().Pixels();
    return { m_LineShares[0].data() + first, m_LineShares[1].data() + first };
  }
  /** The bins of the light of the pixels of tile \a i. */
  const std::uint8_t *
  BinOf(std::size_t i) const
  {
    return m_Bin.data() + i * this->GetTiles().Pixels();
  }
  /** Orthonormal, frames x (1 + series). */
  const Eigen::MatrixXd &
  GetBasis() const
  {
    return m_Basis;
  }
  /** tr P. */
  double
  GetFreedom() const
  {
    return static_cast<double>(m_Basis.rows() - m_Basis.cols());
  }
  /** The level from which light is measured [DN]. */
  double
  GetBlackDn() const
  {
    return m_BlackDn;
  }
  /** Light that no pixel can be below: none where black is known, else that of the darkest pixels [DN]. */
  double
  GetLeastLight() const
  {
    return m_IsBlackKnown ? 0.0 : m_DarkestLight;
  }
  /** Pixels that are taken. */
  std::size_t
  GetNumberOfPixels() const
  {
    return m_Pixels;
  }
  /** Whether tiles and pixels are enough to measure what the noise of pixels has in common. */
  bool
  HasEnoughPixels() const;

private:
  /** \a fillTile(i) sees to it that the values of a tile are there. */
  template <typename TFillTile>
  void
  Project(const SampledPixels & pixels, const ParallelFor & parallelFor, TFillTile fillTile);
  void
  ProjectTile(std::size_t i);
  void
  SumSquares(std::size_t i);
  /** TakeOffLines() of the lines \a line of \a tiles, whose values are not yet scaled. Notes the shares of the line,
   * and what is left of the variance of each pixel in \a left. */
  void
  RegressLines(LineAxis axis, const std::vector<std::size_t> & tiles, std::size_t line, std::vector<float> & left);
  /** The variance along the light, and its inverse at every pixel. */
  void
  Weigh(const std::vector<std::uint8_t> & take);

  NoiseSample               m_Sample;
  Eigen::MatrixXd           m_Basis;
  std::vector<float>        m_Light;
  std::vector<float>        m_Variance; // sum over time of the squares
  std::vector<float>        m_Weight;
  std::vector<std::uint8_t> m_Bin;
  std::size_t               m_Pixels{ 0 };
  double                    m_BlackDn{ 0.0 };
  bool                      m_IsBlackKnown{ true };
  double                    m_DarkestLight{ 0.0 };
  UnequalFrames             m_Unequal;
  std::optional<LineAxis>   m_LinesTakenOff;
  /** LineSharesOf() of all tiles; empty: no lines were taken off. */
  std::array<std::vector<float>, 2> m_LineShares;
};

} // namespace sensornoise

#endif
