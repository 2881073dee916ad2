// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/report/SceneChangeReport.h"

#include "sensornoise/base/Text.h"
#include "sensornoise/moments/Constants.h"

#include <algorithm>

namespace sensornoise
{

namespace
{
/** Whether a warning may be there only because the scene changes: what was clipped was so, and codes are what they are.
 */
bool
MayFollow(WarningCode code)
{
  return KindOf(code).severity == Severity::Error || code == WarningCode::NearClipLevel ||
         code == WarningCode::StrongVibration || code == WarningCode::LocalLight || code == WarningCode::NotStatic ||
         code == WarningCode::OffsetLineMisfit || code == WarningCode::OffsetAboveDarkest ||
         code == WarningCode::OffsetNotIdentifiable || code == WarningCode::FlickerNotIdentifiable ||
         code == WarningCode::CorrectedVarianceCurved || code == WarningCode::PoorFit ||
         code == WarningCode::RollingShutter || code == WarningCode::LinesWithoutFlicker;
}
} // namespace

void
ReportSceneChange(Report & report, const SceneChange & change)
{
  if (report.gain.status == EstimateStatus::Identified || !change.IsLarge())
  {
    return;
  }
  auto & warnings = report.warnings;
  warnings.erase(
    std::remove_if(warnings.begin(), warnings.end(), [](const Warning & warning) { return MayFollow(warning.code); }),
    warnings.end());
  const Warning warning{
    WarningCode::SceneChanges,
    "the frames do not show one static scene: of what the areas of a frame differ by, " +
      PercentApart(change.share, InMoments.sceneChangeShare) + " is not as in the others (expected under " +
      Percent(InMoments.sceneChangeShare) +
      "): another axis than time was taken for time, the scene changes, the camera moves by many "
      "pixels, a pulsed lamp is off in some frames, or the bytes of each pixel are in the other order "
      "(--raw)"
  };
  warnings.insert(warnings.begin(), warning);
}

} // namespace sensornoise
