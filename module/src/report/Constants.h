// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_Constants_h
#define sensornoise_report_Constants_h

#include "base/Constants.h"

namespace sensornoise
{

/** The numbers of the room `report`. */
struct ReportConstants
{
  /** Difference of the gains of the two greens, relative to them, from which on it counts [1]. Set by hand: what is
   * smaller matters to nobody. */
  double leastGreenDifference{ 0.005 };
  /** Difference of the mean levels of the two planes called green, relative to that of green to the two others, from
   * which on they are no greens [1]: as InMoments.leastColourDifference; planes of one colour differ by what the scene
   * has within a pixel, less than a hundredth. The two others are alike if they differ by less than this part of it
   * [1]. Chosen empirically. */
  double leastLevelDifference{ 0.08 };
  double largestLevelDifference{ 0.1 };
};

SENSORNOISE_CONSTANT ReportConstants InReport;

} // namespace sensornoise

#endif
