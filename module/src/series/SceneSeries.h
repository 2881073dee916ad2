// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_SceneSeries_h
#define sensornoise_series_SceneSeries_h

#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "base/Eigen.h"
#include "series/FrameEquations.h"
#include "series/FrameRegressors.h"
#include "series/FrameSums.h"
#include "series/LocalIllumination.h"
#include "series/OffsetLine.h"

#include <cstddef>
#include <optional>
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
 * They are held as integers of at most 20 bits, so that their products with integer pixels are summed exactly; the
 * basis spans the rounded series. The first NumberOfIlluminationFactors() components are illumination. */
class SensorNoise_EXPORT TemporalBasis
{
public:
  static constexpr double Unit = 1048576.0; ///< largest norm of the integer series: 2^20

  TemporalBasis() = default;
  /** Makes a basis of at most mostSeriesOfFrames (T - 2) series. All series of the illumination are in it; a short
   * burst leaves out the last series of the motion. */
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
  OfIllumination() const;
  /** Returns this basis with integer series of the norm \a unit, a power of 2 of at most Unit. */
  TemporalBasis
  WithUnit(double unit) const;

  /** Orthonormal series, frames x factors. */
  const Eigen::MatrixXd &
  GetBasis() const
  {
    return m_Basis;
  }
  /** Returns the integer series, for frame \a t and factor \a j. */
  double
  Rounded(std::size_t t, std::size_t j) const
  {
    return m_Rounded(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(j));
  }
  /** Returns the sum over time of the integer series of factor \a j. */
  double
  SumOfRounded(std::size_t j) const
  {
    return m_Sums(static_cast<Eigen::Index>(j));
  }
  /** Converts sums over time of rounded series times pixel value, in place, into the coordinates of the time series of
   * \a pixels pixels in the basis. The sum for pixel i and series j is sums[j stride + i]; means[i] is the mean of the
   * values of pixel i. */
  void
  ToCoordinates(double * sums, std::size_t stride, const double * means, std::size_t pixels) const;

private:
  /** Rounds an orthonormal basis to integers of the norm m_Unit. */
  void
  Round(const Eigen::MatrixXd & basis);

  std::size_t        m_IlluminationFactors{ 0 };
  double             m_Unit{ Unit };
  Eigen::MatrixXd    m_Rounded;
  Eigen::MatrixXd    m_Series;
  Eigen::MatrixXd    m_Basis;
  Eigen::MatrixXd    m_Inverse; // inverse of the lower triangle that converts coordinates into centred sums
  Eigen::RowVectorXd m_Sums;    // sums of the integer series over time
  Eigen::RowVectorXd m_Means;
};

/** The result of the second pass: the temporal components of the frames apart from noise. */
struct SceneSeries
{
  OffsetLine        line;          ///< offset and flicker
  MotionSeries      motion;        ///< coefficients of the motion
  LocalIllumination local;         ///< local changes of the illumination
  double            offset{ 0.0 }; ///< offset minus the centre: from the line, or as given, or the darkest level [DN]
  bool isOffsetIdentifiable{ false }; ///< whether the flicker determines the offset, so that it is the offset of
                                      ///< the line
  /** Orthonormal series of the squares of the shifts, if they explain the flicker: then they are no illumination, and
   * are removed from it. Else empty. */
  Eigen::MatrixXd squaresOfShifts;
  TemporalBasis   basis;        ///< temporal basis of the third pass
  FrameOffsets    frameOffsets; ///< frames of another dark offset
};

/** Returns the noise according to the initial noise model, for which w V = 1. */
SensorNoise_EXPORT RegressorNoise
NoiseOfModel(const FrameRegressors & regressors);

/** Returns orthonormal series of the squares of the shifts and of their product, without their means, if they explain
 * \a gamma by Schwarz' criterion; else a matrix without columns.
 *
 * Where a scene is sharper than the derivatives of the mean describe, each frame has less contrast the further it is
 * from the mean shift, which looks like flicker. Illumination does not follow the squares of the shifts. Estimator.md,
 * 3.3. */
SensorNoise_EXPORT Eigen::MatrixXd
SquaresThatExplain(const std::vector<double> & gamma, const MotionSeries & motion);

/** Finds flicker, local illumination and motion from the sums of the second pass, with the noise of the initial noise
 * model. Throws NothingToMeasure if the pixels have one intensity.
 * \param knownOffsetDn offset that is used where the flicker does not determine it; without it the darkest level is
 * used, or \a blackDn if the scene has one level only [DN]
 * \param blackDn approximate lower limit of the offset [DN]
 * \param changesStrongly whether the illumination changes strongly; a scene of one level then has no model for the
 * noise of each frame, and neither local illumination nor motion is searched
 * \param rawNoise covariance of the products by the variances of the first pass (CovarianceOfProducts()), which hold
 * the changes of the scene, too: flicker that is not significant by it does not determine the offset. Empty: no test */
SensorNoise_EXPORT SceneSeries
FindSceneSeries(const FrameSums &                           sums,
                RollingShutter                              rollingShutter,
                const std::optional<double> &               knownOffsetDn = std::nullopt,
                double                                      blackDn = 0.0,
                bool                                        changesStrongly = false,
                const std::vector<FrameSums::ClassMatrix> & rawNoise = {});

} // namespace sensornoise

#endif
