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
#include <vector>

namespace sensornoise
{

/** The illumination that the rows of a frame have of their own, or its columns where the frame is turned: of a lamp
 * that pulses under a rolling shutter, of interlaced frames. Estimator.md, 3.18. */
struct LineIllumination
{
  LineAxis axis{ LineAxis::Rows };
  /** Mean square of its relative changes, see FindLineLight() [1]: before anything was taken off, and what is left. */
  MeasuredNumber found;
  MeasuredNumber left;
  /** Whether it was taken off, and the pixels that were measured so: those of the noise sample. */
  bool        isTakenOff{ false };
  std::size_t pixels{ 0 };
  /** Variance that other changes of the illumination still add to that of a pixel, relative to it [1]; 0: none beyond
   * chance. */
  double restOfVariance{ 0.0 };
};

/** What changes of the mean square \a square add to the slope of the variance, relative to the gain \a gain [1]: they
 * add their product with q^2 to the variance of the signal q, of which the brightest is \a signalDn. 0: nothing beyond
 * chance, or less than \a least. */
SensorNoise_EXPORT double
EffectOfLineLight(const MeasuredNumber & square, double signalDn, double gain, double least);

/** Returns what the illumination of places adds to the variance of a pixel, relative to it [1]; 0: nothing beyond
 * chance, or less than counts. */
SensorNoise_EXPORT double
RestOfIllumination(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

/** Takes what the \a lines of its axis share off the \a residuals, whose pixels are those of \a chosen, and puts the
 * variance that is left into \a projected. Pixels outside of the sample leave \a chosen, and are marked in \a pixelUse.
 */
SensorNoise_EXPORT void
TakeOffLineIllumination(LineIllumination &          lines,
                        NoiseResiduals &            residuals,
                        ProjectedVariance &         projected,
                        std::vector<std::uint8_t> & chosen,
                        std::vector<std::uint8_t> & pixelUse,
                        const ParallelFor &         parallelFor);

} // namespace sensornoise

#endif
