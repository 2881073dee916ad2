// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/scene/StillScene.h"

#include "sensornoise/base/PixelUse.h"
#include "sensornoise/moments/StackRequirements.h"
#include "sensornoise/scene/CrossedRegion.h"
#include "sensornoise/scene/UsablePixels.h"

#include <algorithm>
#include <utility>

namespace sensornoise
{

namespace
{
/** Leaves out what something crosses; false: nothing does. */
bool
LeaveOutCrossed(StillScene & scene)
{
  const std::vector<std::uint8_t> crossed = FindCrossedRegion(scene.frame, scene.model);
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

StillScene
MakeStillScene(const StackSummary &              summary,
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
  StillScene scene;
  scene.summary = summary;
  scene.changesStrongly = darkestNoiseDn2.has_value();
  scene.frame = MakeReferenceFrame(std::move(mean), std::move(variance), valid, geometry, frames, parallelFor);
  scene.pixelUse = FindPixelUse(scene.frame, valid, userMask, parallelFor);
  // After the reference frame: a masked pixel is a good neighbour.
  for (std::size_t p = 0; p < userMask.size(); ++p)
  {
    valid[p] = userMask[p] == 0 ? 0 : valid[p];
    scene.frame.usable[p] = userMask[p] == 0 ? 0 : scene.frame.usable[p];
  }
  scene.valid = static_cast<std::size_t>(std::count(valid.begin(), valid.end(), std::uint8_t{ 1 }));
  try
  {
    RequireDistinctFrames(frames, valid);
    scene.model = FitProvisionalModel(scene.frame);
    if (LeaveOutCrossed(scene))
    {
      scene.model = FitProvisionalModel(scene.frame);
    }
    UsablePixels found = LeaveOutCoarseAndGuarded(
      scene.frame, scene.model, summary.codes, frameMeans, std::move(scene.pixelUse), parallelFor, darkestNoiseDn2);
    scene.frame.usable = std::move(found.usable);
    scene.pixelUse = std::move(found.pixelUse);
    scene.usable = found.count;
    scene.nearClip = found.nearClip;
    scene.coarse = found.coarse;
    RequireFineCodes(found, summary.codes.quantisationStepDn);
  }
  catch (const NothingToMeasure & obstacle)
  {
    scene.obstacle = obstacle;
  }
  return scene;
}

} // namespace sensornoise
