// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_Interference_h
#define sensornoise_correlation_Interference_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <optional>

namespace sensornoise
{

/** \class TileSpectrum
 * \brief Power spectrum of the noise in a square tile, by two products with a matrix.
 *
 * Frequencies are multiples of 1 / (2 side) cycles per pixel: half the distance at which a tile distinguishes two. */
class SensorNoise_EXPORT TileSpectrum
{
public:
  /** Makes the spectrum for tiles of \a side x \a side pixels. */
  explicit TileSpectrum(std::size_t side);

  /** Returns the number of frequencies along each axis. */
  Eigen::Index
  Size() const
  {
    return m_Transform.rows();
  }
  /** Returns the power of \a values, side x side: the squared modulus of their Fourier transform. The row is the
   * frequency along y and the column the frequency along x, in units of 1 / Size(). */
  Eigen::ArrayXXd
  PowerOf(const Eigen::MatrixXd & values) const;

private:
  Eigen::MatrixXd m_Transform; // cos + sin of frequency times place
};

/** Returns the frequency of the strongest narrow line in a mean power spectrum of \a tiles tiles that TileSpectrum
 * made, between its frequencies by a parabola; null: it has none. White noise has the power 1. */
SensorNoise_EXPORT std::optional<WaveFrequency>
FindLine(const Eigen::ArrayXXd & power, std::size_t tiles);

/** Measures the noise correlation. Where there is one, searches periodic interference, subtracts it from \a residuals,
 * and measures the correlation of what is left. \a codesDn2 is the variance of the quantization noise [DN^2]. */
SensorNoise_EXPORT NoiseCorrelation
MeasureWithoutInterference(NoiseResiduals & residuals, double codesDn2, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
