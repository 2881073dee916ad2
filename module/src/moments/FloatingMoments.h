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
 * Welford's recurrence adds the frames one by one in time order, so that the numbers of threads and of frames per call
 * do not change the result. Sums made separately are merged by the formula of Chan, Golub & LeVeque (1983), which
 * agrees with adding the frames to 1e-12. A pixel with a NaN or an infinity in any frame is not finite, see
 * IsFinite().
 *
 * Usage as IntegerMoments: AddFrames() for ranges of pixels that cover the frame once, then AdvanceFrames().
 *
 * Memory: 32 bytes per pixel, for any number of frames.
 *
 * \tparam TPixel float or double. */
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
  /** Adds \a frames frames whose pixels lie as \a layout specifies. */
  void
  AddFrames(const TPixel *      firstFrame,
            const PixelLayout & layout,
            std::size_t         frames,
            std::size_t         begin,
            std::size_t         end);

  /** Counts \a frames frames, which have been added for every pixel. */
  void
  AdvanceFrames(std::size_t frames)
  {
    m_Frames += frames;
  }

  /** Adds the moments of later frames of the same pixels. Throws std::invalid_argument if the number of pixels differs.
   */
  void
  Merge(const FloatingMoments & later);

  /** Writes the moments, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the moments by the moments of a stream. Throws std::runtime_error, and changes nothing, if the stream
   * ends early or holds other sums, another type or another number of pixels. */
  void
  Restore(std::istream & in);

  /** Moves mean, variance and extremes into maps, which take the memory of the moments. */
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

  /** Returns whether pixel \a p was finite in every frame. */
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

  /** Lowest and highest value of pixel \a p over time [DN]; frames where it is NaN are ignored. */
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
