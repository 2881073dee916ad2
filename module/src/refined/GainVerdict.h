// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_GainVerdict_h
#define sensornoise_refined_GainVerdict_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "refined/GainEstimate.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Verdict on the slope of the variance: whether it is the gain of a sensor, or the reason why not. */
enum class GainVerdict : std::uint8_t
{
  Identified,
  // The data do not determine the gain.
  TooFewPixels,   ///< too few of the pixels that are not clipped fit a static scene
  FewLitFrames,   ///< flicker and motion take up the shot noise of the few frames that hold the illumination
  LevelsTooAlike, ///< the levels of the scene differ too little
  // The data contradict a sensor of one gain.
  FramesDiffer,        ///< the noise variance of the frames does not follow their levels
  IlluminationIsLeft,  ///< the noise correlation, which changes the gain much, may be due to the illumination
  NotAffine,           ///< the variance deviates from its line
  GainDependsOnOffset, ///< the variance is a curve of the mean, and the gain depends on the assumed read noise
  NotRising,           ///< the variance does not rise with the mean
  LineIllumination,    ///< the illumination differs between rows or columns of one frame
  NoiseNotLinear       ///< medians, compression or repeated frames made the noise
};

/** Returns the verdict on the slope of \a gain by the fit and the pixels: all but LineIllumination and NoiseNotLinear,
 * which do not depend on the fit. */
SensorNoise_EXPORT GainVerdict
TestGain(const RefinedResults & found, const GainEstimate & gain);

/** Returns the status of the sensor's quantities by the verdict. */
SensorNoise_EXPORT EstimateStatus
StatusBy(GainVerdict verdict);

/** Returns the factor by which the noise correlation changes the slope of the variance, 1 or more [1]. */
SensorNoise_EXPORT double
CorrectionByCorrelation(const RefinedResults & found, const GainEstimate & gain);

/** Bounds of the gain by a known offset alone: the line passes the offset with a variance between 0 and the lowest
 * variance of the frames [DN/e-]. Null: the offset is not known, or dark frames with their variance are. */
SensorNoise_EXPORT std::optional<Interval>
GainBounds(const RefinedResults & found, const GainEstimate & gain);

/** Frames that hold most of the illumination. */
struct LitFrames
{
  std::vector<Eigen::Index> frames;               ///< indices of the frames, in rising order
  double                    illumination{ 0.0 };  ///< their fraction of the illumination of all frames [1]
  double                    noiseFraction{ 0.0 }; ///< fraction of the shot noise that flicker and motion leave [1]
};

/** Returns the frames that hold the illumination, if they are few and flicker and motion take up nearly all of their
 * shot noise. Estimator.md, 3.5. */
SensorNoise_EXPORT std::optional<LitFrames>
FindFewLitFrames(const RefinedResults & found);

} // namespace sensornoise

#endif
