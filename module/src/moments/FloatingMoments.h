// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_FloatingMoments_h
#define sensornoise_moments_FloatingMoments_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "moments/TemporalMaps.h"

#include <cmath>
#include <cstddef>
#include <istream>
#include <limits>
#include <ostream>
#include <type_traits>
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
  explicit FloatingMoments(std::size_t pixels = 0, const ParallelFor & parallelFor = SerialFor);

  /** Adds \a frames frames for the pixels [begin, end). \a firstFrame points at pixel 0 of the first frame, and each
   * next frame begins \a stride pixels later. */
  void
  AddFrames(const TPixel * firstFrame, std::size_t stride, std::size_t frames, std::size_t begin, std::size_t end)
  {
    this->AddFrames(firstFrame, PixelLayout::OfPixels(m_Mean.size(), stride), frames, begin, end);
  }
  /** The same for frames whose pixels stand as \a layout says. */
  void
  AddFrames(const TPixel *      firstFrame,
            const PixelLayout & layout,
            std::size_t         frames,
            std::size_t         begin,
            std::size_t         end);

  /** Tells that \a frames frames have been added for every pixel. */
  void
  AdvanceFrames(std::size_t frames)
  {
    m_Frames += frames;
  }

  /** Adds the sums of later frames of the same pixels. */
  void
  Merge(const FloatingMoments & later);

  /** Writes the moments, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the moments by those of a stream. Throws std::runtime_error, and changes nothing, if it holds other sums,
   * or those of another type or number of pixels, or ends early. */
  void
  Restore(std::istream & in);

  /** Mean, variance and extremes as maps, in the memory of the moments, which are given away. */
  TemporalMaps<TPixel>
  TakeMaps(const ParallelFor & parallelFor = SerialFor);

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
  std::size_t         m_Frames{ 0 };
  std::vector<double> m_Mean;
  std::vector<double> m_Squares;
  std::vector<double> m_Minimum;
  std::vector<double> m_Maximum;
};

extern template class SensorNoise_EXPORT FloatingMoments<float>;
extern template class SensorNoise_EXPORT FloatingMoments<double>;

} // namespace sensornoise

#endif
