// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ResidualSquares_h
#define sensornoise_pixels_ResidualSquares_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

class ProjectionSums;
class TemporalBasis;
template <typename TPixel>
class ProjectedFrames;
struct ReferenceFrame;

/** What is left of every pixel's squared deviations when the series of a basis are taken out of its time series: all
 * that the variance needs of its coordinates S_j, see ProjectedVariance. */
struct ResidualSquares
{
  std::vector<double> rss;  ///< sum of squares about the mean - sum_j S_j^2 [DN^2]
  std::vector<float>  skew; ///< sum_i S_i sum_j K_ij, K_ij = sum_t Q_tj^2 Q_ti [DN]
};

/** Appends the squares of the pixels whose \a sums are held, which follow those that \a squares has already. Their
 * coordinates take the place of the sums if they are to be kept, else the sums are given back one slab after the other.
 */
SensorNoise_EXPORT void
AppendResidualSquares(const ReferenceFrame & frame,
                      const TemporalBasis &  basis,
                      ProjectionSums &       sums,
                      bool                   keepCoordinates,
                      const ParallelFor &    parallelFor,
                      ResidualSquares &      squares);

/** Fills \a squares, which are of all pixels, at those of [begin, end), with the same bits, from \a frames that are all
 * of a stack: no sums are held. \a begin must be a multiple of ProjectionSums::BlockPixels. \a coordinates, of as many
 * of the first series as it has, are filled there, too. Different pixels may be filled at the same time. */
template <typename TPixel>
void
FillResidualSquares(const ReferenceFrame &          frame,
                    const TemporalBasis &           basis,
                    const ProjectedFrames<TPixel> & frames,
                    std::size_t                     begin,
                    std::size_t                     end,
                    ResidualSquares &               squares,
                    ProjectionSums &                coordinates);

} // namespace sensornoise

#endif
