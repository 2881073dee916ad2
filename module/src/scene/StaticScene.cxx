// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/StaticScene.h"

#include "sensornoise/Report.h"
#include "base/Stencils.h"
#include "moments/StackRequirements.h"
#include "scene/TransientRegion.h"
#include "scene/UsablePixels.h"

#include <algorithm>
#include <utility>

namespace sensornoise
{

namespace
{
/** Marks the pixels of the masked border as not valid, so that they are no neighbours of other pixels. */
void
LeaveOutBorder(std::vector<std::uint8_t> & valid, const MaskedBorder & border, const FrameGeometry & geometry)
{
  for (std::size_t p = 0; p < valid.size() && !border.strips.empty(); ++p)
  {
    valid[p] = border.Holds(p % geometry.width, p / geometry.width, geometry) ? 0 : valid[p];
  }
}

/** Sets the use of the pixels of the masked border, and of the pixels beside it, which have no centred difference. */
void
MarkBorder(StaticScene & scene)
{
  const FrameGeometry & geometry = scene.frame.geometry;
  const auto            widened = [](std::size_t lines) { return lines > 0 ? lines + StencilMargin : 0; };
  MaskedBorder          withMargin = scene.border;
  for (std::size_t * const side : { &withMargin.left, &withMargin.right, &withMargin.top, &withMargin.bottom })
  {
    *side = widened(*side);
  }
  for (std::size_t p = 0; p < scene.pixelUse.size() && !scene.border.strips.empty(); ++p)
  {
    const std::size_t x = p % geometry.width;
    const std::size_t y = p / geometry.width;
    if (withMargin.Holds(x, y, geometry) && scene.pixelUse[p] != static_cast<std::uint8_t>(PixelUse::Masked))
    {
      const bool isMasked = scene.border.Holds(x, y, geometry);
      scene.frame.usable[p] = 0;
      scene.pixelUse[p] = static_cast<std::uint8_t>(isMasked ? PixelUse::MaskedBorder : PixelUse::Border);
    }
  }
}

/** Excludes the region that a moving object crosses. Returns false if there is none. */
bool
ExcludeTransientRegion(StaticScene & scene)
{
  const std::vector<std::uint8_t> crossed = FindTransientRegion(scene.frame, scene.model);
  for (std::size_t p = 0; p < crossed.size(); ++p)
  {
    if (crossed[p] != 0 && scene.frame.usable[p] != 0)
    {
      scene.frame.usable[p] = 0;
      scene.pixelUse[p] = static_cast<std::uint8_t>(PixelUse::NotStatic);
    }
  }
  return !crossed.empty();
}
} // namespace

StaticScene
MakeStaticScene(const StackSummary &              summary,
                std::vector<double>               mean,
                std::vector<double>               variance,
                std::vector<std::uint8_t>         valid,
                const std::vector<std::uint8_t> & userMask,
                const FrameGeometry &             geometry,
                std::size_t                       frames,
                const std::vector<double> &       frameMeans,
                const ParallelFor &               parallelFor,
                const std::optional<double> &     darkestNoiseDn2)
{
  StaticScene scene;
  scene.summary = summary;
  scene.changesStrongly = darkestNoiseDn2.has_value();
  scene.border = FindMaskedBorder(mean, valid, geometry);
  LeaveOutBorder(valid, scene.border, geometry);
  scene.frame = MakeReferenceFrame(std::move(mean), std::move(variance), valid, geometry, frames, parallelFor);
  scene.pixelUse = FindPixelUse(scene.frame, valid, userMask, parallelFor);
  MarkBorder(scene);
  // After the reference frame: a masked pixel may serve as a neighbour.
  for (std::size_t p = 0; p < userMask.size(); ++p)
  {
    valid[p] = userMask[p] == 0 ? 0 : valid[p];
    scene.frame.usable[p] = userMask[p] == 0 ? 0 : scene.frame.usable[p];
  }
  scene.valid = static_cast<std::size_t>(std::count(valid.begin(), valid.end(), std::uint8_t{ 1 }));
  try
  {
    RequireDistinctFrames(frames, valid);
    scene.model = FitInitialNoiseModel(scene.frame);
    if (ExcludeTransientRegion(scene))
    {
      scene.model = FitInitialNoiseModel(scene.frame);
    }
    // Under strong changes of the illumination the range of a pixel is known only roughly: in a flat field all pixels
    // or none are in the guard band.
    const CodeRange codes = scene.changesStrongly ? summary.AttainedCodes() : summary.codes;
    UsablePixels    found = ExcludeCoarseAndGuarded(
      scene.frame, scene.model, codes, frameMeans, std::move(scene.pixelUse), parallelFor, darkestNoiseDn2);
    scene.frame.usable = std::move(found.usable);
    scene.pixelUse = std::move(found.pixelUse);
    scene.usable = found.count;
    scene.nearClip = found.nearClip;
    scene.coarse = found.coarse;
    RequireFineQuantization(found, summary.codes.quantisationStepDn);
  }
  catch (const NothingToMeasure & failureReason)
  {
    scene.failureReason = failureReason;
  }
  return scene;
}

} // namespace sensornoise
