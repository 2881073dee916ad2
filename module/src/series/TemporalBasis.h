// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_TemporalBasis_h
#define sensornoise_series_TemporalBasis_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "series/MotionSeries.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Returns the time series of the motion: the coefficients of the derivatives, and their products up to the second
 * order of both axes. They are the basis of a shift with a separable kernel, for any interpolation or optics.
 * Estimator.md, 3.4. */
SensorNoise_EXPORT Eigen::MatrixXd
MotionColumns(const MotionSeries & motion, const std::vector<double> & gamma);

/** \class TemporalBasis
 * \brief The temporal components that are not sensor noise: flicker, local illumination and motion, orthonormal, and
 * orthogonal to the constant.
 *
 * They are held as integers of 20 bits, so that their products with integer pixels are summed exactly; the basis spans
 * the rounded series. The first NumberOfIlluminationFactors() components are illumination. */
class SensorNoise_EXPORT TemporalBasis
{
public:
  static constexpr double Unit = 1048576.0; // 2^20

  TemporalBasis() = default;
  /** Makes a basis of at most mostSeriesOfFrames (T - 2) series, but of all series of the illumination: a short burst
   * leaves out the last series of the motion. */
  TemporalBasis(const std::vector<double> & gamma, const Eigen::MatrixXd & local, const Eigen::MatrixXd & motion);

  std::size_t
  Size() const
  {
    return static_cast<std::size_t>(m_Series.cols());
  }
  std::size_t
  NumberOfIlluminationFactors() const
  {
    return m_IlluminationFactors;
  }
  /** Returns the basis of the illumination alone. The coordinates on its series are the same as in the whole basis,
   * because of its triangular form. */
  TemporalBasis
  OfLight() const;

  /** Orthonormal series, frames x factors. */
  const Eigen::MatrixXd &
  GetBasis() const
  {
    return m_Basis;
  }
  /** Returns the integer series times 2^20, for frame \a t and factor \a j. */
  double
  Rounded(std::size_t t, std::size_t j) const
  {
    return m_Rounded(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(j));
  }
  /** Converts sums over time of rounded series times pixel value, in place, into the coordinates of the time series of
   * \a pixels pixels in the basis. The sum for pixel i and series j is sums[j stride + i]; means[i] is the mean of the
   * values of pixel i. */
  void
  ToCoordinates(double * sums, std::size_t stride, const double * means, std::size_t pixels) const;

private:
  std::size_t        m_IlluminationFactors{ 0 };
  Eigen::MatrixXd    m_Rounded;
  Eigen::MatrixXd    m_Series;
  Eigen::MatrixXd    m_Basis;
  Eigen::MatrixXd    m_Inverse; // inverse of the lower triangle that converts coordinates into centred sums
  Eigen::RowVectorXd m_Means;
};

} // namespace sensornoise

#endif
