// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedScene.h"

#include "base/ParallelWork.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "moments/StackFrames.h"
#include "published/VibrationMask.h"

#include <cmath>

namespace sensornoise
{

namespace
{
PixelUse
UseOf(const PublishedScene &            scene,
      const FrameGeometry &             geometry,
      const std::vector<std::uint8_t> & mask,
      std::size_t                       p)
{
  const std::size_t x = p % geometry.width;
  const std::size_t y = p / geometry.width;
  if (!mask.empty() && mask[p] == 0)
  {
    return PixelUse::Masked;
  }
  if (scene.valid[p] == 0)
  {
    return std::isfinite(scene.variance[p]) ? PixelUse::Clipped : PixelUse::NotFinite;
  }
  if (x == 0 || y == 0 || x + 1 == geometry.width || y + 1 == geometry.height)
  {
    return PixelUse::Border;
  }
  if (scene.kept[p] != 0)
  {
    return PixelUse::Used;
  }
  return scene.variance[p] > 0.0 ? PixelUse::Vibration : PixelUse::Constant;
}
} // namespace

void
SortPixels(PublishedScene &                  scene,
           const PublishedSettings &         settings,
           const FrameGeometry &             geometry,
           std::size_t                       frames,
           const std::vector<std::uint8_t> & mask,
           const ParallelFor &               parallelFor)
{
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    scene.valid[p] = mask[p] != 0 ? scene.valid[p] : 0;
  }
  scene.kept = VibrationMask(scene.mean.data(),
                             scene.variance.data(),
                             scene.valid.data(),
                             geometry.width,
                             geometry.height,
                             frames,
                             settings.level,
                             parallelFor);
  scene.pixelUse.resize(geometry.Pixels());
  ForBlocks(geometry.Pixels(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      scene.pixelUse[p] = static_cast<std::uint8_t>(UseOf(scene, geometry, mask, p));
    }
  });
}

void
FindSets(PublishedScene &          scene,
         const PublishedSettings & settings,
         std::size_t               frames,
         const ParallelFor &       parallelFor)
{
  try
  {
    RequireDistinctFrames(frames, scene.valid);
    const IsoIntensitySetFinder finder(
      scene.mean.data(), scene.variance.data(), scene.kept.data(), scene.mean.size(), frames, parallelFor);
    ForAll(2, parallelFor, [&](std::size_t k) {
      (k == 0 ? scene.bright : scene.dark) = finder.Find(k == 0 ? settings.brightQuantile : settings.darkQuantile);
    });
    if (settings.rollingShutter != RollingShutter::Off)
    {
      scene.rowSet = finder.FindRowSet(scene.bright);
    }
  }
  catch (const NothingToMeasure & reason)
  {
    scene.failureReason = reason;
  }
}

} // namespace sensornoise
