// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_MosaicGeometry_h
#define sensornoise_mosaic_MosaicGeometry_h

#include "base/BytesFingerprint.h"
#include "base/Eigen.h"
#include "base/ParallelWork.h"
#include "base/PixelLayout.h"
#include "base/Simd.h"
#include "correlation/FrameSample.h"
#include "correlation/NoiseCorrelation.h"
#include "moments/DarkFrames.h"
#include "moments/StackFrames.h"
#include "moments/TemporalMoments.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Positions of the pixels of each plane in a frame with a colour mosaic. All planes have the same size: half of the
 * frame's, without the last column or row where its number is odd. */
struct MosaicGeometry
{
  FrameGeometry frame;
  BayerPattern  pattern{ BayerPattern::RGGB };

  /** Returns the size of each plane. */
  FrameGeometry
  Plane() const
  {
    return { frame.width / 2, frame.height / 2, frame.shutterAxis };
  }

  /** Returns the layout of the plane's pixels in frames that lie one after the other. */
  PixelLayout
  LayoutOf(BayerPlane plane) const
  {
    const std::array<std::size_t, 2> corner = CornerOf(pattern, plane);
    return { corner[1] * frame.width + corner[0], 2, 2 * frame.width, frame.Pixels(), frame.width / 2 };
  }

  /** Returns the values of the frame's pixels that belong to the plane; empty if \a ofFrame is empty. */
  template <typename T>
  std::vector<T>
  Take(const std::vector<T> & ofFrame, BayerPlane plane) const
  {
    std::vector<T> ofPlane(ofFrame.empty() ? 0 : this->Plane().Pixels());
    if (!ofPlane.empty())
    {
      this->ForPixels(
        plane, SerialFor, [&](std::size_t inPlane, std::size_t inFrame) { ofPlane[inPlane] = ofFrame[inFrame]; });
    }
    return ofPlane;
  }

  /** Writes the plane's values to their positions in the frame. Does nothing if \a ofPlane is empty. */
  template <typename T>
  void
  Put(const std::vector<T> & ofPlane, BayerPlane plane, T * ofFrame, const ParallelFor & parallelFor = SerialFor) const
  {
    if (!ofPlane.empty())
    {
      this->ForPixels(
        plane, parallelFor, [&](std::size_t inPlane, std::size_t inFrame) { ofFrame[inFrame] = ofPlane[inPlane]; });
    }
  }

  /** Returns the values of a frame from the values of its planes, in the order of BayerPlanes. Pixels of an empty
   * plane, and of a last column or row that belongs to no plane, have the value \a missing. */
  template <typename T>
  std::vector<T>
  Join(const std::array<std::vector<T>, 4> & ofPlanes, T missing, const ParallelFor & parallelFor) const
  {
    const FrameGeometry              size = this->Plane();
    const std::array<std::size_t, 2> red = CornerOf(pattern, BayerPlane::R);
    const std::vector<T>             none(size.width, missing);
    std::vector<T>                   ofFrame = MakeMap<T>(frame.Pixels(), parallelFor, missing);
    parallelFor(2 * size.height, [&](std::size_t y) {
      const std::size_t first = FirstOfRow(y % 2, red);
      const auto        rowOf = [&](std::size_t plane) {
        return ofPlanes[plane].empty() ? none.data() : ofPlanes[plane].data() + y / 2 * size.width;
      };
      const T * const left = rowOf(first + red[0]);
      const T * const right = rowOf(first + 1 - red[0]);
      T * const       to = ofFrame.data() + y * frame.width;
      for (std::size_t x = 0; x < size.width; ++x)
      {
        to[2 * x] = left[x];
        to[2 * x + 1] = right[x];
      }
    });
    return ofFrame;
  }

  /** Copies the planes of \a count frames, which lie one after the other, to the memory at \a to, in the order of
   * BayerPlanes. Each row is read once. */
  template <typename TPixel>
  void
  TakeFrames(const TPixel *                  frames,
             std::size_t                     count,
             const std::array<TPixel *, 4> & to,
             const ParallelFor &             parallelFor) const
  {
    const FrameGeometry              size = this->Plane();
    const std::array<std::size_t, 2> red = CornerOf(pattern, BayerPlane::R);
    const std::size_t                rows = count * size.height;
    const std::size_t                together = std::max<std::size_t>(1, PixelsTogether / (2 * frame.width));
    parallelFor((rows + together - 1) / together, [&](std::size_t block) {
      for (std::size_t row = block * together; row < std::min(rows, (block + 1) * together); ++row)
      {
        const TPixel * pair = frames + row / size.height * frame.Pixels() + row % size.height * 2 * frame.width;
        for (std::size_t y = 0; y < 2; ++y)
        {
          const std::size_t first = FirstOfRow(y, red);
          TakeRow(pair + y * frame.width,
                  size.width,
                  to[first + red[0]] + row * size.width,
                  to[first + 1 - red[0]] + row * size.width);
        }
      }
    });
  }

private:
  /** Number of mosaic pixels that a thread copies at once. Chosen empirically: with a quarter of them copying takes a
   * fifth longer, as every thread then jumps from row to row in memory. With four times as many it is not faster. */
  static constexpr std::size_t PixelsTogether = std::size_t{ 1 } << 16;

  /** Returns the index of the first of the two planes in a row. G2 is in the columns of R, B in the columns of G1. */
  static std::size_t
  FirstOfRow(std::size_t y, const std::array<std::size_t, 2> & red)
  {
    return y == red[1] ? 0 : 2;
  }

  template <typename TPixel>
  static void
  TakeRow(const TPixel * from, std::size_t width, TPixel * left, TPixel * right)
  {
    for (std::size_t x = 0; x < width; ++x)
    {
      left[x] = from[2 * x];
      right[x] = from[2 * x + 1];
    }
  }

  template <typename TFunction>
  void
  ForPixels(BayerPlane plane, const ParallelFor & parallelFor, TFunction function) const
  {
    const FrameGeometry size = this->Plane();
    const PixelLayout   layout = this->LayoutOf(plane);
    parallelFor(size.height, [&](std::size_t y) {
      for (std::size_t x = 0; x < size.width; ++x)
      {
        function(y * size.width + x, layout.At(x, y));
      }
    });
  }
};

/** \class PlaneFrames
 * \brief Copies the frames of a mosaic plane by plane, a few at a time, for functions that read scattered pixels.
 *
 * Each part of the mosaic is read once for all planes. */
template <typename TPixel>
class PlaneFrames
{
public:
  explicit PlaneFrames(const MosaicGeometry & geometry)
    : m_Geometry(geometry)
  {}

  const MosaicGeometry &
  GetGeometry() const
  {
    return m_Geometry;
  }

  /** Calls function(k, frames, count) for each plane k, in the order of BayerPlanes, with \a count frames of that plane
   * that were copied together. Repeats this until all \a count frames of \a mosaics have been copied. */
  template <typename TFunction>
  void
  ForPlanes(const TPixel * mosaics, std::size_t count, const ParallelFor & parallelFor, TFunction function)
  {
    const std::size_t pixels = m_Geometry.Plane().Pixels();
    const std::size_t most = std::max(FramesTogether, BytesTogether / (pixels * sizeof(TPixel)));
    for (std::size_t first = 0; first < count; first += most)
    {
      const std::size_t       now = std::min(most, count - first);
      const std::size_t       size = BayerPlanes.size() * pixels * now;
      std::array<TPixel *, 4> planes{};
      m_Buffer.resize(std::max(m_Buffer.size(), static_cast<Eigen::Index>(size)));
      for (std::size_t k = 0; k < planes.size(); ++k)
      {
        planes[k] = m_Buffer.data() + k * pixels * now;
      }
      m_Geometry.TakeFrames(mosaics + first * m_Geometry.frame.Pixels(), now, planes, parallelFor);
      for (std::size_t k = 0; k < planes.size(); ++k)
      {
        function(k, planes[k], now);
      }
    }
  }

private:
  /** Bytes of each plane that are copied together. Chosen empirically with the published method, when it still copied
   * its planes: with half as many it took a tenth longer; with twice as many it took as long, and more memory. */
  static constexpr std::size_t BytesTogether = std::size_t{ 8 } << 20;

  MosaicGeometry                          m_Geometry;
  Eigen::Array<TPixel, Eigen::Dynamic, 1> m_Buffer; // unlike std::vector, not filled by one thread
};

/** \class DarkFrameSums
 * \brief Adds up dark frames, which are read once, and measures their offset and read noise.
 *
 * The planes of a Bayer mosaic are measured separately. Frames are added in time order. A frame that equals an earlier
 * one bit by bit is a copy with the same noise, and is not added. The numbers of threads and of frames per call do not
 * change the result. Besides moments and drift it holds a sample of the first frames, 16 MiB or less for integers,
 * twice that for floating point. */
template <typename TPixel>
class DarkFrameSums
{
public:
  /** Starts sums over frames that are no mosaics. \a used is nonzero at the pixels to be used; empty: all are. */
  explicit DarkFrameSums(const FrameGeometry & frame, const std::vector<std::uint8_t> & used = {})
    : m_Pixels(frame.Pixels())
  {
    m_Parts.emplace_back(used, frame);
  }

  /** Starts sums over each plane of a mosaic. \a used is nonzero at the pixels of the frame to be used; empty: all are.
   */
  explicit DarkFrameSums(const MosaicGeometry & mosaic, const std::vector<std::uint8_t> & used = {})
    : m_Pixels(mosaic.frame.Pixels())
    , m_Planes(mosaic)
  {
    for (const BayerPlane plane : BayerPlanes)
    {
      m_Parts.emplace_back(mosaic.Take(used, plane), mosaic.Plane());
    }
  }

  /** Adds the next \a count frames, stored one after the other. */
  void
  AddFrames(const TPixel * frames, std::size_t count, const ParallelFor & parallelFor)
  {
    std::vector<BytesFingerprint> fingerprints(count);
    parallelFor(count, [&](std::size_t k) {
      fingerprints[k] = FingerprintOfBytes(frames + k * m_Pixels, m_Pixels * sizeof(TPixel));
    });
    std::vector<std::uint8_t> isNew(count);
    for (std::size_t k = 0; k < count; ++k)
    {
      isNew[k] = m_Distinct.insert(fingerprints[k]).second ? 1 : 0;
    }
    ForChosenFrames(frames, m_Pixels, isNew, parallelFor, [&](const TPixel * chosen, std::size_t number) {
      this->AddDistinct(chosen, number, parallelFor);
    });
  }

  /** Returns offset and read noise, see MeasureDarkFrames(): one result per plane in the order of BayerPlanes, or one
   * for frames that are no mosaics. Call this function once, because it consumes the sums. */
  std::vector<KnownOffset>
  Measure(const DnSettings & dnSettings, const ParallelFor & parallelFor)
  {
    std::vector<KnownOffset> offsets;
    for (Part & part : m_Parts)
    {
      offsets.push_back(part.Measure(dnSettings, parallelFor));
    }
    return offsets;
  }

private:
  /** Adds frames that are not repeated, to the only part or to the planes. */
  void
  AddDistinct(const TPixel * frames, std::size_t count, const ParallelFor & parallelFor)
  {
    if (!m_Planes)
    {
      m_Parts.front().AddFrames(frames, count, parallelFor);
      return;
    }
    m_Planes->ForPlanes(frames, count, parallelFor, [&](std::size_t k, const TPixel * plane, std::size_t now) {
      m_Parts[k].AddFrames(plane, now, parallelFor);
    });
  }

  /** Sums over the frames, or over one plane of the frames. */
  struct Part
  {
    Part(std::vector<std::uint8_t> usedPixels, const FrameGeometry & frame)
      : used(std::move(usedPixels))
      , pixels(frame.Pixels())
      , moments(pixels)
      , drift(pixels, used)
      , sample(FrameSample::Of<TPixel>(frame, SampledDarkFrames))
    {}

    void
    AddFrames(const TPixel * frames, std::size_t count, const ParallelFor & parallelFor)
    {
      ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
        moments.AddFrames(frames, pixels, count, begin, end);
      });
      moments.AdvanceFrames(count);
      drift.AddFrames(frames, count, parallelFor);
      if (sampled < SampledDarkFrames)
      {
        sample.AddFrames(frames, sampled, count, {}, parallelFor);
        sampled = std::min(sampled + count, SampledDarkFrames);
      }
    }

    KnownOffset
    Measure(const DnSettings & dnSettings, const ParallelFor & parallelFor)
    {
      KnownOffset dark = MeasureDarkFrames<TPixel>(std::move(moments), dnSettings, used, parallelFor, drift);
      if (dark.maps)
      {
        dark.structured = MeasureStructuredNoise(std::move(sample), sampled, *dark.maps, parallelFor);
      }
      return dark;
    }

    std::vector<std::uint8_t> used;
    std::size_t               pixels;
    TemporalMoments<TPixel>   moments;
    DarkDrift                 drift;
    FrameSample               sample; // its frames are the first frames
    std::size_t               sampled{ 0 };
  };

  std::size_t                        m_Pixels; // number of pixels of a frame
  std::set<BytesFingerprint>         m_Distinct;
  std::optional<PlaneFrames<TPixel>> m_Planes; // null: not a mosaic
  std::vector<Part>                  m_Parts;
};

} // namespace sensornoise

#endif
