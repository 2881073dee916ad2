// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_ReferenceFrame_h
#define sensornoise_scene_ReferenceFrame_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** What one pass over the stack tells of the scene: the frame against which all others are compared. */
struct ReferenceFrame
{
  FrameGeometry       geometry;
  std::size_t         frames{ 0 };
  std::vector<double> mean;          ///< over time [DN]; a pixel without one has its neighbours'
  std::vector<double> neighbourMean; ///< mean of the 8 neighbours, without the pixel itself [DN]
  std::vector<double> variance;      ///< over time, unbiased, flicker and motion included; NaN: unknown [DN^2]
  /** 1: the pixel and its 8 neighbours are valid, it varies, and it is StencilMargin pixels from the border. */
  std::vector<std::uint8_t> usable;
};

/** Makes the reference frame of maps of mean and unbiased variance, which it takes over; NaN at pixels without them.
 *
 * Weights are functions of the neighbours' mean, never of the pixel's own: weights that know the pixel's noise bias the
 * variance by a fraction of order 1/T at the darkest pixels (estimator.md, 3.2). */
SensorNoise_EXPORT ReferenceFrame
MakeReferenceFrame(std::vector<double>               mean,
                   std::vector<double>               variance,
                   const std::vector<std::uint8_t> & valid,
                   const FrameGeometry &             geometry,
                   std::size_t                       frames,
                   const ParallelFor &               parallelFor = SerialFor);

/** Gives the memory of the neighbours' means back, which FillNeighbourMean() makes again of the means. */
SensorNoise_EXPORT void
ReleaseNeighbourMean(ReferenceFrame & frame);
SensorNoise_EXPORT void
FillNeighbourMean(ReferenceFrame & frame, const ParallelFor & parallelFor = SerialFor);

/** Makes the means that are not known NaN again, as those of a map that is shown. */
SensorNoise_EXPORT void
UncoverUnknown(ReferenceFrame & frame, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
