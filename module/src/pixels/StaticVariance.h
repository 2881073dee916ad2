// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_StaticVariance_h
#define sensornoise_pixels_StaticVariance_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/CodeNoise.h"
#include "pixels/GainByParts.h"
#include "pixels/LevelPattern.h"
#include "pixels/StaticPixels.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

class ProjectedVariance;

/** What the third pass tells: the pixels that fit a static scene, and the line of their variance. */
struct StaticVariance
{
  /** Corrected for the noise of the means. Not determined: too few pixels are left, or pixels of one intensity only. */
  VarianceLine line;
  /** How much of the levels may be the pixels' own. */
  LevelPattern pattern;
  /** The line by light alone; not determined where no pattern is large enough to matter. */
  VarianceLine fromLight;
  /** The line by frames of unequal illumination, and how they deviate from it, see FitFramePhotonTransfer(); not
   * determined where they are about equal. */
  VarianceCurve fromFrames;
  ClassFit      classes;
  /** About the line, or that of light alone. */
  VarianceCurve curve;
  /** The same of pixels sorted by their own levels, which decide between two amplifiers; without bins where \a curve
   * follows its line. */
  VarianceCurve ofOwnLevels;
  /** The parts of the frame whose gains differ; the lines are then of the variance over the ratios of these parts. */
  GainByParts parts;
  /** What rounding to companded codes adds; where it is not zero, it has been taken off all of the above. */
  CodeNoise codeNoise;
  /** 1: a pixel that fits a static scene; outliers among them, too, which a fit trims by itself. */
  std::vector<std::uint8_t> mask;
  /** Values of PixelUse; the pixels of the mask that the final fit trims are PixelUse::Outlier. */
  std::vector<std::uint8_t> pixelUse;
  /** Pixels whose use is PixelUse::NotStatic. */
  std::size_t notStatic{ 0 };
  /** See JudgingLine [1]. */
  double sharedSquares{ 1.0 };
};

/** Finds the pixels that fit a static scene and the line of their variance, from the flat classes outwards.
 * Neighbourhoods are judged before classes: a thing that moves across the frame lies in all of them.
 *
 * \a pixelUse is what is known of the pixels before; that of the \a usable ones is found out here. \a slopeDn is about
 * the gain, \a offsetDn the offset, or the darkest level where it is not known; \a blackDn is the offset, or a level
 * that it is not below; \a sharedSquares tells how much noise neighbours share, see JudgingLine. If too few pixels are
 * left, the line is not determined, and what would have followed is missing. */
SensorNoise_EXPORT StaticVariance
FitStaticVariance(ProjectedVariance &               projected,
                  const std::vector<std::uint8_t> & usable,
                  std::vector<std::uint8_t>         pixelUse,
                  double                            slopeDn,
                  double                            offsetDn,
                  double                            blackDn,
                  const ParallelFor &               parallelFor,
                  double                            sharedSquares = 1.0);

} // namespace sensornoise

#endif
