// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_FlickerSeries_h
#define sensornoise_refined_FlickerSeries_h

#include "SensorNoiseExport.h"
#include "refined/OffsetEstimate.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Reason why the standard deviation of the flicker is not identifiable. */
enum class FlickerFailure : std::uint8_t
{
  None,            ///< it is identifiable, or an upper limit
  UnknownOffset,   ///< the change of the illumination has no bounds, as the offset has none
  UncertainOffset, ///< the error of the offset leaves the change of the illumination too uncertain
  NoiseOfFrames    ///< the flicker is not distinguished from the noise of the frames
};

/** Flicker, relative to the signal above an offset. */
struct SeriesOfFlicker
{
  std::vector<double>     gamma; ///< illumination factor of every frame, minus 1 [1]
  Quantity                sd;    ///< its standard deviation over the frames [1]
  FlickerFailure          failure{ FlickerFailure::None };
  double                  scaleError{ 0.0 }; ///< relative error of the change by the error of the offset [1]
  std::optional<Interval> limit;             ///< 95 % interval of the standard deviation, also after a failure [1]
};

/** Estimates the flicker at the dark offset \a offset. \a modelError is the relative error of the flicker by a
 * non-linear response [1]. */
SensorNoise_EXPORT SeriesOfFlicker
EstimateFlicker(const RefinedResults & found, const UsedOffset & offset, double modelError);

} // namespace sensornoise

#endif
