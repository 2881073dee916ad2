// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedReport_h
#define sensornoise_published_PublishedReport_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

struct FlickerEstimate;
struct FrameGeometry;
struct PublishedScene;
struct PublishedSettings;

/** What pass 3 of the published method finds: maps of a frame's size. */
struct CorrectedMaps
{
  std::vector<double>       variance; ///< of the corrected stack [DN^2]; empty: the stack cannot be measured
  std::vector<std::uint8_t> pixelUse; ///< values of PixelUse
};

/** All that the published method found out, pass by pass, from which its report is made. */
struct PublishedFindings
{
  const PublishedSettings & settings;
  const FrameGeometry &     geometry;
  std::size_t               frames;
  const PublishedScene &    scene;
  const FlickerEstimate &   flicker;
  const CorrectedMaps &     corrected;
};

/** The report of the published method: values and statuses, no standard errors and no intervals (the paper has none for
 * a stack, and those of ordinary regression would hide its bias). */
SensorNoise_EXPORT Report
MakePublishedReport(const PublishedFindings & found, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
