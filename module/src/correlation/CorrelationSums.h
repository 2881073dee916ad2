// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CorrelationSums_h
#define sensornoise_correlation_CorrelationSums_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "correlation/BlockPhases.h"
#include "correlation/CommonNoise.h"
#include "correlation/Jackknife.h"
#include "correlation/LagSums.h"
#include "correlation/NoiseKurtosis.h"
#include "correlation/NoiseResiduals.h"
#include "correlation/DistantCovariance.h"
#include "correlation/CovarianceShapes.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** All sums of a tile. The lags are the lags of a CorrelationSums, in the same order. */
struct TileSums
{
  std::vector<LagSums> lags;
  DistantCovariance    shared;
  KurtosisSums         kurtosis;

  SensorNoise_EXPORT TileSums &
  operator+=(const TileSums & other);
};

/** \class CorrelationSums
 * \brief Sums of all tiles at any number of lags, and the quantities that are computed from them.
 *
 * A quantity is a function of the sums over some tiles, so that a jackknife over tiles estimates its error. Lags are
 * indices into GetLag(); index 0 is the zero lag. */
class SensorNoise_EXPORT CorrelationSums
{
public:
  using Lags = std::vector<std::size_t>;

  /** Computes the sums at the lags that are always needed: \a rings in space, see AddRing(), and \a timeLags in time,
   * see AddTimeLags(). All of them are summed while a tile is in the cache. \a codesDn2 is the variance of the
   * quantization noise, which was added after any filter [DN^2]. The references must outlive the object. */
  CorrelationSums(const NoiseResiduals & residuals,
                  double                 codesDn2,
                  int                    rings,
                  int                    timeLags,
                  const ParallelFor &    parallelFor);

  /** Adds half of the spatial lags at a distance [pixels]; the opposite lags have the same covariance. */
  void
  AddRing(int distance);
  /** Adds the temporal lags up to \a last frames, at most a third of the frames. */
  void
  AddTimeLags(int last);

  const Lag &
  GetLag(std::size_t k) const
  {
    return m_Lags[k];
  }
  /** Returns the spatial lags at distances from \a first to \a last [pixels]. */
  Lags
  Ring(int first, int last) const;
  /** Returns the lags of the neighbour to the right and of the neighbour below. */
  Lags
  Nearest() const;
  /** Returns the temporal lags, in increasing order. */
  Lags
  TimeLags() const;

  /** Returns the sums of every tile. */
  const std::vector<TileSums> &
  GetTiles() const
  {
    return m_Tiles;
  }
  /** Returns the sums over all tiles. */
  TileSums
  Total() const;
  /** Returns the covariance of nearest neighbours by their position in a block, for every tile. */
  std::vector<BlockPhases>
  SumPhases() const
  {
    return SumBlockPhases(m_Residuals, m_ParallelFor);
  }
  const NoiseResiduals &
  GetResiduals() const
  {
    return m_Residuals;
  }
  /** Returns the variance of the quantization noise [DN^2]. */
  double
  GetCodesDn2() const
  {
    return m_CodesDn2;
  }

  /** Returns the correlation coefficient of a spatial lag, without the noise that is common to all pixels [1]. */
  double
  CoefficientOf(const TileSums & sums, const CommonNoise & common, std::size_t lag) const;
  /** Returns the covariance of a pixel with its neighbours at the given and the opposite lags, summed and relative to
   * the variance, in each intensity bin [1]. */
  Eigen::VectorXd
  CovarianceInBins(const TileSums & sums, const Lags & lags) const;
  /** Returns the shapes to which the covariances are compared; \a unfilteredDn2 as in CovarianceShapes [DN^2]. */
  CovarianceShapes
  ShapesOf(const TileSums & sums, double unfilteredDn2) const
  {
    return { sums.lags[0], m_Residuals.GetLeastSignal(), unfilteredDn2 };
  }
  /** Returns the standard errors of CovarianceInBins() for all tiles together. */
  Eigen::VectorXd
  StandardErrorsInBins(const Lags & lags) const;
  /** Returns the temporal autocovariances at the zero lag and at the temporal lags, relative to the typical variance
   * [1]. \a mixing is the matrix of TemporalMixing(). */
  Eigen::VectorXd
  Autocovariance(const TileSums & sums, const Eigen::MatrixXd & mixing) const;

private:
  void
  AddLags(const std::vector<Lag> & lags);
  /** Returns the sums of a temporal lag without the covariance that white noise has because its variance differs
   * between frames. */
  PairSums
  WithoutUnequalFrames(PairSums sums, int frames) const;
  /** Returns the temporal lags from the first one that is missing up to \a last. */
  std::vector<Lag>
  NextTimeLags(int last) const;

  const NoiseResiduals & m_Residuals;
  double                 m_CodesDn2;
  const ParallelFor &    m_ParallelFor;
  std::vector<TileSums>  m_Tiles;
  std::vector<Lag>       m_Lags;
  Eigen::VectorXd        m_OfUnequalFrames; // covariance over signal, by temporal lag [DN]
};

} // namespace sensornoise

#endif
