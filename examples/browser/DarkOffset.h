// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef DarkOffset_h
#define DarkOffset_h

#include "browser/Burst.h"
#include "browser/BurstChunks.h"
#include "moments/DarkFrames.h"
#include "mosaic/MosaicGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise::browser
{

/** Sums of the dark frames, or of one plane of them. */
template <typename TPixel>
struct DarkPart
{
  explicit DarkPart(std::size_t numberOfPixels)
    : pixels(numberOfPixels)
    , moments(numberOfPixels)
    , drift(numberOfPixels)
  {}

  void
  AddFrames(const TPixel * frames, std::size_t count)
  {
    ForBlocks(pixels, SerialFor, [&](std::size_t begin, std::size_t end) {
      moments.AddFrames(frames, pixels, count, begin, end);
    });
    moments.AdvanceFrames(count);
    drift.AddFrames(frames, count, SerialFor);
  }

  std::size_t             pixels;
  TemporalMoments<TPixel> moments;
  DarkDrift               drift;
};

/** Returns the offset of the frames, or of each plane of a mosaic, from dark frames. */
template <typename TPixel>
std::vector<KnownOffset>
MeasureDark(const Burst &                       dark,
            const std::optional<BayerPattern> & pattern,
            const CodeSettings &                codes,
            const BurstProgress &               progress)
{
  std::vector<DarkPart<TPixel>> parts;
  if (pattern)
  {
    const MosaicGeometry geometry{ dark.geometry, *pattern };
    PlaneFrames<TPixel>  planes(geometry);
    for (std::size_t k = 0; k < BayerPlanes.size(); ++k)
    {
      parts.emplace_back(geometry.Plane().Pixels());
    }
    ForChunks<TPixel>(dark, 0, progress, [&](const TPixel * frames, std::size_t count) {
      planes.ForPlanes(frames, count, SerialFor, [&](std::size_t k, const TPixel * plane, std::size_t now) {
        parts[k].AddFrames(plane, now);
      });
    });
  }
  else
  {
    parts.emplace_back(dark.geometry.Pixels());
    ForChunks<TPixel>(
      dark, 0, progress, [&](const TPixel * frames, std::size_t count) { parts.front().AddFrames(frames, count); });
  }
  std::vector<KnownOffset> offsets;
  offsets.reserve(parts.size());
  for (DarkPart<TPixel> & part : parts)
  {
    offsets.push_back(MeasureDarkFrames<TPixel>(std::move(part.moments), codes, {}, SerialFor, part.drift));
  }
  return offsets;
}

} // namespace sensornoise::browser

#endif
