/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_published_CorrectedVariance_h
#define sensornoise_published_CorrectedVariance_h

#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/published/FlickerEstimate.h"

#include <cstddef>
#include <cstdint>
#include <limits>
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
 * corrected stack of (3.24) is never made. Frames are added one by one in time order, so that chunks and threads
 * change no bit. Pixels of lines whose flicker is not known get NaN.
 *
 * Memory: 8 bytes a pixel and 8 bytes a frame and line.
 */
class CorrectedVariance
{
public:
  CorrectedVariance(const FlickerEstimate & flicker, const FrameGeometry & geometry, std::size_t frames)
    : m_Geometry(geometry)
    , m_Frames(frames)
    , m_OffsetDn(flicker.offsetDn)
    , m_Lines(flicker.gammaLines.empty() ? 1 : flicker.lines)
    , m_Cross(geometry.Pixels(), 0.0)
    , m_Series(frames * m_Lines)
    , m_SeriesSquares(m_Lines, 0.0)
    , m_Known(flicker.lineKnown)
  {
    for (std::size_t line = 0; line < m_Lines; ++line)
    {
      double mean = 0.0;
      for (std::size_t t = 0; t < frames; ++t)
      {
        mean += flicker.Gamma(t, line);
      }
      mean /= static_cast<double>(frames);
      for (std::size_t t = 0; t < frames; ++t)
      {
        const double centred = flicker.Gamma(t, line) - mean;
        m_Series[t * m_Lines + line] = centred;
        m_SeriesSquares[line] += centred * centred;
      }
    }
  }

  /** Adds \a frames frames, of which the first is frame \a t, for the row \a y. \a firstFrame points at pixel 0 of
   * the first frame, and each next frame begins \a stride pixels later. Rows may be added at the same time. */
  template <typename TPixel>
  void
  AddRow(const TPixel * firstFrame, std::size_t stride, std::size_t frames, std::size_t t, std::size_t y)
  {
    const std::size_t width = m_Geometry.width;
    double * const    cross = m_Cross.data() + y * width;
    const bool        alongRow = m_Lines > 1 && m_Geometry.shutterAxis == 0;
    for (std::size_t k = 0; k < frames; ++k)
    {
      const TPixel * const row = firstFrame + k * stride + y * width;
      const double * const series = m_Series.data() + (t + k) * m_Lines;
      if (alongRow)
      {
        for (std::size_t x = 0; x < width; ++x)
        {
          cross[x] += series[x] * static_cast<double>(row[x]);
        }
      }
      else
      {
        const double factor = series[m_Lines > 1 ? y : 0];
        for (std::size_t x = 0; x < width; ++x)
        {
          cross[x] += factor * static_cast<double>(row[x]);
        }
      }
    }
  }

  /** Unbiased variance of u^ at pixel \a p [DN^2], from its mean and the squared deviations of u; NaN: not known. */
  double
  GetVariance(std::size_t p, double meanDn, double sumOfSquaredDeviationsDn2) const
  {
    const std::size_t line = m_Lines > 1 ? m_Geometry.RowOf(p) : 0;
    if (!m_Known.empty() && m_Known[line] == 0)
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double fluxDn = meanDn - m_OffsetDn;
    const double squares =
      sumOfSquaredDeviationsDn2 - 2.0 * fluxDn * m_Cross[p] + fluxDn * fluxDn * m_SeriesSquares[line];
    return squares / static_cast<double>(m_Frames - 1);
  }

private:
  FrameGeometry             m_Geometry;
  std::size_t               m_Frames;
  double                    m_OffsetDn;
  std::size_t               m_Lines;
  std::vector<double>       m_Cross;
  std::vector<double>       m_Series;
  std::vector<double>       m_SeriesSquares;
  std::vector<std::uint8_t> m_Known;
};

} // namespace sensornoise

#endif
