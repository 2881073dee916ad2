// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_PixelLayout_h
#define sensornoise_base_PixelLayout_h

#include "sensornoise/FrameGeometry.h"
#include "base/Simd.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

/** Prefetches memory that will be needed soon. */
template <typename TValue>
void
PrefetchValues(const TValue * values, std::size_t count)
{
#if defined(__GNUC__)
  constexpr std::size_t lineBytes = 64;
  for (std::size_t i = 0; i < count; i += lineBytes / sizeof(TValue))
  {
    __builtin_prefetch(values + i);
  }
#else
  static_cast<void>(values);
  static_cast<void>(count);
#endif
}

/** Layout of the pixels of frames in memory: contiguous, or every second one, as in a plane of a mosaic. All distances
 * are in pixels. */
struct PixelLayout
{
  std::size_t first{ 0 }; ///< place of the first pixel
  std::size_t step{ 1 };  ///< distance from a pixel to the next one of its row: 1 or 2
  std::size_t row{ 0 };   ///< distance from a row to the next one
  std::size_t frame{ 0 }; ///< distance from a frame to the next one
  std::size_t width{ 0 }; ///< number of pixels of a row

  /** Layout of frames of \a pixels contiguous pixels, \a stride from one to the next. */
  static PixelLayout
  OfPixels(std::size_t pixels, std::size_t stride)
  {
    return { 0, 1, pixels, stride, pixels };
  }
  /** Layout of contiguous frames. */
  static PixelLayout
  OfFrames(const FrameGeometry & geometry)
  {
    return { 0, 1, geometry.width, geometry.Pixels(), geometry.width };
  }

  /** Place of a pixel of the first frame. */
  std::size_t
  At(std::size_t x, std::size_t y) const
  {
    return first + y * row + x * step;
  }
  /** Place of pixel \a p of the first frame, counted row by row. */
  std::size_t
  At(std::size_t p) const
  {
    return this->At(p % width, p / width);
  }

  /** Returns whether all pixels of a frame are contiguous. */
  bool
  AreSideBySide() const
  {
    return step == 1 && row == width;
  }

  /** Calls function(p, place, count) for the runs of the pixels [begin, end), counted row by row, that lie at equal
   * distances. The arguments are the first pixel of the run, its place in a frame, and the number of pixels. */
  template <typename TFunction>
  void
  ForRuns(std::size_t begin, std::size_t end, TFunction function) const
  {
    for (std::size_t p = begin; p < end;)
    {
      const std::size_t count = this->AreSideBySide() ? end - p : std::min(end - p, width - p % width);
      function(p, this->At(p), count);
      p += count;
    }
  }

  /** Prefetches the pixels [begin, end) of the frame that begins at \a start, which will be needed soon. */
  template <typename TPixel>
  void
  Prefetch(const TPixel * start, std::size_t begin, std::size_t end) const
  {
    this->ForRuns(begin, end, [&](std::size_t, std::size_t place, std::size_t count) {
      PrefetchValues(start + place, step * count);
    });
  }

  /** Returns the address of the pixels [begin, end) of the frame that begins at \a start, contiguously: in place, or
   * copied to \a buffer, which has room for them. */
  template <typename TPixel>
  const TPixel *
  SideBySide(const TPixel * start, std::size_t begin, std::size_t end, TPixel * buffer) const
  {
    if (this->AreSideBySide())
    {
      return start + first + begin;
    }
    this->ForRuns(begin, end, [&](std::size_t p, std::size_t place, std::size_t count) {
      const TPixel * const from = start + place;
      TPixel * const       to = buffer + (p - begin);
      CallWithAvx2([&] { step == 2 ? CopyEvery<2>(from, count, to) : CopyEvery<1>(from, count, to); });
    });
    return buffer;
  }

private:
  /** The step is a constant, so that the loop is compiled to SIMD shuffles. */
  template <std::size_t VStep, typename TPixel>
  static void
  CopyEvery(const TPixel * from, std::size_t count, TPixel * to)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      to[i] = from[VStep * i];
    }
  }
};

} // namespace sensornoise

#endif
