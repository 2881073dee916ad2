// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EfficiencyStack_h
#define EfficiencyStack_h

#include "sensornoise/SimulationSettings.h"
#include "studies/EfficiencyStatistics.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** A reference image. */
struct Scene
{
  std::size_t         width;
  std::size_t         height;
  std::vector<double> values;
};

/** Simulates a stack, measures it by the method "refined" or "published", and works out how well it could be measured:
 * by the Cramer-Rao bound or by its closed forms, for the pixels that no clipping touches. Experiment and seed are for
 * the record. */
EfficiencyRun
MeasureStack(const Scene &              scene,
             const SimulationSettings & settings,
             const std::string &        methodName,
             bool                       isFullBound);

/** The same of the four planes of a mosaic, of the pattern that the settings have, by the closed forms; experiment says
 * the plane. Vibration is in pixels of the plane. */
std::vector<EfficiencyRun>
MeasureMosaic(const Scene & scene, const SimulationSettings & settings, const std::string & methodName);

} // namespace sensornoise::tools

#endif
