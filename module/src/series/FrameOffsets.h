// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameOffsets_h
#define sensornoise_series_FrameOffsets_h

#include "SensorNoiseExport.h"
#include "base/ValueRange.h"
#include "series/OffsetLine.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Frames whose dark offset is not that of the others. */
struct FrameOffsets
{
  std::vector<std::size_t> unlike;        ///< from 0
  double                   stepDn{ 0.0 }; ///< their median difference from the others [DN]
};

/** Finds the frames that lie beside the line of the others by a level that is the same at all signals.
 *
 * A frame of other illumination changes the level at the centre by -gamma m, m the offset minus the centre; one of
 * another dark offset does not follow that. Half of the frames or more are about one line, which is found for the
 * \a offsets that are possible, minus the centre [DN]; a frame is unlike if it is for all of those that fit about as
 * well. \a leastStepDn is the step that counts. None where levels do not differ, or the level could be motion.
 * Estimator.md, 3.3. */
SensorNoise_EXPORT FrameOffsets
FindFrameOffsets(const OffsetLine & line, const ValueRange & offsets, double leastStepDn);

} // namespace sensornoise

#endif
