// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_FlickerEstimate_h
#define sensornoise_published_FlickerEstimate_h

#include "SensorNoiseExport.h"
#include "published/FlickerSums.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"
#include "published/PublishedScene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** v^*(y, t) of every frame and row, (3.28), where the row set has pixels. */
struct RowRatios
{
  double                    sigmaRows{ 0.0 }; ///< sigma_y [rows]
  std::vector<double>       ratio;            ///< row by row for each frame [1]; 1 where not known
  std::vector<std::uint8_t> known;            ///< for each row, 1: the row set has pixels within sigma_y
};

/** Chooses sigma_y [rows] by leave-one-row-out cross-validation; 0 means that the flicker is the same in all rows.
 *
 * Section 3.5 of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035) uses 50 rows and leaves the choice to future
 * work. Here v^* of each row is predicted from the other rows with the weights of (3.28), and the sigma_y of the best
 * prediction over all frames is chosen. It must reduce the squared error by more than 1 % compared with v^* of the
 * whole frame. Below this limit, the flicker of single rows adds less than 1 % of the noise to the variance of a pixel.
 * A first test on 16 frames and three widths saves the search for stacks without row flicker. */
SensorNoise_EXPORT double
ChooseSigmaRows(const FlickerSums & sums);

/** Computes v^*(y, t) with the width \a sigmaRows [rows]. A row that is farther than sigma_y from all pixels of the row
 * set is not known, because the kernel would extrapolate. */
SensorNoise_EXPORT RowRatios
SmoothRowRatios(const FlickerSums & sums, double sigmaRows);

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
