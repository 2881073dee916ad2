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

/** The time series of the motion: the coefficients of the derivatives, and their products up to the second order of
 * both axes, which is the basis of a shift whose kernel is separable, whatever the interpolation or the optics.
 * Estimator.md, 3.4. */
SensorNoise_EXPORT Eigen::MatrixXd
MotionColumns(const MotionSeries & motion, const std::vector<double> & gamma);

/** \class TemporalBasis
 * \brief The few series over time that are not sensor noise: flicker, local light and motion, orthonormal, and
 * orthogonal to the constant.
 *
 * They are held as integers of 20 bits, so that their products with integer pixels are summed exactly; the basis is
 * what the rounded series span. The first NumberOfLightFactors() are light. */
class SensorNoise_EXPORT TemporalBasis
{
public:
  static constexpr double Unit = 1048576.0; // 2^20

  TemporalBasis() = default;
  /** At most mostSeriesOfFrames (T - 2) series, and all of the light's: a short burst leaves out the last of the
   * motion's. */
  TemporalBasis(const std::vector<double> & gamma, const Eigen::MatrixXd & local, const Eigen::MatrixXd & motion);

  std::size_t
  Size() const
  {
    return static_cast<std::size_t>(m_Series.cols());
  }
  std::size_t
  NumberOfLightFactors() const
  {
    return m_LightFactors;
  }
  /** The series of light alone. The coordinates on them are those of the whole basis, by its triangular form. */
  TemporalBasis
  OfLight() const;

  /** Orthonormal series, frames x factors. */
  const Eigen::MatrixXd &
  GetBasis() const
  {
    return m_Basis;
  }
  /** The integer series times 2^20 of frame \a t, factor \a j. */
  double
  Rounded(std::size_t t, std::size_t j) const
  {
    return m_Rounded(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(j));
  }
  /** Turns the sums over time of rounded series times pixel value, in place, into the coordinates of the pixels' time
   * series in the basis, for \a pixels pixels: sums[j stride + i] is that of pixel i with series j, means[i] the mean
   * of its values. */
  void
  ToCoordinates(double * sums, std::size_t stride, const double * means, std::size_t pixels) const;

private:
  std::size_t        m_LightFactors{ 0 };
  Eigen::MatrixXd    m_Rounded;
  Eigen::MatrixXd    m_Series;
  Eigen::MatrixXd    m_Basis;
  Eigen::MatrixXd    m_Inverse; // of the lower triangle that turns coordinates into centred sums
  Eigen::RowVectorXd m_Means;
};

} // namespace sensornoise

#endif
