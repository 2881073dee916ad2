// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ProjectedFrames_h
#define sensornoise_pixels_ProjectedFrames_h

#include "SensorNoiseExport.h"
#include "base/PixelLayout.h"
#include "sensornoise/FrameGeometry.h"
#include "pixels/PairProducts.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

class TemporalBasis;

/** \class ProjectedFrames
 * \brief Frames that are multiplied by the series of a TemporalBasis, a block of pixels at a time.
 *
 * Integers are multiplied and summed in whole numbers, up to 32 frames at once: in any order the same sums. They are
 * held in doubles, and below 2^53 for up to 2^34 frames: the series have the norm 2^20, and a pixel's values one of at
 * most 2^16 times the root of the frames. Floating-point frames are added one by one, in their order. */
template <typename TPixel>
class ProjectedFrames
{
public:
  /** Pixels of a block, whose sums with one series lie side by side; they stay in the first-level cache. */
  static constexpr std::size_t BlockPixels = FramePairs::MostPixels;

  /** Frames firstFrame ... firstFrame + count - 1, whose pixels stand as \a layout says, and which must outlive the
   * object, as must \a basis. */
  ProjectedFrames(const TemporalBasis & basis,
                  const TPixel *        frames,
                  const PixelLayout &   layout,
                  std::size_t           firstFrame,
                  std::size_t           count);

  /** Adds the sums of the pixels [begin, end), at most those of a block, to sums[j BlockPixels + i], i from 0, of each
   * series j. Meanwhile the memory of the pixels [end, ahead) of the frames is asked for, and that of \a next, their
   * sums, if there are any. */
  void
  AddTo(double * sums, std::size_t begin, std::size_t end, std::size_t ahead, const double * next = nullptr) const;

private:
  /** What the frames that are added together are multiplied by, of one series. */
  struct Weights
  {
    std::vector<PairWeights> pairs;
    double                   ofMiddle{ 0.0 }; // what was taken off all values, times the weights
  };

  Weights
  WeightsOf(std::size_t series, std::size_t first, std::size_t count) const;
  void
  AddTogether(double * sums, std::size_t begin, std::size_t end, std::size_t ahead, const double * next) const;
  void
  AddOneByOne(double * sums, std::size_t begin, std::size_t end) const;

  const TemporalBasis *             m_Basis;
  const TPixel *                    m_Frames;
  PixelLayout                       m_Layout;
  std::size_t                       m_First;
  std::size_t                       m_Count;
  std::vector<std::vector<Weights>> m_Weights; // of frames that are added together, and series
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT ProjectedFrames<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
