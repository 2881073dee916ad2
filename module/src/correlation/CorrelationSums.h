// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CorrelationSums_h
#define sensornoise_correlation_CorrelationSums_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "base/Jackknife.h"
#include "correlation/LagSums.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"
#include "correlation/ProcessingSigns.h"
#include "sensornoise/Parallel.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** \class CovarianceShapes
 * \brief Predicted dependence of the noise covariance on the signal, for each shape.
 *
 * \a own are the sums of the zero lag. \a leastSignalDn is the least possible signal, 0 where black is known [DN].
 * \a unfilteredDn2 is the variance that no filter has changed, of quantization and line noise [DN^2]. */
class SensorNoise_EXPORT CovarianceShapes
{
public:
  CovarianceShapes(const LagSums & own, double leastSignalDn, double unfilteredDn2);

  /** Returns the covariance that a coefficient of 1 of each shape makes, relative to the variance: bins x shapes. */
  const Eigen::MatrixXd &
  InBins() const
  {
    return m_InBins;
  }
  /** Returns a shape by its index, without coefficient and probability. */
  WeightedShape
  UnitOf(std::size_t shape) const;

private:
  /** Returns the variance that was added after the filter, according to a shape [DN^2]. */
  double
  PartAfterFilter(std::size_t shape) const;

  Eigen::MatrixXd m_InBins;
  double          m_DarkDn2{ 0.0 }; // variance at the least signal [DN^2]
};

/** Fit of one shape to the covariances in the bins. */
struct FittedShape
{
  double coefficient{ 0.0 };
  double chi2{ 0.0 };
};

/** Fits each shape alone to \a shared, the covariances of the bins relative to the variance, with their standard
 * errors. */
SensorNoise_EXPORT std::array<FittedShape, NumberOfShapes>
FitShapes(const Eigen::MatrixXd & shapes, const Eigen::VectorXd & shared, const Eigen::VectorXd & errors);

/** All sums of a tile. The lags are the lags of a CorrelationSums, in the same order. */
struct TileSums
{
  std::vector<LagSums> lags;
  DistantCovariance    shared;
  KurtosisSums         kurtosis;

  SensorNoise_EXPORT TileSums &
  operator+=(const TileSums & other);
};

/** Returns the lags beyond the rings, multiples of \a unit, at which the noise is correlated, and less so at the lags
 * beside: echoes. A part of the \a tiles is looked at, which have the sums at the zero lag. Estimator.md, 3.5. */
SensorNoise_EXPORT std::vector<Lag>
FindEchoes(const NoiseResiduals &        residuals,
           const std::vector<TileSums> & tiles,
           const Lag &                   unit,
           const ParallelFor &           parallelFor);

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
   * see AddTimeLags(). All of them are summed while a tile is in the cache. \a quantisationDn2 is the variance of the
   * quantization noise, which was added after any filter [DN^2]. The references must outlive the object. */
  CorrelationSums(const NoiseResiduals & residuals,
                  double                 quantisationDn2,
                  int                    rings,
                  int                    timeLags,
                  const ParallelFor &    parallelFor);

  /** Adds half of the spatial lags at a distance [pixels]; the opposite lags have the same covariance. */
  void
  AddRing(int distance);
  /** Adds the lags of echoes: single distances along rows or columns, beyond the rings, at which the noise is
   * correlated, as by a reflection in a cable. Estimator.md, 3.5. */
  void
  AddEchoes();
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
  /** Returns the spatial lags at distances up to \a reach, and the echoes beyond [pixels]. */
  Lags
  Within(int reach) const;
  bool
  HasEchoes() const
  {
    return !m_Echoes.empty();
  }
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
  GetQuantisationDn2() const
  {
    return m_QuantisationDn2;
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
  /** Returns the sums over time of the products of frames at the zero lag and at the temporal lags, for
   * AutocovarianceFit, relative to the typical variance [1], of all pixels or of the pixels of intensity bin \a bin. */
  Eigen::VectorXd
  ProductsOfFrames(const TileSums & sums, std::optional<std::size_t> bin = std::nullopt) const;

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
  double                 m_QuantisationDn2;
  const ParallelFor &    m_ParallelFor;
  std::vector<TileSums>  m_Tiles;
  std::vector<Lag>       m_Lags;
  Lags                   m_Echoes;
  Eigen::VectorXd        m_OfUnequalFrames; // covariance over signal, by temporal lag [DN]
};

/** Fits the covariance at the zero lag, and then at each of \a lags, by a line through the four intensity bins: slope
 * times level + intercept. Filtered noise has linear covariances, whichever part of the read noise was filtered. */
SensorNoise_EXPORT std::vector<CovarianceLine>
FitCovarianceLines(const CorrelationSums & sums, const CorrelationSums::Lags & lags);

} // namespace sensornoise

#endif
