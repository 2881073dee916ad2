// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_CorrectedVariance_h
#define sensornoise_published_CorrectedVariance_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "published/FlickerEstimate.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class CorrectedVariance
 * \brief The temporal variance of the flicker-corrected stack u^ = u - (1 + gamma_t)(ubar - mu), (3.18), without u^.
 *
 * With the centred series c_t = gamma_t(y) - mean over t, P = sum c_t^2 and C = sum c_t u, the sum of squares of u^
 * about its mean is
 *
 *     M - 2 (ubar - mu) C + (ubar - mu)^2 P
 *
 * where M is that of u: (3.18) expanded. So one number a pixel, C, is gathered in one more pass over the stack, and the
 * corrected stack of (3.24) is never made. The series are held as integers, times a power of 2, of as many bits as the
 * sums over all frames leave of a double's 53 (30 bits for 100 frames): with integer pixels, frames and parts of the
 * stack are added in any order with the same bits, in floating point one by one in time order. Pixels of rows whose
 * flicker is not known get NaN.
 *
 * Memory: 8 bytes a pixel and 8 bytes a frame and row.
 */
class SensorNoise_EXPORT CorrectedVariance
{
public:
  CorrectedVariance(const FlickerEstimate & flicker,
                    const FrameGeometry &   geometry,
                    std::size_t             frames,
                    const ParallelFor &     parallelFor = SerialFor);

  /** Adds \a count frames, of which the first is frame \a t, for the row \a y of the image. They stand in \a frames as
   * \a layout says. Rows may be added at the same time. */
  template <typename TPixel>
  void
  AddRow(const TPixel * frames, const PixelLayout & layout, std::size_t count, std::size_t t, std::size_t y);

  /** No frame has been added. */
  void
  Forget();

  /** Writes the sums, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Adds the sums over other frames from a stream. Throws std::runtime_error, and changes nothing, if it ends early.
   */
  void
  Merge(std::istream & in);

  /** Unbiased variance of u^ at pixel \a p [DN^2], from its mean and the squared deviations of u; NaN: not known. */
  double
  GetVariance(std::size_t p, double meanDn, double sumOfSquaredDeviationsDn2) const;

private:
  FrameGeometry             m_Geometry;
  std::size_t               m_Frames;
  double                    m_OffsetDn;
  std::size_t               m_Rows; // as the shutter sees them; 1: one flicker serves the whole frame
  std::vector<double>       m_Cross;
  std::vector<double>       m_Series;
  std::vector<double>       m_SeriesSums; // of rounding alone
  std::vector<double>       m_SeriesSquares;
  std::vector<std::uint8_t> m_Known;
};

} // namespace sensornoise

#endif
