// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_JointMotion_h
#define sensornoise_report_JointMotion_h

#include "sensornoise/ChannelReports.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <array>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Returns the joint motion of the planes, whose reports are in the order of BayerPlanes; null: a report has no motion,
 * or motion of another number of frames.
 *
 * Let a be the mean motion of R and B, and b the mean motion of G1 and G2. The variance along an axis is the covariance
 * of a and b, which contains no noise because the noise of a and the noise of b are independent. Each standard error is
 * the root sum of squares of two errors: the error from the noise of a and b, and the smallest standard error among the
 * planes, which contains the errors common to all planes. Estimator.md, 3.3. */
SensorNoise_EXPORT std::optional<JointMotion>
JoinMotion(const std::array<Report, 4> & channels);

/** Adds the deviation of the vibration of each channel from the joint vibration to its standard error, as a root sum of
 * squares, and widens its 95 % interval accordingly. */
SensorNoise_EXPORT void
WidenVibration(std::array<Report, 4> & channels, const JointMotion & joint);

} // namespace sensornoise

#endif
