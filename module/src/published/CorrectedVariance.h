// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_CorrectedVariance_h
#define sensornoise_published_CorrectedVariance_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "published/Flicker.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class CorrectedVariance
 * \brief Temporal variance of the flicker-corrected stack u^ = u - (1 + gamma_t)(ubar - mu), (3.18), computed without
 * u^.
 *
 * With the centred flicker c_t = gamma_t(y) - mean over t, P = sum c_t^2 and C = sum c_t u, the sum of squares of u^
 * about its mean is
 *
 *     M - 2 (ubar - mu) C + (ubar - mu)^2 P,
 *
 * where M is the sum of squares of u about its mean: (3.18) expanded. So one more pass over the stack, which sums one
 * number C per pixel, replaces the corrected stack of (3.24).
 *
 * The centred flicker is rounded to multiples of a power of 2, with the bits that the sums over all frames leave of a
 * double's 53 (30 bits for 100 frames). With integer pixels, the order of frames and parts of the stack therefore does
 * not change a bit. Floating-point frames are added one by one in the order of time. Pixels of rows whose flicker is
 * not known get NaN.
 *
 * Memory: 8 bytes per pixel, and 8 bytes per frame and row. */
class SensorNoise_EXPORT CorrectedVariance
{
public:
  /** Prepares the sums, all 0, for \a frames frames with the flicker and offset of \a flicker. */
  CorrectedVariance(const FlickerEstimate & flicker,
                    const FrameGeometry &   geometry,
                    std::size_t             frames,
                    const ParallelFor &     parallelFor = SerialFor);

  /** Adds row \a y of \a count frames from frame \a t on. The frames lie in \a frames as \a layout describes. Different
   * rows may be added at the same time. */
  template <typename TPixel>
  void
  AddRow(const TPixel * frames, const PixelLayout & layout, std::size_t count, std::size_t t, std::size_t y);

  /** Sets all sums to 0. */
  void
  Forget();

  /** Writes the sums, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Adds the sums over other frames from a stream. Throws std::runtime_error, and changes nothing, if the stream ends
   * early. */
  void
  Merge(std::istream & in);

  /** Returns the unbiased variance of u^ at pixel \a p from the mean and the squared deviations of u [DN^2]; NaN if the
   * flicker of its row is not known. */
  double
  GetVariance(std::size_t p, double meanDn, double sumOfSquaredDeviationsDn2) const;

private:
  FrameGeometry             m_Geometry;
  std::size_t               m_Frames;
  double                    m_OffsetDn;
  std::size_t               m_Rows; // number of rows along the shutter's axis; 1: one flicker for the whole frame
  std::vector<double>       m_Cross;
  std::vector<double>       m_Series;
  std::vector<double>       m_SeriesSums; // nonzero by rounding alone
  std::vector<double>       m_SeriesSquares;
  std::vector<std::uint8_t> m_Known;
};

} // namespace sensornoise

#endif
