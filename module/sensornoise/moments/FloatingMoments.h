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
#ifndef sensornoise_moments_FloatingMoments_h
#define sensornoise_moments_FloatingMoments_h

#include "sensornoise/base/BinaryStream.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class FloatingMoments
 * \brief Running moments over time of every pixel of a stack of floating-point frames: mean, variance, minimum,
 * maximum.
 *
 * Welford's recurrence adds the frames one by one in time order, so that chunks and threads change no bit. Sums made
 * separately are merged by the formula of Chan, Golub & LeVeque (1983), which agrees to 1e-12 with adding the frames.
 * A pixel that was NaN or infinite once is not finite any more: IsFinite() tells.
 *
 * Usage as IntegerMoments: AddFrames() for ranges of pixels that cover the frame once, then AdvanceFrames().
 *
 * Memory: 32 bytes a pixel, whatever the number of frames.
 *
 * \tparam TPixel float or double.
 */
template <typename TPixel>
class FloatingMoments
{
  static_assert(std::is_floating_point_v<TPixel>, "FloatingMoments holds float and double pixels");

public:
  explicit FloatingMoments(std::size_t pixels = 0)
    : m_Mean(pixels, 0.0)
    , m_Squares(pixels, 0.0)
    , m_Minimum(pixels, std::numeric_limits<double>::infinity())
    , m_Maximum(pixels, -std::numeric_limits<double>::infinity())
  {}

  /** Adds \a frames frames for the pixels [begin, end). \a firstFrame points at pixel 0 of the first frame, and each
   * next frame begins \a stride pixels later. */
  void
  AddFrames(const TPixel * firstFrame, std::size_t stride, std::size_t frames, std::size_t begin, std::size_t end)
  {
    constexpr std::size_t blockSize = 512; // the block's sums stay in the first-level cache
    for (std::size_t block = begin; block < end; block += blockSize)
    {
      const std::size_t blockEnd = std::min(block + blockSize, end);
      for (std::size_t t = 0; t < frames; ++t)
      {
        const TPixel * const frame = firstFrame + t * stride;
        const double         share = 1.0 / static_cast<double>(m_Frames + t + 1);
        for (std::size_t p = block; p < blockEnd; ++p)
        {
          const double value = frame[p];
          const double deviation = value - m_Mean[p];
          m_Mean[p] += deviation * share;
          m_Squares[p] += deviation * (value - m_Mean[p]);
          m_Minimum[p] = value < m_Minimum[p] ? value : m_Minimum[p];
          m_Maximum[p] = value > m_Maximum[p] ? value : m_Maximum[p];
        }
      }
    }
  }

  /** Tells that \a frames frames have been added for every pixel. */
  void
  AdvanceFrames(std::size_t frames)
  {
    m_Frames += frames;
  }

  /** Adds the sums of later frames of the same pixels. */
  void
  Merge(const FloatingMoments & later)
  {
    if (later.GetNumberOfPixels() != this->GetNumberOfPixels())
    {
      throw std::invalid_argument("moments of frames of " + std::to_string(later.GetNumberOfPixels()) +
                                  " pixels cannot be merged into those of frames of " +
                                  std::to_string(this->GetNumberOfPixels()) + " pixels");
    }
    const std::size_t frames = m_Frames + later.m_Frames;
    if (later.m_Frames == 0)
    {
      return;
    }
    const double share = static_cast<double>(later.m_Frames) / static_cast<double>(frames);
    const double weight = static_cast<double>(m_Frames) * share;
    for (std::size_t p = 0; p < m_Mean.size(); ++p)
    {
      const double deviation = later.m_Mean[p] - m_Mean[p];
      m_Mean[p] += deviation * share;
      m_Squares[p] += later.m_Squares[p] + deviation * deviation * weight;
      m_Minimum[p] = std::min(m_Minimum[p], later.m_Minimum[p]);
      m_Maximum[p] = std::max(m_Maximum[p], later.m_Maximum[p]);
    }
    m_Frames = frames;
  }

  /** Writes the moments, see BinaryStream. */
  void
  Save(std::ostream & out) const
  {
    WriteSumsHeader(out, StreamName(), m_Mean.size(), m_Frames);
    WriteNumbers(out, m_Mean);
    WriteNumbers(out, m_Squares);
    WriteNumbers(out, m_Minimum);
    WriteNumbers(out, m_Maximum);
  }

  /** Replaces the moments by those of a stream. Throws std::runtime_error, and changes nothing, if it holds other sums,
   * or those of another type or number of pixels, or ends early. */
  void
  Restore(std::istream & in)
  {
    FloatingMoments read(m_Mean.size());
    read.m_Frames = ReadSumsHeader(in, StreamName(), m_Mean.size());
    ReadNumbers(in, read.m_Mean);
    ReadNumbers(in, read.m_Squares);
    ReadNumbers(in, read.m_Minimum);
    ReadNumbers(in, read.m_Maximum);
    *this = std::move(read);
  }

  std::size_t
  GetNumberOfPixels() const
  {
    return m_Mean.size();
  }
  std::size_t
  GetNumberOfFrames() const
  {
    return m_Frames;
  }

  /** Whether pixel \a p was finite in every frame. */
  bool
  IsFinite(std::size_t p) const
  {
    return std::isfinite(m_Squares[p]);
  }

  /** Mean of pixel \a p over time [DN]; NaN if it is not finite. */
  double
  GetMean(std::size_t p) const
  {
    return this->IsFinite(p) ? m_Mean[p] : std::numeric_limits<double>::quiet_NaN();
  }

  /** Sum of the squared deviations of pixel \a p from its mean [DN^2]. */
  double
  GetSumOfSquaredDeviations(std::size_t p) const
  {
    return m_Squares[p];
  }

  /** Unbiased variance of pixel \a p over time [DN^2]; needs two frames. */
  double
  GetVariance(std::size_t p) const
  {
    return m_Squares[p] / static_cast<double>(m_Frames - 1);
  }

  /** Lowest and highest value of pixel \a p over time [DN]; frames that are NaN are passed over. */
  double
  GetMinimum(std::size_t p) const
  {
    return m_Minimum[p];
  }
  double
  GetMaximum(std::size_t p) const
  {
    return m_Maximum[p];
  }

private:
  static std::string
  StreamName()
  {
    return "FloatingMoments " + PixelName<TPixel>();
  }

  std::size_t         m_Frames{ 0 };
  std::vector<double> m_Mean;
  std::vector<double> m_Squares;
  std::vector<double> m_Minimum;
  std::vector<double> m_Maximum;
};

} // namespace sensornoise

#endif
