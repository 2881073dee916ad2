// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_LineIllumination_h
#define sensornoise_refined_LineIllumination_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"
#include "pixels/ProjectedVariance.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** Illumination that is specific to the rows of a frame, or to its columns where the frame is turned: by a pulsed lamp
 * under a rolling shutter, or by interlaced frames. Estimator.md, 3.18. */
struct LineIllumination
{
  LineAxis axis{ LineAxis::Rows }; ///< whether it is specific to rows or to columns
  /** Mean square of its relative changes, see EstimateLineIlluminationChange() [1]: \a found before it is subtracted,
   * \a left after that. */
  MeasuredNumber found;
  MeasuredNumber left;
  /** Whether it was subtracted, and the number of pixels that were measured without it: those of the noise sample. */
  bool        isTakenOff{ false };
  std::size_t pixels{ 0 };
  /** Variance by other changes of the illumination that remains in a pixel's variance, relative to it [1]; 0: none is
   * significant. */
  double remainingVariance{ 0.0 };

  /** Returns the name of such a line in messages. */
  std::string
  NameOfLine() const
  {
    return axis == LineAxis::Rows ? "row" : "column";
  }
};

/** Returns the relative increase of the slope of the variance by illumination changes of the mean square \a square [1].
 * They add \a square times q^2 to the variance at the signal q; \a signalDn is the signal of the brightest pixels
 * [DN], \a gain the gain [DN/e-]. Returns 0 if the increase is not significant, or less than \a least [1]. */
SensorNoise_EXPORT double
EffectOfLineIllumination(const MeasuredNumber & square, double signalDn, double gain, double least);

/** Returns the increase of a pixel's variance by local changes of the illumination, relative to it [1]; 0: not
 * significant, or too small to count. */
SensorNoise_EXPORT double
RestOfIllumination(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

/** Subtracts the noise and illumination of whole \a lines from \a residuals, whose pixels are \a chosen, and replaces
 * the variance in \a projected by the remaining one. Pixels outside of the sample are removed from \a chosen and
 * marked in \a pixelUse. */
SensorNoise_EXPORT void
SubtractLineIllumination(LineIllumination &          lines,
                         NoiseResiduals &            residuals,
                         ProjectedVariance &         projected,
                         std::vector<std::uint8_t> & chosen,
                         std::vector<std::uint8_t> & pixelUse,
                         const ParallelFor &         parallelFor);

} // namespace sensornoise

#endif
