// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_JointChannels_h
#define sensornoise_report_JointChannels_h

#include "sensornoise/ChannelReports.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"
#include "base/Constants.h"

#include <array>
#include <optional>

/** \file
 * What the channels of a mosaic have in common: their motion, and the numbers by which they are compared. */

namespace sensornoise
{

/** Constants of the component `report`. */
struct ReportConstants
{
  /** Least difference of the gains of the two greens, relative to their mean, that is reported [1]. Chosen by the size
   * of the effect: a difference of 0.5 % has no practical consequence. */
  double leastGreenDifference{ 0.005 };
  /** Least difference of the mean levels of the two planes called green, for which they are not the greens [1]. It is
   * relative to the larger of two differences: between the mean of the greens and the mean of the two other planes, and
   * between the two other planes. It equals InMoments.leastColourDifference. Planes of one colour differ by less than
   * 0.01, the contrast of the scene within a pixel. */
  double leastLevelDifference{ 0.08 };
  /** Difference of the mean levels of the planes called red and blue, relative to the difference of the two planes
   * called green, below which red and blue are of one colour [1]. Chosen empirically. */
  double largestLevelDifference{ 0.1 };
};

SENSORNOISE_CONSTANT ReportConstants InReport;

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
