// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_Constants_h
#define sensornoise_report_Constants_h

#include "sensornoise/base/Constant.h"

namespace sensornoise
{

/** The numbers of the room `report`. */
struct ReportConstants
{
  /** The gains of the two greens differ where their difference is more than so many of its standard errors, and more
   * than this share of the gain [1]. Set by hand: by chance alone one of 370 mosaics has the first, what is smaller
   * than the second matters to nobody. */
  double greensDifferZ{ 3.0 };
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
