// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_StaticVariance_h
#define sensornoise_pixels_StaticVariance_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/CodeNoise.h"
#include "pixels/GainByParts.h"
#include "pixels/FixedPatternEstimate.h"
#include "pixels/RejectionModel.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

class ProjectedSquares;

/** Result of the third pass: the pixels that fit a static scene, and the line of their variance. */
struct StaticVariance
{
  /** The variance line, corrected for the noise of the means. Not determined: too few pixels are left, or they have one
   * intensity. */
  VarianceLine line;
  /** Largest fraction of the levels' variance that can be fixed-pattern noise. */
  FixedPatternEstimate pattern;
  /** The line by instrumental variables, see FitInstrumental(); not determined where the pattern is negligible. */
  VarianceLine instrumentalLine;
  /** The line from frames of unequal illumination, and their deviation from it, see FitFramePhotonTransfer(). Not
   * determined where the frames are about equal. */
  VarianceCurve fromFrames;
  /** Result of the test of the roughness classes. */
  ClassFit classes;
  /** Deviation of the variance from instrumentalLine, or from line where instrumentalLine is not determined. */
  VarianceCurve curve;
  /** Deviation from the same line with the pixels sorted by their own levels, by which two amplifiers differ. It has no
   * bins if \a curve follows its line. */
  VarianceCurve ofOwnLevels;
  /** The parts of the frame whose gains differ. The lines then describe the variance divided by the ratios of these
   * parts. */
  GainByParts parts;
  /** Quantization noise of companded data. Its remainder has been subtracted from all of the above; its line has not,
   * see WithoutLineOfCodes(). */
  CodeNoise codeNoise;
  /** 1: a pixel that fits a static scene. Includes outliers, which a fit trims. */
  std::vector<std::uint8_t> mask;
  /** Values of PixelUse. Pixels of the mask that the final fit trims are PixelUse::Outlier. */
  std::vector<std::uint8_t> pixelUse;
  /** Gain by which the variance of the pixels is corrected, see ProjectedVariance [DN/e-]. */
  double correctingGain{ 0.0 };
  /** Number of pixels whose use is PixelUse::NotStatic. */
  std::size_t notStatic{ 0 };
  /** Variance inflation by the spatial noise correlation, see RejectionModel [1]. */
  double varianceInflation{ 1.0 };
  /** Fraction of the sampled pixels that are computed from their neighbours, and left out [1]. */
  double interpolatedFraction{ 0.0 };
  /** Variance that the pixels may lack because some are computed from their neighbours and were not found, relative to
   * the variance [1]. */
  double lostVariance{ 0.0 };
};

/** Finds the pixels that fit a static scene, and fits the line of their variance, from the flat classes to the rough
 * ones. Neighbourhoods are tested before classes, because an object that moves across the frame has pixels in all
 * classes.
 *
 * \a pixelUse is the use of the pixels as known before; the use of the \a usable pixels is set. \a firstGain is
 * the gain by which the variances are corrected before the first line [DN/e-]; 0 where it is not known nearly. \a
 * offsetDn is the dark offset, or the darkest level if the offset is not known [DN];
 * \a blackDn is the dark offset, or a level that it is not below [DN]. \a varianceInflation is the variance inflation
 * by the spatial noise correlation, see RejectionModel [1]. If too few pixels are left, the line is not determined, and
 * the results that depend on it are missing. */
SensorNoise_EXPORT StaticVariance
FitStaticVariance(const ProjectedSquares &          squares,
                  const std::vector<std::uint8_t> & usable,
                  std::vector<std::uint8_t>         pixelUse,
                  double                            firstGain,
                  double                            offsetDn,
                  double                            blackDn,
                  const ParallelFor &               parallelFor,
                  double                            varianceInflation = 1.0);

} // namespace sensornoise

#endif
