// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_EvaluationSteps_h
#define sensornoise_emva1288_EvaluationSteps_h

#include "SensorNoiseExport.h"
#include "base/Constants.h"
#include "moments/Exposures.h"
#include "report/Quantities.h"
#include "sensornoise/Emva1288.h"
#include "sensornoise/Parallel.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

/** \file
 * Lines through the values of several exposures, the levels of the dark frames, the photon transfer curve, and the
 * steps of EvaluateEmva1288(). Each step sets a part of the report. In front of them, the parts of the statistics of
 * the frames of one exposure, EmvaSeries: spatial variances and highpass filter. */

namespace sensornoise
{

/** Numbers of EMVA Standard 1288, Release 4.0 Linear. */
struct EmvaConstants
{
  /** Highest signal of the fits of gain and responsivity, relative to the signal at saturation [1]. Section 6.6. */
  double gainRange{ 0.70 };
  /** Lowest and highest signal of the linearity, relative to the signal at saturation [1]. Section 6.7. */
  double linearityLow{ 0.05 };
  double linearityHigh{ 0.95 };
  /** Variance of a uniform distribution of the width of one quantization step [step^2]: exact. */
  double quantizationVariance{ 1.0 / 12.0 };
  /** Dark variance below which quantization hides the dark noise [step^2]. Below (53). */
  double leastDarkVariance{ 0.24 };
  /** Upper limit of the dark noise in this case [step]. (54). */
  double darkNoiseLimit{ 0.40 };
  /** Least fraction of saturated values at saturation [1]. Section 6.5. */
  double leastSaturatedFraction{ 0.001 };
  /** Fewest different exposures of dark frames of a dark current. The standard asks for 6 (section 7.1); a line through
   * fewer than 3 has no error. */
  std::size_t fewestDarkExposures{ 3 };
  std::size_t darkExposuresOfStandard{ 6 };
  /** Fewest exposures in the range of a fit: a line through two has no error. */
  std::size_t fewestPoints{ 3 };
  /** Flat exposures of the standard. Section 6.5. */
  std::size_t exposuresOfStandard{ 50 };
  /** Frames of a series for the non-uniformity. Section 8. */
  std::size_t framesOfStandard{ 100 };
  /** Largest bit depth, as of the other methods. */
  unsigned int largestBitDepth{ 16 };
  /** Number of rounds of the weighted line, whose weights follow from its own values. Chosen empirically: the third
   * changes the slope by less than 1e-4 of its error. */
  int roundsOfWeights{ 4 };
};

SENSORNOISE_CONSTANT EmvaConstants InEmva;

/** A value of one exposure, with the variance of its error. */
struct LevelValue
{
  double x{ 0.0 };
  double y{ 0.0 };
  double variance{ 0.0 }; ///< variance of the error of y; 0: not known
};

/** Line y = intercept + slope x. */
struct LevelLine
{
  double slope{ 0.0 };
  double intercept{ 0.0 };
  double slopeStandardError{ 0.0 };
  double interceptStandardError{ 0.0 };
  double reducedChi2{ 0.0 }; ///< sum of the weighted squared residuals over its expectation [1]; 1: without variances
  double dof{ 0.0 };         ///< degrees of freedom of the residuals
};

/** Fits a line with equal weights. If the variances are known, the errors follow from the variances, times the root of
 * the reduced chi-square if it is above 1. Otherwise the errors follow from the scatter about the line. At least three
 * values are needed, at two or more different x. */
SensorNoise_EXPORT LevelLine
FitLevelLine(const std::vector<LevelValue> & values);

/** Fits a line with weights 1 / variance. The errors grow by the root of the reduced chi-square where it is above 1.
 * The values are three or more, not all at one x, with variances above 0. */
SensorNoise_EXPORT LevelLine
FitWeightedLine(const std::vector<LevelValue> & values);

/** Fits a line through the origin with equal weights. Its error follows from the scatter about the line. The values are
 * two or more, and not all at 0. */
SensorNoise_EXPORT LevelLine
FitLineThroughOrigin(const std::vector<LevelValue> & values);

/** Fits a line whose relative deviations are least: with weights 1 / y^2. Has no errors. All y are above 0. */
SensorNoise_EXPORT LevelLine
FitRelativeLine(const std::vector<LevelValue> & values);

/** Returns the variance of the error of the temporal variance of a series [DN^4]. The variance of pixels * (frames - 1)
 * normal numbers has the relative variance 2 / (pixels * (frames - 1)). */
double
ErrorVarianceOf(const EmvaSeries & series);

/** \class DarkLevels
 * \brief Mean level and temporal variance of the dark frames as a function of the exposure. If an exposure has a pair
 * of frames and a longer series, the pair counts. */
class DarkLevels
{
public:
  /** \a series are all series. Throws std::invalid_argument if none of them is dark. */
  explicit DarkLevels(const std::vector<EmvaSeries> & series);

  /** Level of the dark frames at one exposure. */
  struct Level
  {
    double meanDn{ 0.0 };
    double varianceDn2{ 0.0 };
    double varianceError{ 0.0 }; ///< variance of the error of varianceDn2 [DN^4]
    bool   isMeasured{ true };   ///< false: no dark frames have this exposure
  };

  /** Returns the level at an exposure: the level of its dark frames, else the level interpolated between the two
   * nearest exposures. Outside of all exposures the level of the nearest exposure holds. */
  Level
  At(double exposure) const;

  /** Returns the dark series, one of each exposure, in rising order of the exposures. */
  const std::vector<EmvaSeries> &
  Series() const
  {
    return m_Series;
  }

  /** Returns whether a dark current can be measured: three or more exposures. */
  bool
  HasLine() const;

  /** Returns the line of the mean level against the exposure [DN], with errors from the scatter about it. HasLine() is
   * true. */
  LevelLine
  MeanLine() const;
  /** Returns the line of the temporal variance against the exposure [DN^2]. HasLine() is true. */
  LevelLine
  VarianceLine() const;

  /** Returns the dark variance of the sensor [DN^2]: at the exposure 0 of VarianceLine(), or of the lowest exposure if
   * there is no such line. */
  FittedNumber
  DarkVariance() const;

private:
  std::vector<EmvaSeries> m_Series;
};

/** Photon transfer curve: the flat series in the order of their exposures, and saturation. */
struct TransferCurve
{
  std::vector<EmvaSeries> series;               ///< series of each point
  std::vector<EmvaSeries> longer;               ///< further flat series, for the weighted gain and the non-uniformity
  std::vector<EmvaPoint>  points;               ///< points with their gain fit range
  std::size_t             saturation{ 0 };      ///< number of the point with the largest variance
  bool                    hasPhotons{ false };  ///< whether all points have photons
  bool                    isSaturated{ false }; ///< false: no frames reach the end of the range of digital numbers

  double
  SaturationSignalDn() const
  {
    return points[saturation].signalDn;
  }
  /** Returns photons, or the exposure where photons are not known: the abscissa of the response. */
  double
  AbscissaOf(const EmvaPoint & point) const
  {
    return hasPhotons ? *point.photons : point.exposure;
  }
};

/** Returns the end of the range of digital numbers [DN]: 2^bitDepth - 1 quantization steps of at least 1 DN. */
double
EndOfRangeDn(const EmvaSettings & settings);

/** Makes the curve. If an exposure has a pair of frames and a longer series, the pair counts. If most of the flat
 * series are pairs, longer series are no points of the curve. Throws std::invalid_argument if fewer than three
 * exposures differ, if the frames have no temporal noise, or if the flat fields are darker than the dark frames. */
TransferCurve
MakeTransferCurve(const std::vector<EmvaSeries> & series, const DarkLevels & dark, const EmvaSettings & settings);

/** Returns the value of \a function of the numbers with its standard error, as a quantity above 0. The errors of the
 * numbers are independent. Each contributes half of the difference of the function between one standard error above and
 * below the number. */
template <typename TFunction, std::size_t VNumbers>
Quantity
Propagate(TFunction function, const std::array<FittedNumber, VNumbers> & numbers)
{
  std::array<double, VNumbers> values{};
  for (std::size_t k = 0; k < VNumbers; ++k)
  {
    values[k] = numbers[k].value;
  }
  double variance = 0.0;
  for (std::size_t k = 0; k < VNumbers; ++k)
  {
    std::array<double, VNumbers> up = values;
    std::array<double, VNumbers> down = values;
    up[k] += numbers[k].standardError;
    down[k] -= numbers[k].standardError;
    const double change = 0.5 * (function(up) - function(down));
    variance += change * change;
  }
  return Filed(WithError(function(values), std::sqrt(variance)), QuantityDomain::Positive);
}

/** Returns value and standard error of an identified quantity; the error is 0 if it is not known. */
inline FittedNumber
NumberOf(const Quantity & quantity)
{
  return { quantity.value.value_or(0.0), quantity.standardError.value_or(0.0) };
}

/** Sets the system gain K: the slope of the variance against the signal, both minus the dark frames, by a line
 * with an offset and equal weights (50). The range is 0 to 70 % of saturation. Also sets the slope of the line without
 * an offset. Leaves both unset if fewer than three points are in the range. */
void
MeasureGain(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report);

/** Sets the weighted estimate of the system gain: the slope of a line through variances against means. The line goes
 * through all flat series in this range, also series of more than two frames, and through all dark series.
 *
 * Each variance has the weight 1 / (2 V^2 / (pixels (frames - 1))), with V the value of the line. The electrons of the
 * dark current are on the same line. */
void
MeasureWeightedGain(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report);

/** Sets the responsivity (49), a line through the origin in the same range, and the quantum efficiency (52). Leaves
 * both unset if the photons are not known. */
void
MeasureResponsivity(const TransferCurve & curve, EmvaReport & report);

/** Sets dark signal, dark noise (53), (54) and dark current (section 7.1). The dark noise and the dark current in
 * electrons need report.gain. */
void
MeasureDark(const DarkLevels & dark, EmvaReport & report);

/** Sets saturation capacity, sensitivity threshold (26), dynamic range (28) and largest signal-to-noise ratio (55).
 * They need report.gain. In photons they need report.quantumEfficiency. Where no frames are saturated, the
 * saturation has a lower bound and no value. */
void
MeasureRange(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report);

/** Sets the signal-to-noise ratios of the linear model of all points, (21) and (69). */
void
ModelSnr(const DarkLevels & dark, EmvaReport & report);

/** Sets DSNU1288 (66) and PRNU1288 (67) with their parts of columns, rows and pixels, after the highpass filter and
 * without it, and the series that they are measured from.
 *
 * The bright series has the most frames of all flat series. Among flat series of equal length, its signal is the
 * nearest to half of \a saturationSignalDn [DN]. The dark series has the most frames of all dark series. Among dark
 * series of equal length, its exposure is the nearest to the exposure of the bright series. All are from report.series.
 * A variance that is not distinguished from 0 gives an upper limit. The standard errors are valid for white patterns.
 * DSNU needs report.gain. */
void
MeasureNonUniformity(const DarkLevels & dark, double saturationSignalDn, EmvaReport & report);

/** Measures the linearity of section 6.7: line, deviations, and linearity error.
 *
 * The line through the signals from 5 to 95 % of saturation has the least relative deviations (58) to (61). The
 * deviations are relative to the line (62), and the linearity error is the mean of their absolute values (63). Its
 * standard error follows from the scatter of frames of equal exposure. The corrected linearity error is without the
 * contribution of noise, see FitExposures(). Sets the deviations of report.points. Leaves all unset if fewer than three
 * points are in the range. */
void
MeasureLinearity(const TransferCurve & curve, EmvaReport & report);

/** Returns the spatial variances of a mean image, with their parts of columns, rows and pixels, (35) to (42).
 *
 * A variance is the mean square of the deviations from the mean, with the number of pixels as divisor (35). The parts
 * solve the three equations of (42). The variance of the means of columns contains the part of the pixels over the
 * number of rows. The variance of the means of rows contains the part of the pixels over the number of columns. The sum
 * of all three parts is the total variance.
 * \param mean mean image of the frames, row after row [DN]
 * \param columns columns of the image, 3 or more [pixel]
 * \param rows rows of the image, 3 or more [pixel]
 * \param stackDn2 temporal variance of a pixel in one frame (65) [DN^2]
 * \param frames number of frames of the mean */
SensorNoise_EXPORT EmvaSpatialVariance
MeasureSpatialVariance(const std::vector<double> & mean,
                       std::size_t                 columns,
                       std::size_t                 rows,
                       double                      stackDn2,
                       std::size_t                 frames);

/** Pixels between the centre and the end of the lowpass kernel: 3 of the box of 7, 5 of the box of 11, and 1 of the
 * binomial mask of 3. */
inline constexpr std::size_t EmvaFilterRadius = 9;

/** Image after the highpass filter, row after row [DN]. */
struct HighpassImage
{
  std::size_t         columns{ 0 };
  std::size_t         rows{ 0 };
  std::vector<double> pixels;
};

/** Returns the weights of the lowpass filter along one axis, whose sum is 1: a box of 7, a box of 11 and the binomial
 * mask 1 2 1, one after the other. */
SensorNoise_EXPORT const std::array<double, 2 * EmvaFilterRadius + 1> &
EmvaLowpassKernel();

/** Returns whether the filter leaves three or more columns and rows of a frame. */
SensorNoise_EXPORT bool
HasRoomForHighpass(std::size_t width, std::size_t height);

/** Applies the highpass filter of EMVA Standard 1288, Release 4.0 Linear, section 8.1: the image minus its lowpass.
 *
 * The lowpass filter is a box of 7 x 7 pixels, a box of 11 x 11 and a binomial mask of 3 x 3. It suppresses the uneven
 * illumination. Only pixels whose neighbourhood of 19 x 19 pixels is in the image are kept: the filter is the same for
 * all of them. \a image has \a width x \a height pixels and room for the filter (HasRoomForHighpass()). */
SensorNoise_EXPORT HighpassImage
FilterHighpass(const std::vector<double> & image,
               std::size_t                 width,
               std::size_t                 height,
               const ParallelFor &         parallelFor = SerialFor);

} // namespace sensornoise

#endif
