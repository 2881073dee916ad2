// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_StaticPixels_h
#define sensornoise_pixels_StaticPixels_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/ProjectedVariance.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

struct RejectionModel;

/** Result of the test of the roughness classes against a rejection model. */
struct ClassFit
{
  /** First rejected class; all rougher classes are rejected, too. */
  std::size_t         firstBad{ ProjectedVariance::Classes };
  std::vector<double> pixels; ///< number of pixels of each class
  /** Mean of variance over model of each class, without outliers [1]. */
  std::vector<double> ratio;
  /** Reduced chi-square of the ratios of the classes that are kept [1]. */
  double reducedChi2{ 1.0 };
};

/** Compares the mean variance of each roughness class with the flat classes. A class fails if its mean is higher by
 * more than 3 standard errors and 0.15 %, or if its fraction of outliers is higher by 1 %. The first of two failing
 * classes in a row, and all rougher ones, are rejected. Estimator.md, 3.5. */
SensorNoise_EXPORT ClassFit
TestClasses(const ProjectedVariance &         projected,
            const RejectionModel &            line,
            const std::vector<std::uint8_t> & mask,
            const ParallelFor &               parallelFor);

/** Marks the pixels of neighbourhoods that do not fit the rejection model. A neighbourhood is rejected if the mean
 * variance of its 15 x 15 pixels exceeds the model by 5 standard deviations and 4 %, or if it holds 15 % outliers.
 * Single noisy pixels are not marked; the fit trims them. Estimator.md, 3.5. */
SensorNoise_EXPORT std::vector<std::uint8_t>
RejectNeighbourhoods(const ProjectedVariance &         projected,
                     const RejectionModel &            line,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
