// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_Constants_h
#define sensornoise_report_Constants_h

#include "base/Constants.h"

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

} // namespace sensornoise

#endif
