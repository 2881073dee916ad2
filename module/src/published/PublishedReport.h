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

/** Result of pass 3 of the published method. */
struct CorrectedMaps
{
  std::vector<double>       variance; ///< variance of the corrected stack [DN^2]; empty: the stack cannot be measured
  std::vector<std::uint8_t> pixelUse; ///< values of PixelUse
};

/** Results of all passes of the published method, from which its report is made. */
struct PublishedFindings
{
  const PublishedSettings & settings;
  const FrameGeometry &     geometry;
  std::size_t               frames;
  const PublishedScene &    scene;
  const FlickerEstimate &   flicker;
  const CorrectedMaps &     corrected;
};

/** Returns the report of the published method. It has values and statuses, but no standard errors or intervals: the
 * paper gives none for a stack, and the errors of an ordinary regression would hide its bias. */
SensorNoise_EXPORT Report
MakePublishedReport(const PublishedFindings & found, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
