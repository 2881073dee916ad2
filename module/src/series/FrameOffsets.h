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

/** Frames whose dark offset differs from the others. */
struct FrameOffsets
{
  std::vector<std::size_t> unlike;        ///< numbers of the frames, from 0
  double                   stepDn{ 0.0 }; ///< median difference of their offset from the others [DN]
};

/** Finds the frames whose dark offset differs from the others: their level deviates by the same amount at all signals.
 *
 * Under another illumination the level of a frame at the centre changes by -gamma m, m the offset minus the centre. A
 * frame of another dark offset deviates from this line. At least half of the frames are about one line, which is
 * fitted for all possible \a offsets minus the centre [DN]. A frame is unlike the others if it is so for all offsets
 * that fit about equally well. \a leastStepDn is the smallest step that is reported [DN]. The result is empty where
 * levels do not differ, or where the level could be due to motion. Estimator.md, 3.3. */
SensorNoise_EXPORT FrameOffsets
FindFrameOffsets(const OffsetLine & line, const ValueRange & offsets, double leastStepDn);

} // namespace sensornoise

#endif
