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
#include "correlation/SharedLight.h"
#include "correlation/SharedShapes.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** All sums of a tile; the lags are those of a CorrelationSums. */
struct TileSums
{
  std::vector<LagSums> lags;
  SharedLight          shared;
  KurtosisSums         kurtosis;

  SensorNoise_EXPORT TileSums &
  operator+=(const TileSums & other);
};

/** \class CorrelationSums
 * \brief The sums of all tiles, at as many lags as are asked for, and the figures that are made of them.
 *
 * A figure is a function of the sums of some tiles, so that a jackknife tells its error. Lags are indices into
 * GetLag(); the lag 0 is the first. */
class SensorNoise_EXPORT CorrelationSums
{
public:
  using Lags = std::vector<std::size_t>;

  /** \a codesDn2: noise of the codes' steps, which no filter has seen. The lags that are looked at in any case, \a
   * rings in space and \a timeLags frames, see AddRing() and AddTimeLags(), are summed while a tile is in the cache.
   * The references must outlive the object. */
  CorrelationSums(const NoiseResiduals & residuals,
                  double                 codesDn2,
                  int                    rings,
                  int                    timeLags,
                  const ParallelFor &    parallelFor);

  /** Adds half of the lags in space at a distance: the other half is the same. */
  void
  AddRing(int distance);
  /** Adds the lags in time up to \a last frames, at most a third of the frames. */
  void
  AddTimeLags(int last);

  const Lag &
  GetLag(std::size_t k) const
  {
    return m_Lags[k];
  }
  /** The lags in space at distances from \a first to \a last. */
  Lags
  Ring(int first, int last) const;
  /** The lags of the neighbour to the right and the one below. */
  Lags
  Nearest() const;
  Lags
  TimeLags() const;

  const std::vector<TileSums> &
  GetTiles() const
  {
    return m_Tiles;
  }
  TileSums
  Total() const;
  /** What nearest neighbours share, by their place in a block, of every tile. */
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
  double
  GetCodesDn2() const
  {
    return m_CodesDn2;
  }

  /** Correlation coefficient of a lag in space, without what is common to all pixels [1]. */
  double
  CoefficientOf(const TileSums & sums, const CommonNoise & common, std::size_t lag) const;
  /** What a pixel shares with all neighbours at some lags, and at the opposite ones, over the variance, in the bins of
   * the light [1]. */
  Eigen::VectorXd
  SharedInBins(const TileSums & sums, const Lags & lags) const;
  /** What they are compared with; \a unfilteredDn2 as in ShapesOfShared. */
  ShapesOfShared
  ShapesOf(const TileSums & sums, double unfilteredDn2) const
  {
    return { sums.lags[0], m_Residuals.GetLeastLight(), unfilteredDn2 };
  }
  /** The standard errors of SharedInBins() of all tiles. */
  Eigen::VectorXd
  ErrorsInBins(const Lags & lags) const;
  /** Autocovariances over time over the typical variance, at 0 and the lags in time; \a mixing of TemporalMixing(). */
  Eigen::VectorXd
  Autocovariance(const TileSums & sums, const Eigen::MatrixXd & mixing) const;

private:
  void
  AddLags(const std::vector<Lag> & lags);
  /** The sums of a lag in time, less the covariance that white noise has because frames differ in their noise. */
  PairSums
  WithoutUnequalFrames(PairSums sums, int frames) const;
  /** The lags in time from the first that is not there up to \a last. */
  std::vector<Lag>
  NextTimeLags(int last) const;

  const NoiseResiduals & m_Residuals;
  double                 m_CodesDn2;
  const ParallelFor &    m_ParallelFor;
  std::vector<TileSums>  m_Tiles;
  std::vector<Lag>       m_Lags;
  Eigen::VectorXd        m_OfUnequalFrames; // of lags in time, the covariance over the light [DN]
};

} // namespace sensornoise

#endif
