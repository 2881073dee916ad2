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

/** Squared deviations of every pixel without the components of a basis: all that ProjectedVariance needs of the
 * coordinates S_j. */
struct ResidualSquares
{
  std::vector<double> rss;  ///< sum of squares about the mean minus sum_j S_j^2 [DN^2]
  std::vector<float>  skew; ///< sum_i S_i sum_j K_ij, K_ij = sum_t Q_tj^2 Q_ti [DN]
};

/** Appends the squares of the pixels whose \a sums are held, which must follow the pixels that \a squares has already.
 * With \a keepCoordinates the coordinates replace the sums, else the sums are released slab by slab. */
SensorNoise_EXPORT void
AppendResidualSquares(const ReferenceFrame & frame,
                      const TemporalBasis &  basis,
                      ProjectionSums &       sums,
                      bool                   keepCoordinates,
                      const ParallelFor &    parallelFor,
                      ResidualSquares &      squares);

/** Fills \a squares, which has a place for every pixel, for the pixels [begin, end). \a frames are all frames of a
 * stack; no sums are held, and the bits are the same. \a begin must be a multiple of ProjectionSums::BlockPixels.
 * \a coordinates is filled too, for as many of the first components as it has. Different pixels may be filled at the
 * same time. */
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
