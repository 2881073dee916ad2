// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_PixelNoise_h
#define sensornoise_refined_PixelNoise_h

#include "SensorNoiseExport.h"
#include "correlation/FrameSample.h"
#include "correlation/NoiseCorrelation.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/StaticVariance.h"
#include "pixels/VarianceLine.h"
#include "refined/FramePhotonTransfer.h"
#include "refined/RefinedResults.h"
#include "scene/StaticScene.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "series/SceneSeries.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Returns the black level [DN]: the given offset, else the offset from the flicker if it is identifiable, else the
 * lower clip level, or 0 if there is none. The latter two are limited to the darkest level. The black level separates
 * signal and offset approximately where the frames do not determine the offset. */
SensorNoise_EXPORT double
BlackLevel(const RefinedSettings &                  settings,
           const StaticScene &                      scene,
           const std::optional<const SceneSeries> & series);

/** Returns the variance of the quantization noise [DN^2]. */
inline double
CodesVariance(const StaticScene & scene)
{
  const double step = scene.summary.codes.quantisationStepDn;
  return step * step / 12.0;
}

/** Returns the mask of the usable pixels that have levels within the range of the settings, and that the dark frames do
 * not show as defective. The reasons for other pixels are written to \a pixelUse. */
SensorNoise_EXPORT std::vector<std::uint8_t>
PixelsOfVariance(const StaticScene & scene, const RefinedSettings & settings, std::vector<std::uint8_t> & pixelUse);

/** Removes pixels from \a chosen whose surroundings have another level, and marks them in \a pixelUse. Where frames
 * were filtered, the variance of these pixels is a mean over other neighbours than their level, and lies on no line.
 * \a line is the variance line of the frames without correction for filters. */
SensorNoise_EXPORT void
LeaveOutEdges(const ReferenceFrame &      frame,
              const VarianceLine &        line,
              std::vector<std::uint8_t> & chosen,
              std::vector<std::uint8_t> & pixelUse);

/** Results of the third pass: the noise of each pixel, and its spatial and temporal correlation. */
struct PixelNoise
{
  StaticVariance   variance;
  NoiseCorrelation correlation;
  FrameNoise       frames; ///< indices among the distinct frames
  LineIllumination lines;
  /** Variance without flicker and motion [DN^2]; 0 at pixels that are not usable; empty: there is no line. */
  std::vector<double> correctedVariance;
};

/** Fits the variance and measures the noise correlation. If the correlation is strong, the mean variance of a tile
 * scatters more, and the pixels are tested a second time for a static scene. The remainder of \a codeNoise is
 * subtracted from the variance of the pixels before it is fitted, and \a codeNoise becomes a member of the result. The
 * noise of the frames is compared only if \a isOneScene. If too few pixels remain for a line, only the variance is set.
 */
SensorNoise_EXPORT PixelNoise
MeasurePixelNoise(ResidualSquares                          squares,
                  FrameSample                              sample,
                  const StaticScene &                      scene,
                  const std::optional<const SceneSeries> & series,
                  const RefinedSettings &                  settings,
                  const CodeNoise &                        codeNoise,
                  bool                                     isOneScene,
                  const ParallelFor &                      parallelFor);

} // namespace sensornoise

#endif
