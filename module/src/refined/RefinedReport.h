// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_RefinedReport_h
#define sensornoise_refined_RefinedReport_h

#include "SensorNoiseExport.h"
#include "base/NothingToMeasure.h"
#include "correlation/NoiseCorrelation.h"
#include "refined/RefinedEstimate.h"
#include "refined/RefinedResults.h"
#include "scene/StaticScene.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** Makes the report of the refined method. */
SensorNoise_EXPORT Report
MakeRefinedReport(const RefinedResults & found, const ParallelFor & parallelFor = SerialFor);

/** Makes the report of a stack that cannot be measured: its description and the reason. Every quantity is `failed`.
 * \a pixelUse has the values of PixelUse as far as they were found. */
SensorNoise_EXPORT Report
MakeFailedReport(const RefinedSettings &           settings,
                 const StaticScene &               scene,
                 const std::vector<std::uint8_t> & pixelUse,
                 const NothingToMeasure &          failureReason);

/** Warns of the cause of the verdict on the gain, or, if the gain is identified, of the effects that its interval
 * allows for. The numbers of pixels must be in the report. \a effectOfLines is RefinedEstimate::effectOfLines [1]. */
SensorNoise_EXPORT void
WarnOfGain(Report & report, const RefinedResults & found, const TestedGain & tested, double effectOfLines);

/** Warns that a non-linear response would not be noticed: the darkest areas have the fraction \a darkestFraction of the
 * signal of the brightest areas [1]. */
SensorNoise_EXPORT void
WarnOfNarrowRange(Report & report, const RefinedResults & found, double darkestFraction);

/** Returns the reason why the illumination does not determine the offset, and what to do; "": it does. */
SensorNoise_EXPORT std::string
ReasonOf(const OffsetEstimate & offset, const RefinedResults & found);

/** Warns if the flicker is not identifiable. */
SensorNoise_EXPORT void
WarnOfFlicker(Report & report, const SeriesOfFlicker & flicker);

/** Warns of an offset that is not identifiable, of a given offset or dark frames that contradict the frames, and of a
 * read noise that is only limited. The gain must be identified. */
SensorNoise_EXPORT void
WarnOfOffset(Report & report, const RefinedResults & found, const RefinedEstimate & estimate);

/** Adds a warning that the frames are not raw if the noise is correlated or not linear. The gain and the slope of the
 * variance must be filed before. */
SensorNoise_EXPORT void
WarnOfCorrelation(Report & report, const NoiseCorrelation & correlation);

/** Returns whether the noise of a pixel of a plane is correlated with the noise of its neighbours, which are in the
 * other planes of a mosaic, significantly and by a size that the gain is to contain. */
SensorNoise_EXPORT bool
HasCorrelatedNeighbours(const Report & report, const NeighbourCovariance & covariance);

/** Adds the covariance with the neighbours to the gain of a plane, with a warning. Whether read noise is spread, too,
 * is not known, so that intercept and read noise are not identifiable then. */
SensorNoise_EXPORT void
AddToGain(Report & report, const NeighbourCovariance & covariance);

} // namespace sensornoise

#endif
