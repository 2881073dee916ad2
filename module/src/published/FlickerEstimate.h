// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_FlickerEstimate_h
#define sensornoise_published_FlickerEstimate_h

#include "sensornoise/StepResults.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "published/FlickerSums.h"
#include "published/IsoIntensitySet.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Returns the mean of at least 1 value. */
SensorNoise_EXPORT double
Mean(const std::vector<double> & values);

/** Returns the unbiased variance of at least 2 values. */
SensorNoise_EXPORT double
SampleVariance(const std::vector<double> & values);

/** Computes K, mu and gamma_t from the sums over S^* and S_*, (3.8) to (3.17); with \a mode also gamma_t(y), (3.28).
 *
 * K is the slope of the ordinary regression of v_* on v^* - 1. Both have mean 0 by construction. K and mu always come
 * from the whole frames, as in section 3.5 of the paper. \a sigmaRows is sigma_y [rows] for RollingShutter::Fixed. */
SensorNoise_EXPORT FlickerEstimate
EstimateFlicker(const FlickerSums &     sums,
                const IsoIntensitySet & bright,
                const IsoIntensitySet & dark,
                RollingShutter          mode,
                double                  sigmaRows);

} // namespace sensornoise

#endif
