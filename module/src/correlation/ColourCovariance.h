// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_ColourCovariance_h
#define sensornoise_correlation_ColourCovariance_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/FrameSample.h"
#include "correlation/NoiseResiduals.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StepResults.h"

#include <array>
#include <cstddef>
#include <vector>

/** \file
 * Covariance of the noise of a pixel of a mosaic with the noise of its neighbours, which have other colours. */

namespace sensornoise
{

/** Noise of a part of the sampled pixels of a plane, kept until all planes are measured. Memory: 4 MiB, and 8 bytes for
 * each pixel of the sample. */
struct SensorNoise_EXPORT SampledNoise
{
  /** Largest number of values that are kept: they give the sum over eight neighbours to 0.4 %. */
  static constexpr std::size_t MostValues = std::size_t{ 1 } << 20;

  SampleTiles        tiles;
  std::vector<float> values; ///< residuals, in the order of NoiseSample [DN]
  std::vector<float> weight; ///< inverse variance of each pixel [1/DN^2]; 0: left out
  std::vector<float> signal; ///< signal of each pixel [DN above black]
  Eigen::MatrixXd    basis;  ///< orthonormal basis of what was projected out, frames x (1 + series)

  SampledNoise() = default;
  /** Keeps tiles that are spread evenly over the frame. */
  explicit SampledNoise(const NoiseResiduals & residuals);
};

/** Planes of a mosaic, with the column and row, 0 or 1, of the first pixel of each. */
struct SampledPlanes
{
  std::array<const SampledNoise *, 4>       noise;
  std::array<std::array<std::size_t, 2>, 4> corners;
};

/** Covariance of a pixel with its eight nearest neighbours in the mosaic, as a slope against the pixel's own signal. */
struct NeighbourCovariance
{
  MeasuredNumber slope;          ///< sum over the neighbours [DN/e-]
  double         typical{ 0.0 }; ///< median of the slopes of single tiles [DN/e-]
};

/** Measures the covariance for each plane. Where charge or values are spread linearly over the mosaic, with weights of
 * sum 1, the covariances of a pixel with all pixels sum up to the gain times its own signal, and the variance alone has
 * another slope. Noise that is common to rows, columns or frames is no covariance of neighbours: the covariance at
 * three times the distance is subtracted. 0 with infinite errors if the planes have no common tiles. */
SensorNoise_EXPORT std::array<NeighbourCovariance, 4>
MeasureNeighbourCovariance(const SampledPlanes & planes, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
