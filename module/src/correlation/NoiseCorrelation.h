// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_NoiseCorrelation_h
#define sensornoise_correlation_NoiseCorrelation_h

#include "sensornoise/StepResults.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/LagSums.h"
#include "correlation/NoiseKurtosis.h"
#include "correlation/NoiseResiduals.h"
#include "correlation/EnlargementTrace.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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
  Enlarged,       ///< neighbours, by their place: there are fewer samples than pixels, the gain cannot be told
  BrighterFatter, ///< nearest neighbours, with the square of the light: charge that repels charge
  NotLinear       ///< its distribution is not what a linear filter leaves: the gain cannot be told
};

/** "white", "crosstalk" ... */
SensorNoise_EXPORT const char *
NameOf(NoiseKind kind);

/** The correlation coefficient of the noise of two values [1]. */
struct LagCoefficient
{
  Lag            lag;
  MeasuredNumber coefficient;
};

/** How the covariance of two pixels grows with their level. */
struct CovarianceLine
{
  Lag            lag;
  MeasuredNumber slopeDn;      ///< [DN/e-]
  MeasuredNumber interceptDn2; ///< at the level 0 [DN^2]
};

/** The sum of the squared coefficients over all lags, 0 among them, without what chance makes of it: by how much more a
 * mean variance scatters [1]. \a lags are one half of those other than 0. */
SensorNoise_EXPORT double
SharedSquares(const std::vector<LagCoefficient> & lags);

/** How what neighbours share may depend on the light. */
enum class ShapeOfShared : std::uint8_t
{
  Variance, ///< as the variance but for the codes' noise: a filter after the read-out
  Light,    ///< in proportion to it: coupled charge
  Square,   ///< with its square: charge that repels charge
  Constant, ///< not at all
  FirstPart ///< a filter before a part of the read noise: this and all further shapes, of larger and larger parts
};
/** Parts of the variance without light that may have come after the filter, beside none. */
inline constexpr std::size_t PartsAfterFilter = 16;
inline constexpr std::size_t NumberOfShapes = static_cast<std::size_t>(ShapeOfShared::FirstPart) + PartsAfterFilter;

/** What neighbours share as a function of the light z, summed over all neighbours: coefficient times
 * ofVariance (V - q) + ofLight z + ofSquare z^2 + constantDn2, V being the variance and q that of the codes' steps.
 * What does not depend on the light at all adds nothing to what the sensor had, and has none of the four. */
struct SharedShape
{
  MeasuredNumber coefficient;
  double         probability{ 0.0 }; ///< that it is this shape, of all shapes
  double         ofVariance{ 0.0 };
  double         ofLight{ 0.0 };
  double         ofSquare{ 0.0 };
  double         constantDn2{ 0.0 };
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
  /** Of the lag 0 and of those in space that are summed; empty where neighbours share nothing. */
  std::vector<CovarianceLine> covarianceLines;
  MeasuredNumber              rowsDn2;    ///< variance of the noise of whole rows
  MeasuredNumber              columnsDn2; ///< of whole columns
  /** Excess kurtosis, see KurtosisSums [1]. */
  std::array<MeasuredNumber, KurtosisSums::Kinds> kurtosis;

  std::array<SharedShape, NumberOfShapes> shapes;
  /** The sum of the covariances over all frames over the variance [1]. */
  MeasuredNumber timeFactor{ 1.0, 0.0 };
  /** What the lags beyond the last may add, relative to the variance [1]. */
  double beyondReach{ 0.0 };
  /** Part of the values that repeat that of the frame before beyond chance, where the kind is NotLinear for it [1]. */
  double repeatedShare{ 0.0 };
  /** Whether what neighbours share grows with the square of the signal and reaches further than charge: the
   * illumination changes from place to place. The kind is then NotLinear. */
  bool isOfIllumination{ false };
  /** See FindLocalMotion(), where neighbours share anything. */
  MeasuredNumber localMotion;
  /** Where frames were enlarged. */
  std::optional<EnlargementTrace> enlargement;
  /** Of the lags in space that are summed [pixels]. */
  int reach{ 1 };
  /** The sum of the coefficients over all lags in space within reach, that of lag 0 with it [1]: what the variance has
   * to be multiplied by, whatever its shape along the light. Of all pixels, and of the bins of the light. */
  MeasuredNumber                                        spaceFactor{ 1.0, 0.0 };
  std::array<MeasuredNumber, NoiseResiduals::LightBins> spaceFactorOfBins{};
  /** Variance of the noise of whole rows and columns, where it is seen [DN^2]. */
  MeasuredNumber
  LineNoise() const;

  /** Whether what neighbours share is, in part, of places that move by themselves. */
  bool
  HasLocalMotion() const;

  /** Probability that most of the variance without light came after the filter. */
  double
  ProbabilityOfLateNoise() const;

  const SharedShape &
  Shape(ShapeOfShared shape) const
  {
    return shapes[static_cast<std::size_t>(shape)];
  }
  SharedShape &
  Shape(ShapeOfShared shape)
  {
    return shapes[static_cast<std::size_t>(shape)];
  }

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
