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
 * \brief The coordinates S_j of every pixel's time series in the TemporalBasis: how the pixel responds to each series
 * [DN].
 *
 * They take the place of the sums over time, in the same memory. */
class SensorNoise_EXPORT PixelCoordinates
{
public:
  /** Pixels whose coordinates on one series lie side by side. */
  static constexpr std::size_t BlockPixels = ProjectionSums::BlockPixels;

  /** Of no pixels. */
  PixelCoordinates() = default;

  /** Takes \a sums over; \a mean is that of every pixel over time [DN]. */
  explicit PixelCoordinates(ProjectionSums &&           sums,
                            const TemporalBasis &       basis,
                            const std::vector<double> & mean,
                            const ParallelFor &         parallelFor);
  /** Takes over sums that are coordinates already. */
  explicit PixelCoordinates(ProjectionSums && coordinates);

  /** The pixels [first, last) whose coordinates are held. */
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

  /** The coordinate of pixel \a p on series \a j. */
  double
  At(std::size_t p, std::size_t j) const
  {
    return m_Coordinates.At(p, j);
  }
  /** The coordinates on series \a j of the pixels of a block, from its pixel \a first on. */
  const double *
  Of(std::size_t first, std::size_t j) const
  {
    return &m_Coordinates.At(first, j);
  }

private:
  ProjectionSums m_Coordinates; // no longer the sums
};

} // namespace sensornoise

#endif
