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

/** Of the reports of the planes R, G1, G2, B, in this order; null unless all four have a motion. The standard
 * deviations are roots of the covariance of R and B's mean with G1 and G2's, which share no noise. Each error is the
 * one that follows, and the smallest of the planes' own, which holds what all have in common. */
SensorNoise_EXPORT std::optional<JointMotion>
JoinMotion(const std::array<Report, 4> & channels);

/** Adds what each plane's vibration differs by from that of all to its error and interval. */
SensorNoise_EXPORT void
WidenVibration(std::array<Report, 4> & channels, const JointMotion & joint);

} // namespace sensornoise

#endif
