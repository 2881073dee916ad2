// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_TemporalMoments_h
#define sensornoise_moments_TemporalMoments_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <ostream>
#include <type_traits>
#include <vector>

namespace sensornoise
{

/** Maps of the temporal moments of a stack, each of a frame's size, after all of its frames have been added. */
template <typename TPixel>
struct TemporalMaps
{
  using Extreme = std::conditional_t<std::is_integral_v<TPixel>, std::int16_t, double>;
  /** Centre that is subtracted from the stored extremes [DN]: only unsigned 16-bit values need it to fit a signed
   * 16-bit number. */
  static constexpr std::int32_t Centre = std::is_unsigned_v<TPixel> && sizeof(TPixel) == 2 ? 32768 : 0;

  std::vector<double> mean;     ///< mean over time [DN]; NaN where the pixel was not finite in a frame
  std::vector<double> variance; ///< unbiased variance over time [DN^2]; 0 for a single frame; not finite where the
                                ///< mean is not
  std::vector<Extreme> minimum; ///< lowest value over time, minus Centre [DN]
  std::vector<Extreme> maximum; ///< highest value over time, minus Centre [DN]
  const std::uint8_t * mask{ nullptr }; ///< 0 at the pixels that are not measured; null: all are

  std::size_t
  GetNumberOfPixels() const
  {
    return mean.size();
  }
  /** Returns whether pixel \a p was finite in every frame. */
  bool
  IsFinite(std::size_t p) const
  {
    return std::is_integral_v<TPixel> || std::isfinite(mean[p]);
  }
  /** Returns whether pixel \a p is to be measured, and was finite in every frame. */
  bool
  IsMeasured(std::size_t p) const
  {
    return this->IsFinite(p) && (mask == nullptr || mask[p] != 0);
  }
  /** Lowest and highest value of pixel \a p over time [DN]; frames where it is NaN are ignored. */
  double
  GetMinimum(std::size_t p) const
  {
    return minimum[p] + Centre;
  }
  double
  GetMaximum(std::size_t p) const
  {
    return maximum[p] + Centre;
  }
};

/** \class IntegerMoments
 * \brief Exact sums over time of every pixel of a stack of 8- or 16-bit frames: mean, variance, minimum, maximum.
 *
 * Each value u [DN] is held as s = u - centre, which fits a signed 16-bit number. The sums S = sum s and Q = sum s^2
 * are exact: doubles hold integers up to 2^53, and the maps of mean and variance can take their memory. Frames may be
 * added, and parts merged, in any order and in any number of threads: the result has the same bits. The variance is
 * unbiased (section 2.3.1 of Sur & Gredi\'ac 2015, https://doi.org/10.1137/140977035), and the terms of its difference
 * are exact, too.
 *
 * Usage: for each run of frames, call AddFrames() for ranges of pixels that cover the frame once (different threads
 * may add ranges at the same time), then AdvanceFrames() once.
 *
 * Memory: 20 bytes per pixel, for any number of frames up to MostFrames.
 *
 * \tparam TPixel unsigned char, signed char, unsigned short or short. */
template <typename TPixel>
class IntegerMoments
{
  static_assert(std::is_integral_v<TPixel> && sizeof(TPixel) <= 2, "IntegerMoments holds 8- and 16-bit pixels");

public:
  /** Largest number of frames: up to it S^2 / n and Q, and the terms whose difference is the variance, are at most
   * 2^52. */
  static constexpr std::size_t MostFrames = std::size_t{ 1 } << 22;

  explicit IntegerMoments(std::size_t pixels = 0, const ParallelFor & parallelFor = SerialFor);

  /** Adds \a frames frames for the pixels [begin, end). \a firstFrame points at pixel 0 of the first frame, and each
   * next frame begins \a stride pixels later. */
  void
  AddFrames(const TPixel * firstFrame, std::size_t stride, std::size_t frames, std::size_t begin, std::size_t end)
  {
    this->AddFrames(firstFrame, PixelLayout::OfPixels(m_Sum.size(), stride), frames, begin, end);
  }
  /** Adds \a frames frames whose pixels lie as \a layout specifies. */
  void
  AddFrames(const TPixel *      firstFrame,
            const PixelLayout & layout,
            std::size_t         frames,
            std::size_t         begin,
            std::size_t         end);

  /** Counts \a frames frames, which have been added for every pixel. Throws std::invalid_argument if there are more
   * than MostFrames in all. */
  void
  AdvanceFrames(std::size_t frames);

  /** Adds the sums of other frames of the same pixels: exact, in any order. Throws std::invalid_argument if the number
   * of pixels differs, or if both together have more than MostFrames. */
  void
  Merge(const IntegerMoments & other);

  /** Writes the sums, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the sums by the sums of a stream. Throws std::runtime_error, and changes nothing, if the stream ends
   * early or holds other sums, another type or another number of pixels. */
  void
  Restore(std::istream & in);

  /** Moves mean, variance and extremes into maps, which take the memory of the sums. */
  TemporalMaps<TPixel>
  TakeMaps(const ParallelFor & parallelFor = SerialFor);

  std::size_t
  GetNumberOfPixels() const
  {
    return m_Sum.size();
  }
  std::size_t
  GetNumberOfFrames() const
  {
    return m_Frames;
  }

  /** Returns true: integers are always finite. */
  bool
  IsFinite(std::size_t) const
  {
    return true;
  }

  /** Mean of pixel \a p over time [DN]. */
  double
  GetMean(std::size_t p) const
  {
    return m_Sum[p] / static_cast<double>(m_Frames) + Centre;
  }

  /** Sum of the squared deviations of pixel \a p from its mean [DN^2].
   *
   * With S = q n + r, the sum of squares about the integer q is A = Q - q (S + r), exactly; about the mean it is A -
   * r^2/n. Rounding does not make S / n an integer: the distance of |S| <= 2^37 from the next multiple of n <= 2^22 is
   * more than 2^-53 of it. */
  double
  GetSumOfSquaredDeviations(std::size_t p) const
  {
    const auto   n = static_cast<double>(m_Frames);
    const double q = static_cast<std::int32_t>(m_Sum[p] / n);
    const double r = m_Sum[p] - q * n;
    const double aboutQ = m_SumOfSquares[p] - q * (m_Sum[p] + r);
    return aboutQ - r * r / n;
  }

  /** Unbiased variance of pixel \a p over time [DN^2]; needs two frames. */
  double
  GetVariance(std::size_t p) const
  {
    return this->GetSumOfSquaredDeviations(p) / static_cast<double>(m_Frames - 1);
  }

  /** Lowest and highest value of pixel \a p over time [DN]. */
  double
  GetMinimum(std::size_t p) const
  {
    return m_Minimum[p] + Centre;
  }
  double
  GetMaximum(std::size_t p) const
  {
    return m_Maximum[p] + Centre;
  }

private:
  static constexpr std::int32_t Centre = TemporalMaps<TPixel>::Centre;

  void
  AddBlock(const TPixel *      firstFrame,
           const PixelLayout & layout,
           std::size_t         frames,
           std::size_t         begin,
           std::size_t         size);

  std::size_t               m_Frames{ 0 };
  std::vector<double>       m_Sum;          // integers
  std::vector<double>       m_SumOfSquares; // integers
  std::vector<std::int16_t> m_Minimum;
  std::vector<std::int16_t> m_Maximum;
};

extern template class SensorNoise_EXPORT IntegerMoments<unsigned char>;
extern template class SensorNoise_EXPORT IntegerMoments<signed char>;
extern template class SensorNoise_EXPORT IntegerMoments<unsigned short>;
extern template class SensorNoise_EXPORT IntegerMoments<short>;

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

/** The temporal moments for a pixel type: exact sums for integers, Welford's recurrence for floating point. */
template <typename TPixel>
using TemporalMoments = std::conditional_t<std::is_integral_v<TPixel>, IntegerMoments<TPixel>, FloatingMoments<TPixel>>;

} // namespace sensornoise

#endif
