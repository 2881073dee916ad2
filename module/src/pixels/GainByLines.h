// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_GainByLines_h
#define sensornoise_pixels_GainByLines_h

#include "SensorNoiseExport.h"
#include "pixels/GainByParts.h"
#include "pixels/VarianceLine.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise
{

/** Differences between the gains of single columns, or of single rows, as where each column has an amplifier of its
 * own. Differences over more than half the side of a tile are left to CompareParts(). Estimator.md, 3.15. */
struct SensorNoise_EXPORT GainByLines
{
  double size{ 0.0 }; ///< rms of the gains of the lines, relative to their mean, beyond chance [1]
  double z{ 0.0 };    ///< significance of the size, in its standard deviations by chance [1]
  /** Gain of every line of a period, relative to the mean gain, minus 1 [1]; empty: the lines have no period. */
  std::vector<double> excess;
  double              error{ 0.0 }; ///< sampling error of each excess [1]

  /** Returns whether the gains differ by more than InParts.leastDifference, and beyond chance. */
  bool
  Differ() const;
};

/** Columns and rows of a sensor. */
struct LinesOfSensor
{
  GainByLines columns;
  GainByLines rows;
};

/** Compares the gains of the columns, and of the rows, by the variance of the pixels of \a data. A difference counts as
 * far as both halves of a line have it. */
SensorNoise_EXPORT LinesOfSensor
CompareLines(const VarianceData &  data,
             const FrameGeometry & geometry,
             const PartReference & reference,
             const ParallelFor &   parallelFor);

} // namespace sensornoise

#endif
