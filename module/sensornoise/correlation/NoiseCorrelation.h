// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_NoiseCorrelation_h
#define sensornoise_correlation_NoiseCorrelation_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/correlation/LagSums.h"
#include "sensornoise/correlation/NoiseKurtosis.h"
#include "sensornoise/correlation/NoiseResiduals.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** What the noise of neighbours and of frames has in common. */
enum class NoiseKind : std::uint8_t
{
  NotMeasured,    ///< too few pixels or frames
  White,          ///< nothing, but for whole rows and columns
  Crosstalk,      ///< nearest neighbours a few per cent, in proportion to the light: charge that is coupled
  Filtered,       ///< more, or further away: frames were smoothed, resampled or sharpened
  Temporal,       ///< frames were mixed
  BrighterFatter, ///< nearest neighbours, with the square of the light: charge that repels charge
  NotLinear       ///< its distribution is not what a linear filter leaves: the gain cannot be told
};

/** "white", "crosstalk" ... */
SensorNoise_EXPORT const char *
NameOf(NoiseKind kind);

/** A number and its standard error. */
struct MeasuredNumber
{
  double value{ 0.0 };
  double standardError{ 0.0 };

  /** Whether its size is above \a least beyond chance. */
  bool
  Exceeds(double least, double z) const;
};

/** The correlation coefficient of the noise of two values [1]. */
struct LagCoefficient
{
  Lag            lag;
  MeasuredNumber coefficient;
};

/** The sum of the squared coefficients over all lags, 0 among them, without what chance makes of it: by how much more a
 * mean variance scatters [1]. \a lags are one half of those other than 0. */
SensorNoise_EXPORT double
SharedSquares(const std::vector<LagCoefficient> & lags);

/** What neighbours share as a function of the light z: c(z) = coefficient shape(z), summed over all neighbours. */
struct SharedShape
{
  MeasuredNumber coefficient;
  double         probability{ 0.0 }; ///< that it is this shape, of all shapes
};

/** \struct NoiseCorrelation
 * \brief What neighbours and frames share of their noise, and with it the variance that the sensor had before.
 *
 * After a linear filter whose weights sum to 1 the covariances summed over all lags are what the variance was before
 * it. */
struct SensorNoise_EXPORT NoiseCorrelation
{
  NoiseKind                   kind{ NoiseKind::NotMeasured };
  std::vector<LagCoefficient> space; ///< of one half plane of lags
  std::vector<LagCoefficient> time;
  MeasuredNumber              rowsDn2;    ///< variance of the noise of whole rows
  MeasuredNumber              columnsDn2; ///< of whole columns
  MeasuredNumber              rowLight;   ///< see FindRowLight [1]
  /** Excess kurtosis, see KurtosisSums [1]. */
  std::array<MeasuredNumber, KurtosisSums::Kinds> kurtosis;

  SharedShape
    ofVariance;         ///< in proportion to the variance but for the codes' noise: of a filter after the read-out [1]
  SharedShape ofLight;  ///< in proportion to the light: of charge [DN/e-]
  SharedShape ofSquare; ///< with its square: of charge that repels charge [1/e-]
  /** The sum of the covariances over all frames over the variance [1]. */
  MeasuredNumber timeFactor{ 1.0, 0.0 };
  /** What the lags beyond the last may add, relative to the variance [1]. */
  double beyondReach{ 0.0 };
  /** Part of the values that repeat that of the frame before beyond chance, where the kind is NotLinear for it [1]. */
  double repeatedShare{ 0.0 };
  /** Of the lags in space that are summed [pixels]. */
  int reach{ 1 };
  /** The sum of the coefficients over all lags in space within reach, that of lag 0 with it [1]: what the variance has
   * to be multiplied by, whatever its shape along the light. Of all pixels, and of the bins of the light. */
  MeasuredNumber                                        spaceFactor{ 1.0, 0.0 };
  std::array<MeasuredNumber, NoiseResiduals::LightBins> spaceFactorOfBins{};
  /** Variance of the noise of whole rows and columns, where it is seen [DN^2]. */
  MeasuredNumber
  LineNoise() const;

  /** Whether the variance is not that of the sensor. */
  bool
  IsShared() const
  {
    return kind != NoiseKind::White && kind != NoiseKind::NotMeasured && kind != NoiseKind::NotLinear;
  }
};

/** Measures it. \a codesDn2 is the noise of the codes' steps, which no filter has seen. */
SensorNoise_EXPORT NoiseCorrelation
MeasureNoiseCorrelation(const NoiseResiduals & residuals, double codesDn2, const ParallelFor & parallelFor);

/** Where frames were mixed, measures it again without the first frames, in which a recursive filter has not settled. */
SensorNoise_EXPORT void
MeasureSettledFrames(NoiseCorrelation &  correlation,
                     NoiseResiduals &    residuals,
                     double              codesDn2,
                     const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
