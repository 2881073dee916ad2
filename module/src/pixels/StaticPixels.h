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

struct JudgingLine;

/** Which of the 24 classes of roughness the model explains. */
struct ClassFit
{
  std::size_t         firstBad{ ProjectedVariance::Classes }; ///< this class and all rougher ones are left out
  std::vector<double> pixels;                                 ///< of each class
  std::vector<double> ratio;                                  ///< mean of variance over line
  double              reducedChi2{ 1.0 };                     ///< of the ratios of the classes that are kept
};

/** Compares the classes' mean variance with the flat classes'. A class is bad if it deviates upwards by more than 2.5
 * standard errors and 0.15 %, or holds 1 % more outliers; the first class of two bad ones in a row, and all rougher
 * ones, are left out. Estimator.md, 3.5. */
SensorNoise_EXPORT ClassFit
JudgeClasses(const ProjectedVariance &         projected,
             const JudgingLine &               line,
             const std::vector<std::uint8_t> & mask,
             const ParallelFor &               parallelFor);

/** Marks pixels whose neighbourhood does not fit: about a core of 15 x 15 pixels whose mean variance exceeds the line
 * by 5 standard deviations and 4 %, or that hold 15 % outliers. Single noisy pixels are not its business: they are
 * trimmed. Estimator.md, 3.5. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindLocalMisfit(const ProjectedVariance &         projected,
                const JudgingLine &               line,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor);

} // namespace sensornoise

#endif
