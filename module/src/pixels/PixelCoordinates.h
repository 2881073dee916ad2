// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_PixelCoordinates_h
#define sensornoise_pixels_PixelCoordinates_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/ProjectionSums.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

class TemporalBasis;

/** \class PixelCoordinates
 * \brief Coordinates S_j of every pixel's time series in the TemporalBasis: the pixel's response to each component
 * [DN].
 *
 * The coordinates replace the sums over time in the same memory. */
class SensorNoise_EXPORT PixelCoordinates
{
public:
  /** Number of pixels whose coordinates of one component are adjacent. */
  static constexpr std::size_t BlockPixels = ProjectionSums::BlockPixels;

  /** Holds no pixels. */
  PixelCoordinates() = default;

  /** Takes \a sums over and converts them to coordinates. \a mean is the map of means over time [DN]. */
  explicit PixelCoordinates(ProjectionSums &&           sums,
                            const TemporalBasis &       basis,
                            const std::vector<double> & mean,
                            const ParallelFor &         parallelFor);
  /** Takes over sums that are coordinates already. */
  explicit PixelCoordinates(ProjectionSums && coordinates);

  /** Returns the first pixel, and the end, of the range whose coordinates are held. */
  std::size_t
  FirstPixel() const
  {
    return m_Coordinates.FirstPixel();
  }
  std::size_t
  LastPixel() const
  {
    return m_Coordinates.LastPixel();
  }

  /** Returns the coordinate of pixel \a p in component \a j [DN]. */
  double
  At(std::size_t p, std::size_t j) const
  {
    return m_Coordinates.At(p, j);
  }
  /** Returns the coordinates in component \a j of the pixels of a block, from its pixel \a first on [DN]. */
  const double *
  Of(std::size_t first, std::size_t j) const
  {
    return &m_Coordinates.At(first, j);
  }

private:
  ProjectionSums m_Coordinates; // converted in place
};

} // namespace sensornoise

#endif
