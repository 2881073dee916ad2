// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ProjectedFrames_h
#define sensornoise_pixels_ProjectedFrames_h

#include "SensorNoiseExport.h"
#include "base/PixelLayout.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

class TemporalBasis;

/** Integer weights of two frames, |w| <= 2^20, split as w = low + 2048 high. Products of the halves and of 16-bit
 * values stay below 2^25, so that 32 bits hold the sums over 32 frames. Each pair is stored eight times, as SIMD
 * instructions need it. */
struct PairWeights
{
  static constexpr double Step = 2048.0;

  alignas(32) std::int16_t low[16]{};
  alignas(32) std::int16_t high[16]{};

  /** Splits two whole numbers of at most 2^20. */
  PairWeights(double first, double second)
  {
    const double weights[2] = { first, second };
    for (std::size_t k = 0; k < 16; ++k)
    {
      const double above = std::floor(weights[k % 2] / Step + 0.5);
      low[k] = static_cast<std::int16_t>(weights[k % 2] - Step * above);
      high[k] = static_cast<std::int16_t>(above);
    }
  }
};

/** Values of up to 32 frames in up to 256 pixels. For each pair of frames, the two values of a pixel are adjacent.
 * Values beyond Padded() pixels are not used. */
struct FramePairs
{
  static constexpr std::size_t MostPairs = 16;
  static constexpr std::size_t MostPixels = 256;

  /** Returns the number of pixels that are computed for \a pixels: the next multiple of 32. */
  static constexpr std::size_t
  Padded(std::size_t pixels)
  {
    return (pixels + 31) / 32 * 32;
  }

  alignas(32) std::int16_t values[MostPairs][2 * MostPixels];
};

/** Adds to \a sums of \a pixels pixels \a more and the sum over the pairs of frames of weights times values. All
 * numbers are whole, so the result has the same bits on every processor, with or without SIMD instructions.
 * \tparam TSum double, or std::uint32_t for sums modulo 2^32 */
template <typename TSum>
SensorNoise_EXPORT void
AddPairProducts(const FramePairs &               frames,
                const std::vector<PairWeights> & weights,
                TSum                             more,
                std::size_t                      pixels,
                TSum *                           sums);

/** Adds the same sums as AddPairProducts(), without SIMD instructions: for unknown processors, and to test the other
 * versions. */
template <typename TSum>
SensorNoise_EXPORT void
AddPairProductsOneByOne(const FramePairs &               frames,
                        const std::vector<PairWeights> & weights,
                        TSum                             more,
                        std::size_t                      pixels,
                        TSum *                           sums);

/** \class ProjectedFrames
 * \brief Frames that are multiplied by the components of a TemporalBasis, one block of pixels at a time.
 *
 * Integer frames are multiplied and summed in whole numbers, up to 32 frames at once, so that the order of the frames
 * does not change the sums. Doubles hold the sums exactly, because they stay below 2^53 for up to 2^34 frames: the
 * components have the norm 2^20 at most, and a pixel's values have a norm of at most 2^16 times the square root of the
 * number of frames. Sums modulo 2^32 hold what is left of them, see UnitOfNarrowSums(). Floating-point frames are added
 * one by one, in their order. */
template <typename TPixel>
class ProjectedFrames
{
public:
  /** Number of pixels of a block, whose sums with one component are adjacent and stay in the first-level cache. */
  static constexpr std::size_t BlockPixels = FramePairs::MostPixels;

  /** Prepares the frames firstFrame ... firstFrame + count - 1, whose pixels lie as \a layout describes. \a frames and
   * \a basis must outlive the object. */
  ProjectedFrames(const TemporalBasis & basis,
                  const TPixel *        frames,
                  const PixelLayout &   layout,
                  std::size_t           firstFrame,
                  std::size_t           count);

  /** Adds the sums of the pixels [begin, end), at most a block, to sums[j BlockPixels + i], with i from 0 for each
   * component j. Meanwhile the pixels [end, ahead) of the frames and the block of sums at \a next, if not null, are
   * prefetched.
   * \tparam TSum double, or std::uint32_t for sums modulo 2^32 of integer frames */
  template <typename TSum>
  void
  AddTo(TSum * sums, std::size_t begin, std::size_t end, std::size_t ahead, const TSum * next = nullptr) const;

private:
  /** Weights of frames that are added together, in one component. */
  struct Weights
  {
    std::vector<PairWeights> pairs;
    double                   ofMiddle{ 0.0 }; // offset that was subtracted from all values, times the weights
  };

  Weights
  WeightsOf(std::size_t series, std::size_t first, std::size_t count) const;
  template <typename TSum>
  void
  AddTogether(TSum * sums, std::size_t begin, std::size_t end, std::size_t ahead, const TSum * next) const;
  void
  AddOneByOne(double * sums, std::size_t begin, std::size_t end) const;

  const TemporalBasis *             m_Basis;
  const TPixel *                    m_Frames;
  PixelLayout                       m_Layout;
  std::size_t                       m_First;
  std::size_t                       m_Count;
  std::vector<std::vector<Weights>> m_Weights; // by groups of frames that are added together, and by component
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT ProjectedFrames<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

struct InitialNoiseModel;
struct ReferenceFrame;

/** Returns the norm of the integer series of a TemporalBasis, a power of 2 of at most TemporalBasis::Unit, with which
 * 32 bits are enough for the third pass's sums of integer frames; null: they are not enough.
 *
 * They are enough under two conditions. The sum of series times deviation from the mean is within 2^31 for every usable
 * pixel of \a frame. The illumination and the motion that the rounded series do not remove change the variance by at
 * most InPixels.largestRoundingError of its standard error. \a model gives the noise variance. Estimator.md, 6. */
SensorNoise_EXPORT std::optional<double>
UnitOfNarrowSums(const ReferenceFrame &    frame,
                 const InitialNoiseModel & model,
                 const ParallelFor &       parallelFor = SerialFor);

/** Returns whether single precision is enough for the variance of integer frames about their mean, from which the
 * residual squares are computed. A changing illumination makes this variance larger than the variance that remains.
 * Their ratio times the rounding error has to be at most InPixels.largestRoundingError of a pixel's standard error, in
 * the mean square over a sample of the usable pixels. \a model gives the noise variance. Estimator.md, 6. */
SensorNoise_EXPORT bool
IsSingleEnough(const ReferenceFrame & frame, const InitialNoiseModel & model);

} // namespace sensornoise

#endif
