// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_StartingLine_h
#define sensornoise_single_StartingLine_h

#include "SensorNoiseExport.h"
#include "single/ClippedNormal.h"

#include <vector>

namespace sensornoise
{

class BandTile;
struct LevelLimits;

/** Positions of about one level of a sample: the half of them with the least roughness. In units of SingleFrame. */
struct StartingGroup
{
  double level{ 0.0 };
  double variance{ 0.0 }; ///< by the median of the squared diagonal details
};

/** Groups of a sample, made before any line is known. */
struct StartingGroups
{
  std::vector<StartingGroup> groups;     ///< of equal count, from dark to bright; empty: nothing is finite
  double                     low{ 0.0 }; ///< levels between which nearly all positions lie
  double                     high{ 0.0 };
  double                     medianVariance{ 0.0 };
};

SensorNoise_EXPORT StartingGroups
MakeStartingGroups(const std::vector<BandTile> & sample);

/** Returns the line through the groups that are no closer to a clip level than two standard deviations, by least
 * squares relative to the variance; a constant where there are fewer than two. [DN] */
SensorNoise_EXPORT CentredLine
FitStartingLine(const StartingGroups & groups, const LevelLimits & limits, double originDn, double unitDn);

} // namespace sensornoise

#endif
