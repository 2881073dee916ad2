// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_ProductNoise_h
#define sensornoise_series_ProductNoise_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "series/FrameRegressors.h"
#include "series/FrameSums.h"

#include <vector>

namespace sensornoise
{

/** Returns the covariance of the products of one frame with the columns (FrameSums) for each gradient class: the sum of
 * w^2 V X X' over its pixels, with the variances that the pixels have. It holds whether or not the weights are the
 * inverse variances (White 1980, DOI 10.2307/1912934).
 * \param variance variance of every pixel [DN^2]; a pixel with another value than a finite one has the variance of the
 * initial noise model */
SensorNoise_EXPORT std::vector<FrameSums::ClassMatrix>
CovarianceOfProducts(const FrameRegressors &     regressors,
                     const std::vector<double> & variance,
                     const ParallelFor &         parallelFor);

} // namespace sensornoise

#endif
