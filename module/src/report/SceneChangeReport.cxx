// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/SceneChangeReport.h"

#include "base/Text.h"
#include "moments/Constants.h"

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
  const Warning warning{ WarningCode::SceneChanges,
                         "the frames do not show one static scene: " +
                           PercentApart(change.share, InMoments.sceneChangeFraction) +
                           " of the differences between areas change from frame to frame (expected less than " +
                           Percent(InMoments.sceneChangeFraction) +
                           "). Check whether another axis was taken for time, the scene or camera moves, a pulsed lamp "
                           "is off in some frames "
                           "(leave them out: --frames), or the bytes of each pixel are swapped (--raw WxH:uint16be)" };
  warnings.insert(warnings.begin(), warning);
}

} // namespace sensornoise
