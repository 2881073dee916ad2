// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_InterpolatedPixels_h
#define sensornoise_correlation_InterpolatedPixels_h

#include "SensorNoiseExport.h"
#include "correlation/NoiseResiduals.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Pixels of the sample that are computed from their neighbours: they are no measurements. */
struct SensorNoise_EXPORT InterpolatedPixels
{
  std::vector<std::size_t> pixels; ///< indices in the frame, in the order of the sample
  /** Pixels on the borders of the tiles, which cannot be compared with all neighbours; empty without \a pixels. */
  std::vector<std::size_t> notCompared;
  double                   fraction{ 0.0 }; ///< fraction of the pixels of the sample that they are [1]
  /** Variance that the pixels of the sample lack together, relative to their variance [1]. */
  double lostVariance{ 0.0 };

  /** Sets \a take to 0 at the pixels and at those that are not compared. */
  void
  LeaveOutOf(std::vector<std::uint8_t> & take) const;
};

/** Returns the pixels of \a residuals whose noise is a copy or a mean of the noise of neighbours.
 *
 * Cameras replace defective pixels in this way, and pixels of the autofocus. The noise of such a pixel differs from the
 * mean of its neighbours by rounding alone; a measured pixel differs from it by more than its own noise. Filters reduce
 * this difference, too, but in all pixels. Returns none if more than InCorrelation.mostInterpolated of the pixels are
 * computed: the frames are then enlarged or demosaiced. Estimator.md, 3.5. */
SensorNoise_EXPORT InterpolatedPixels
FindInterpolatedPixels(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
