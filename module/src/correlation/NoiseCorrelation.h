// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_NoiseCorrelation_h
#define sensornoise_correlation_NoiseCorrelation_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/FrameSample.h"
#include "correlation/LagSums.h"
#include "correlation/NoiseResiduals.h"
#include "correlation/ProcessingSigns.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "sensornoise/StepResults.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Classes of spatial and temporal noise correlation. */
enum class NoiseKind : std::uint8_t
{
  NotMeasured,    ///< too few pixels, frames or degrees of freedom
  White,          ///< no correlation, except noise of whole rows and columns
  Crosstalk,      ///< nearest neighbours by a few per cent, in proportion to the signal: charge coupling
  Filtered,       ///< stronger or further: frames were smoothed, resampled or sharpened
  Temporal,       ///< frames were mixed
  Enlarged,       ///< depends on the position: fewer samples than pixels, so that the gain is not identifiable
  BrighterFatter, ///< nearest neighbours, with the squared signal: brighter-fatter effect
  NotLinear       ///< not distributed as after a linear filter, so that the gain is not identifiable
};

/** Returns the name of a noise class in a report: "white", "crosstalk" ... */
SensorNoise_EXPORT const char *
NameOf(NoiseKind kind);

/** Correlation coefficient of the noise at a lag [1]. */
struct LagCoefficient
{
  Lag            lag;
  MeasuredNumber coefficient;
};

/** Covariance of two pixels at a lag as a line of their level. */
struct CovarianceLine
{
  Lag            lag;
  MeasuredNumber slopeDn;      ///< [DN/e-]
  MeasuredNumber interceptDn2; ///< intercept at level 0 [DN^2]
};

/** Returns the variance inflation of a mean of sample variances over an area [1]: the sum of the squared coefficients
 * over all lags, including 0, without their statistical scatter. \a lags are one half of the lags other than 0. */
SensorNoise_EXPORT double
VarianceInflation(const std::vector<LagCoefficient> & lags);

/** Dependence of the spatial noise covariance on the signal. */
enum class CovarianceShape : std::uint8_t
{
  Variance, ///< proportional to the variance without quantization noise: a filter after the read-out
  Signal,   ///< proportional to the signal: charge coupling
  Square,   ///< proportional to the squared signal: brighter-fatter effect
  Constant, ///< constant
  FirstPart ///< a filter before a part of the read noise; the shapes that follow have larger and larger parts
};
/** Number of fractions of the variance at zero signal that may have been added after the filter, besides none. */
inline constexpr std::size_t PartsAfterFilter = 16;
inline constexpr std::size_t NumberOfShapes = static_cast<std::size_t>(CovarianceShape::FirstPart) + PartsAfterFilter;

/** Noise covariance as a function of the signal z, summed over all neighbours, or over all other frames: coefficient
 * times ofVariance (V - q) + ofSignal z + ofSquare z^2 + constantDn2. V is the variance and q the variance of the
 * quantization noise [DN^2]. A constant covariance does not change the variance before the filter; all four factors are
 * 0 for it. */
struct WeightedShape
{
  MeasuredNumber coefficient;        ///< [1]; of CovarianceShape::Signal [DN], of CovarianceShape::Constant [DN^2]
  double         probability{ 0.0 }; ///< probability of this shape among all shapes [1]
  double         ofVariance{ 0.0 };
  double         ofSignal{ 0.0 };
  double         ofSquare{ 0.0 };
  double         constantDn2{ 0.0 };
};

/** \struct NoiseCorrelation
 * \brief Spatial and temporal correlation of the noise, and the factors to the variance before filters.
 *
 * After a linear filter whose weights sum to 1, the total covariance over lags equals the variance before the filter.
 */
struct SensorNoise_EXPORT NoiseCorrelation
{
  NoiseKind                   kind{ NoiseKind::NotMeasured }; ///< noise class
  std::vector<LagCoefficient> space;                          ///< coefficients at one half plane of lags
  std::vector<LagCoefficient> time;                           ///< coefficients at the temporal lags, from 1 frame on
  /** Lines at the zero lag and at the spatial lags that are summed; empty without spatial correlation. */
  std::vector<CovarianceLine> covarianceLines;
  MeasuredNumber              rowsDn2;    ///< noise variance of whole rows [DN^2]
  MeasuredNumber              columnsDn2; ///< noise variance of whole columns [DN^2]
  /** Waves that were subtracted before the correlation was measured. */
  std::vector<PeriodicInterference> interference;
  /** Excess kurtosis of each kind of series, see KurtosisSums [1]. */
  std::array<MeasuredNumber, KurtosisSums::Kinds> kurtosis;
  /** Fraction of the residuals in the upper tail, relative to normal noise, minus 1 [1]: see KurtosisSums; 0 where
   * frames are correlated. */
  MeasuredNumber upperTail;

  /** Possible dependences of the spatial covariance on the signal, by CovarianceShape. */
  std::array<WeightedShape, NumberOfShapes> shapes;
  /** Possible dependences of the temporal covariance on the signal, by CovarianceShape. */
  std::array<WeightedShape, NumberOfShapes> timeShapes;
  /** Sum of the covariances over all temporal lags, relative to the variance, of all pixels [1]. If the class is not
   * Temporal it is 1, and a significant covariance of neighbouring frames is its error. */
  MeasuredNumber timeFactor{ 1.0, 0.0 };
  /** Standard error of timeFactor by the temporal lags that are not summed [1]. */
  double beyondTimeLags{ 0.0 };
  /** Largest total covariance of the lags beyond reach, relative to the variance [1]. */
  double beyondReach{ 0.0 };
  /** Excess kurtosis of the differences between successive frames, beyond that which a linear filter may make of the
   * kurtosis of the values [1]; measured only where frames are correlated. Noise reduction in time makes it that mixes
   * only frames which differ little at a pixel. */
  MeasuredNumber kurtosisOfSteps;
  /** Fraction of values that repeat the value in the frame before, beyond statistical scatter, if this makes the class
   * NotLinear; else 0 [1]. */
  double repeatedFraction{ 0.0 };
  /** Fraction of the lines that are copies of the line before them in single frames, if this makes the class NotLinear;
   * else 0 [1]. */
  double copiedFraction{ 0.0 };
  /** The axis of these lines. */
  LineAxis copiedAxis{ LineAxis::Rows };
  /** Whether the spatial covariance grows with the squared signal and reaches further than coupled charge: the
   * illumination changes from place to place. The class is then NotLinear. */
  bool isByIllumination{ false };
  /** Covariance of the four nearest neighbours at the bright levels, relative to the variance, if it is significant and
   * above InCorrelation.leastBrightCovariance, and other levels have none; else 0 [1]. Details of the scene change. */
  MeasuredNumber brightCovariance;
  /** Whether the temporal covariance grows with the squared signal, as no filter makes it: the sensitivity of pixels
   * drifts, or the illumination changes in fine patterns. The class is then NotLinear. */
  bool isBySensitivity{ false };
  /** See FindLocalMotion(); measured only where the noise is spatially correlated. */
  MeasuredNumber localMotion;
  /** Position-dependent correlation; only for enlarged frames. */
  std::optional<EnlargementTrace> enlargement;
  /** Largest distance of the spatial lags that are summed [pixels]. */
  int reach{ 1 };
  /** Sum of the coefficients over all spatial lags within reach, including the zero lag [1]: the factor from the
   * variance to the total covariance, whatever its shape along the signal. One factor is for all pixels, the others are
   * for the intensity bins. */
  MeasuredNumber                                            spaceFactor{ 1.0, 0.0 };
  std::array<MeasuredNumber, NoiseResiduals::IntensityBins> spaceFactorOfBins{};
  /** Returns the noise variance of whole rows and columns together, where each is significant [DN^2]. */
  MeasuredNumber
  LineNoise() const;
  /** Returns the noise variance of whole rows and columns and of periodic interference together, where each is
   * significant [DN^2]. */
  MeasuredNumber
  SignificantStructuredNoise() const;
  /** Returns the same sum with all parts that are above 0, significant or not, so that its error is complete [DN^2]. */
  MeasuredNumber
  StructuredNoiseWithScatter() const;

  /** Returns whether outliers were removed: much of the upper tail is missing. */
  bool
  LacksTail() const;

  /** Returns whether frames are mixed only where they differ little. */
  bool
  MixesByDifference() const;

  /** Returns whether brightCovariance is above InCorrelation.leastBrightCovariance by more than its error. The class is
   * then NotLinear. */
  bool
  DetailsChange() const;

  /** Returns whether local motion of the scene causes a part of the spatial correlation. */
  bool
  HasLocalMotion() const;

  /** Returns the probability that most of the variance at zero signal was added after the filter. */
  double
  ProbabilityOfLateNoise() const;

  const WeightedShape &
  Shape(CovarianceShape shape) const
  {
    return shapes[static_cast<std::size_t>(shape)];
  }
  WeightedShape &
  Shape(CovarianceShape shape)
  {
    return shapes[static_cast<std::size_t>(shape)];
  }

  /** Returns whether the total covariance over lags has to replace the variance. */
  bool
  IsCorrelated() const
  {
    return kind != NoiseKind::White && kind != NoiseKind::NotMeasured && kind != NoiseKind::NotLinear;
  }
};

/** Measures the noise correlation. \a quantisationDn2 is the variance of the quantization noise, which was added after
 * any filter [DN^2]. */
SensorNoise_EXPORT NoiseCorrelation
MeasureNoiseCorrelation(const NoiseResiduals & residuals, double quantisationDn2, const ParallelFor & parallelFor);

/** If the class is Temporal, measures the correlation again without the first frames, in which a recursive filter has
 * not settled. */
SensorNoise_EXPORT void
MeasureSettledFrames(NoiseCorrelation &  correlation,
                     NoiseResiduals &    residuals,
                     double              quantisationDn2,
                     const ParallelFor & parallelFor);

/** Returns the fraction of the mean noise variance that is caused by local motion of the scene, along both axes
 * together [1].
 *
 * A small displacement d that neighbours have in common causes the covariance d^2 (grad u(p) . grad u(q)) of two
 * pixels. It depends on the slopes of the scene u at both pixels; the covariance that a filter causes does not. The
 * estimate uses pairs of neighbours within the tiles of the sample. Estimator.md, 3.12. */
SensorNoise_EXPORT MeasuredNumber
FindLocalMotion(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

/** Returns the mean square of a relative change of the illumination that is common to the pixels of a line (row or
 * column) in a frame [1]. It is what the temporal components left in the residuals.
 *
 * It is caused by pulsed illumination under a rolling shutter, or by interlaced frames. The covariance of pixels in a
 * line that a change of the illumination causes grows with the squared signal. The noise of whole lines does not depend
 * on the signal, which distinguishes both. Returns 0 with an infinite error where the signals do not differ enough.
 * Estimator.md, 3.18. */
SensorNoise_EXPORT MeasuredNumber
EstimateLineIlluminationChange(const NoiseResiduals & residuals, LineAxis axis, const ParallelFor & parallelFor);

/** Largest number of dark frames in which MeasureStructuredNoise() measures. Chosen empirically: a sample of so many
 * frames has as many tiles as a sample can have. With half the number, the errors are 1.4 times as large; with twice
 * the number, the tiles are half as many. */
inline constexpr std::size_t SampledDarkFrames = 64;

/** Measures the structured noise of dark frames. \a sample has the first \a frames of the frames that \a dark was
 * measured in. The drift of their common level is left out.
 * \return null: there are too few pixels or frames */
SensorNoise_EXPORT std::optional<StructuredNoise>
MeasureStructuredNoise(FrameSample sample, std::size_t frames, const DarkMaps & dark, const ParallelFor & parallelFor);

/** Settings of a measurement of the noise correlation alone. */
struct SensorNoise_EXPORT CorrelationSettings
{
  /** Dark offset [DN]. NaN (default): not known; the signal is measured from the darkest level if that is below 0.3 of
   * the brightest level, else from 0. */
  double offsetDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Quantization step [DN]; 0 (default): no quantization. At least 0 and finite. */
  double quantisationStepDn{ 0.0 };
  /** Temporal components: changes from frame to frame in proportion to a pattern of the scene (flicker, motion), with
   * one value for each frame. Every linear combination of them and of the constant is removed from every pixel. */
  std::vector<std::vector<double>> series;
  /** Whether the means of the frames are temporal components, too, both plain and weighted with the signal. They
   * describe flicker and a drifting offset. */
  bool frameMeans{ true };

  /** Throws std::invalid_argument if a setting is out of range, or if a series does not have \a frames finite values.
   */
  void
  Validate(std::size_t frames) const;
};

/** Measures the noise correlation on \a sample, which is used up. The sample must be from the whole stack. \a mean is
 * the mean of every pixel [DN]. Pixels whose \a take is 0 or whose mean is not finite are left out. The series of
 * \a settings have a value for each frame of the stack. */
SensorNoise_EXPORT CorrelationEstimate
EstimateCorrelation(NoiseSample                       sample,
                    const std::vector<double> &       mean,
                    const std::vector<std::uint8_t> & take,
                    const CorrelationSettings &       settings,
                    const ParallelFor &               parallelFor = SerialFor);

/** Returns the record of the spatial and temporal noise correlation. If it was not measured, only the noise class is
 * filled. */
SensorNoise_EXPORT NoiseCorrelationRecord
RecordOf(const NoiseCorrelation & correlation);

/** \class TileSpectrum
 * \brief Power spectrum of the noise in a square tile, by two products with a matrix.
 *
 * Frequencies are multiples of 1 / (2 side) cycles per pixel: half the distance at which a tile distinguishes two. */
class SensorNoise_EXPORT TileSpectrum
{
public:
  /** Makes the spectrum for tiles of \a side x \a side pixels. */
  explicit TileSpectrum(std::size_t side);

  /** Returns the number of frequencies along each axis. */
  Eigen::Index
  Size() const
  {
    return m_Transform.rows();
  }
  /** Returns the power of \a values, side x side: the squared modulus of their Fourier transform. The row is the
   * frequency along y and the column the frequency along x, in units of 1 / Size(). */
  Eigen::ArrayXXd
  PowerOf(const Eigen::MatrixXd & values) const;

private:
  Eigen::MatrixXd m_Transform; // cos + sin of frequency times place
};

/** Returns the frequency of the strongest narrow line in a mean power spectrum of \a tiles tiles that TileSpectrum
 * made, between its frequencies by a parabola; null: it has none. White noise has the power 1. */
SensorNoise_EXPORT std::optional<WaveFrequency>
FindLine(const Eigen::ArrayXXd & power, std::size_t tiles);

/** Measures the noise correlation. Where there is one, searches periodic interference, subtracts it from \a residuals,
 * and measures the correlation of what is left. \a quantisationDn2 is the variance of the quantization noise [DN^2]. */
SensorNoise_EXPORT NoiseCorrelation
MeasureWithoutInterference(NoiseResiduals & residuals, double quantisationDn2, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
