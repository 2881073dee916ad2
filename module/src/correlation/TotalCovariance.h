// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_TotalCovariance_h
#define sensornoise_correlation_TotalCovariance_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/CorrelationSums.h"
#include "correlation/FrameTimes.h"
#include "correlation/NoiseCorrelation.h"

#include <array>
#include <cstddef>

/** \file
 * The total covariance of the noise over lags in space and in time, and the fits from which it follows. */

namespace sensornoise
{

/** Returns the matrix M by which the projection mixes the autocovariances R_k of a series. With P = I - Q Q', for
 * orthonormal \a basis Q,
 *
 *     E[sum_t r_t r_(t+d)] = sum_k M_dk R_k,   M_dk = sum_t (P B_k P)_(t, t+d),   d = 0 ... lags, k = 0 ... furthest,
 *
 * where B_0 = I and B_k is the shift by k frames both ways. Rows and columns of times without a frame are left out of
 * B_k, and the sums are over the pairs of frames that are d frames apart in time. Exact for any distribution of the
 * noise. */
SensorNoise_EXPORT Eigen::MatrixXd
TemporalMixing(const Eigen::MatrixXd & basis, std::size_t lags, std::size_t furthest, const FrameTimes & times = {});

/** \class AutocovarianceFit
 * \brief Autocovariances of the noise, from the sums of products of frames after the projection.
 *
 * The autocovariances R_0 ... R_K are free, and solve the system of TemporalMixing(). The autocovariances of larger
 * lags are 0, or they decrease by a constant ratio, as behind a recursive filter (FindTail()). Without them the sum
 * over all lags of a short burst is too small: the projection removes slow noise. Estimator.md, 3.12.
 *
 * The arguments \a sums of the functions are sum_t r_t r_(t+d), d = 0 ... K, in any unit. Their results are linear in
 * the sums, and have the same unit. */
class SensorNoise_EXPORT AutocovarianceFit
{
public:
  /** \param basis orthonormal temporal components that were projected out
   * \param lags number K of lags
   * \param times times of the frames */
  AutocovarianceFit(const Eigen::MatrixXd & basis, std::size_t lags, FrameTimes times = {});

  /** Finds the tail: white noise and R_k = A q^k, with the ratio q for which both describe \a sums best. The tail stays
   * 0 if the misfit of these two terms exceeds InCorrelation.largestTailMisfit times the misfit of white noise alone,
   * as after means over several frames. */
  void
  FindTail(const Eigen::VectorXd & sums);
  bool
  HasTail() const
  {
    return m_Ratio > 0.0;
  }
  /** Returns R_0 ... R_K. */
  Eigen::VectorXd
  Autocovariances(const Eigen::VectorXd & sums) const
  {
    return m_Autocovariances * sums;
  }
  /** Returns R_0 + 2 (R_1 + R_2 + ...), with the tail. */
  double
  Total(const Eigen::VectorXd & sums) const
  {
    return m_Total * sums;
  }

private:
  void
  Solve();

  Eigen::MatrixXd    m_Basis;
  FrameTimes         m_Times;
  Eigen::MatrixXd    m_Mixing; // columns from lag 0 on
  double             m_Ratio{ 0.0 };
  Eigen::MatrixXd    m_Autocovariances; // matrix that turns the sums into autocovariances
  Eigen::RowVectorXd m_Total;
};

/** Returns an estimated value with its standard error. */
inline MeasuredNumber
NumberAt(const JackknifeEstimate & estimate, std::size_t k)
{
  const auto index = static_cast<Eigen::Index>(k);
  return { estimate.value(index), estimate.StandardError(index) };
}

/** Returns the coefficients of all shapes, and then their chi-squares. \a covarianceInBins(tiles) is the covariance in
 * the bins, relative to the variance, with its standard \a errors. \a unfilteredDn2 is the variance of quantization and
 * line noise [DN^2]. */
template <typename TFunction>
JackknifeEstimate
FitAllShapes(const CorrelationSums & sums,
             TFunction               covarianceInBins,
             const Eigen::VectorXd & errors,
             double                  unfilteredDn2)
{
  return Jackknife(sums.GetTiles(), [&](const TileSums & tiles) {
    const CovarianceShapes predicted = sums.ShapesOf(tiles, unfilteredDn2);
    const auto             shapes = FitShapes(predicted.InBins(), covarianceInBins(tiles), errors);
    Eigen::VectorXd        figures(2 * NumberOfShapes);
    for (std::size_t k = 0; k < NumberOfShapes; ++k)
    {
      figures(static_cast<Eigen::Index>(k)) = shapes[k].coefficient;
      figures(static_cast<Eigen::Index>(NumberOfShapes + k)) = shapes[k].chi2;
    }
    return figures;
  });
}

/** Returns the probabilities of the shapes from their chi-squares. \a mayBeCharge: the covariance is weak and short, so
 * that coupled charge may cause it. If black is not known, a line of the level is taken for charge, too. */
std::array<double, NumberOfShapes>
ProbabilitiesOf(const Eigen::VectorXd & chi2, bool mayBeCharge, bool isBlackKnown);

/** Returns the shapes with the coefficients of \a fits and their probabilities. */
std::array<WeightedShape, NumberOfShapes>
WeighShapes(const JackknifeEstimate &                  fits,
            const std::array<double, NumberOfShapes> & probabilities,
            const CovarianceShapes &                   predicted);

/** Returns whether the squared signal describes the covariance better than all other shapes, by
 * InCommon.strongEvidence in chi-square. \a fits is from FitAllShapes(). */
bool
IsProportionalToSquare(const JackknifeEstimate & fits);

/** Returns whether the spatial noise correlation exceeds the reporting threshold: the nearest neighbours together
 * exceed InCorrelation.leastEffect, or one of \a coefficients exceeds InCorrelation.leastCoefficient, both
 * significantly. Covariances that grow with the signal are tested in the brightest bin. */
SensorNoise_EXPORT bool
IsCorrelatedInSpace(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients);

/** Covariance of the nearest neighbours at the bright levels. */
struct BrightCovariance
{
  MeasuredNumber sum; ///< sum over the four neighbours, relative to the variance, with the error of white noise [1]
  double         z{ 0.0 }; ///< weighted surplus of pairs with a positive covariance [standard errors]
};

/** Measures the covariance of the nearest neighbours brighter than the mean, with the information on the slope of the
 * variance as weights: in a dark scene the few bright pixels determine the gain. With white noise, a pair of pixels has
 * a positive covariance in half of the cases, and independently of other pairs. The jackknife of IsCorrelatedInSpace()
 * has a larger error where few tiles have a covariance, such as stars that twinkle. */
SensorNoise_EXPORT BrightCovariance
MeasureBrightCovariance(const CorrelationSums & sums, const ParallelFor & parallelFor);

/** Sums the noise covariance over all spatial lags within reach. The reach grows until the next ring is small or not
 * significant. Fits the dependence on the signal, and sets the noise class unless it is Temporal. */
SensorNoise_EXPORT void
SumOverSpace(CorrelationSums & sums, NoiseCorrelation & found);

/** Returns whether one of the temporal \a coefficients, or the coefficient of neighbouring frames in the brightest bin,
 * significantly exceeds InCorrelation.leastTimeCoefficient. The brightest bin shows image lag best, because image lag
 * is proportional to the signal. */
SensorNoise_EXPORT bool
IsCorrelatedInTime(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients);

/** Returns P = I - Q Q'; \a basis is Q. */
Eigen::MatrixXd
ResidualProjection(const Eigen::MatrixXd & basis);

/** Returns the correlation matrix of \a frames frames at \a times whose coefficients at the temporal lags are \a lags.
 */
SensorNoise_EXPORT Eigen::MatrixXd
CorrelationOfFrames(const std::vector<LagCoefficient> & lags, Eigen::Index frames, const FrameTimes & times = {});

/** Returns the noise variance that the projection P = I - Q Q' leaves in each frame if frames have the correlation
 * matrix R, over the noise variance that it leaves of white noise: the diagonal of P R P over the diagonal of P [1].
 * \a basis is Q. */
SensorNoise_EXPORT Eigen::VectorXd
RemainingOfCorrelated(const Eigen::MatrixXd & basis, const Eigen::MatrixXd & correlation);

/** Sums the noise covariance over temporal lags, until the covariances at the last two lags are small. Continues the
 * sum beyond them where the covariance decreases as behind a recursive filter. Fits the dependence on the signal, and
 * sets the noise class to Temporal. More lags than needed increase the error: after the projection of a short burst,
 * distant lags are hardly distinguishable. */
SensorNoise_EXPORT void
SumOverTime(CorrelationSums & sums, NoiseCorrelation & found);

} // namespace sensornoise

#endif
