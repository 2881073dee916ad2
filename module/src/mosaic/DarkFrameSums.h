// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_DarkFrameSums_h
#define sensornoise_mosaic_DarkFrameSums_h

#include "moments/DarkFrames.h"
#include "moments/TemporalMoments.h"
#include "mosaic/MosaicGeometry.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class DarkFrameSums
 * \brief Adds up dark frames, which are read once, and measures offset and read noise of them.
 *
 * The planes of a Bayer mosaic are measured separately. Frames are added in time order. The numbers of threads and of
 * frames per call do not change the result. */
template <typename TPixel>
class DarkFrameSums
{
public:
  /** Starts sums over frames that are no mosaics. \a used is nonzero at the pixels to be used; empty: all are. */
  explicit DarkFrameSums(const FrameGeometry & frame, const std::vector<std::uint8_t> & used = {})
  {
    m_Parts.emplace_back(used, frame.Pixels());
  }

  /** Starts sums over each plane of a mosaic. \a used is nonzero at the pixels of the frame to be used; empty: all are.
   */
  explicit DarkFrameSums(const MosaicGeometry & mosaic, const std::vector<std::uint8_t> & used = {})
    : m_Planes(mosaic)
  {
    for (const BayerPlane plane : BayerPlanes)
    {
      m_Parts.emplace_back(mosaic.Take(used, plane), mosaic.Plane().Pixels());
    }
  }

  /** Adds the next \a count frames, stored one after the other. */
  void
  AddFrames(const TPixel * frames, std::size_t count, const ParallelFor & parallelFor)
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

  /** Returns offset and read noise, see MeasureDarkFrames(): one result per plane in the order of BayerPlanes, or one
   * for frames that are no mosaics. Call it once, as it consumes the sums. */
  std::vector<KnownOffset>
  Measure(const CodeSettings & codes, const ParallelFor & parallelFor)
  {
    std::vector<KnownOffset> offsets;
    for (Part & part : m_Parts)
    {
      offsets.push_back(MeasureDarkFrames<TPixel>(std::move(part.moments), codes, part.used, parallelFor, part.drift));
    }
    return offsets;
  }

private:
  /** Sums over the frames, or over one plane of the frames. */
  struct Part
  {
    Part(std::vector<std::uint8_t> usedPixels, std::size_t numberOfPixels)
      : used(std::move(usedPixels))
      , pixels(numberOfPixels)
      , moments(numberOfPixels)
      , drift(numberOfPixels, used)
    {}

    void
    AddFrames(const TPixel * frames, std::size_t count, const ParallelFor & parallelFor)
    {
      ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
        moments.AddFrames(frames, pixels, count, begin, end);
      });
      moments.AdvanceFrames(count);
      drift.AddFrames(frames, count, parallelFor);
    }

    std::vector<std::uint8_t> used;
    std::size_t               pixels;
    TemporalMoments<TPixel>   moments;
    DarkDrift                 drift;
  };

  std::optional<PlaneFrames<TPixel>> m_Planes; // null: not a mosaic
  std::vector<Part>                  m_Parts;
};

} // namespace sensornoise

#endif
