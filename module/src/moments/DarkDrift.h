// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_DarkDrift_h
#define sensornoise_moments_DarkDrift_h

#include "sensornoise/Parallel.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \class DarkDrift
 * \brief The level that all pixels of dark frames share, frame by frame, and what it adds to a pixel's variance.
 *
 * A black level that drifts adds its variance to that of every pixel. Beside the pixel's sum of squares it needs the
 * pixel's products with the frames' levels: then the pixel's deviations from the frames' levels have exactly the
 * distribution of noise alone, and not a variance that may be negative after a subtraction.
 *
 * A frame's level is the mean of its pixels within 6 standard deviations of their median, as the offset is: a pixel
 * that blinks does not move it. Frames are added one by one in time order, so that threads and chunks change no bit.
 *
 * Memory: 8 bytes a pixel. */
class SensorNoise_EXPORT DarkDrift
{
public:
  /** No drift is known, and none is taken off. */
  DarkDrift() = default;

  /** \param pixels of a frame
   * \param mask nonzero at the pixels that make a frame's level; empty: all do */
  explicit DarkDrift(std::size_t pixels, std::vector<std::uint8_t> mask = {});

  /** Adds the next \a count frames, stored one after the other, of one of the five types of a stack. */
  template <typename TPixel>
  void
  AddFrames(const TPixel * frames, std::size_t count, const ParallelFor & parallelFor);

  /** What is left of the sum of squared deviations of pixel \a p from its mean without the drift [DN^2].
   * \param sumOfSquaresDn2 that of the pixel as it is [DN^2]
   * \param meanDn its mean [DN] */
  double
  SquaresWithoutDrift(std::size_t p, double sumOfSquaresDn2, double meanDn) const;

  /** Variance over time of the level that all pixels share [DN^2]; 0 below two frames.
   * \param pixelVarianceDn2 of the typical pixel without the drift: its share of the levels' variance is taken off */
  double
  GetVarianceDn2(double pixelVarianceDn2) const;

private:
  template <typename TPixel>
  double
  MedianOf(const TPixel * frame) const;
  template <typename TPixel>
  double
  LevelOf(const TPixel * frame) const;
  template <typename TPixel>
  void
  Start(const TPixel * frame);
  double
  GetSumOfSquaresDn2() const;

  std::vector<std::uint8_t> m_Mask;                   // nonzero at the pixels that make the level
  std::vector<std::size_t>  m_Sample;                 // pixels that tell the median
  std::vector<double>       m_LevelsDn;               // of the frames
  std::vector<double>       m_ProductsDn2;            // sum over time of (u - first level) (level - first level)
  double                    m_SumDn{ 0.0 };           // of level - first level
  double                    m_SumOfSquaresDn2{ 0.0 }; // of the same
  double                    m_ReachDn{ 0.0 };         // about the median
  double                    m_LevelPixels{ 0.0 };     // that make the first frame's level
};

} // namespace sensornoise

#endif
