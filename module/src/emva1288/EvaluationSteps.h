// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_EvaluationSteps_h
#define sensornoise_emva1288_EvaluationSteps_h

#include "sensornoise/Emva1288.h"
#include "moments/Exposures.h"
#include "report/Quantities.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

/** \file
 * The photon transfer curve, and the steps of EvaluateEmva1288(). Each of them sets a part of the report. */

namespace sensornoise
{

class DarkLevels;

/** Photon transfer curve: the flat series in the order of their exposures, and saturation. */
struct TransferCurve
{
  std::vector<EmvaSeries> series;               ///< series of each point
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

/** Makes the curve. Of an exposure with a pair of frames and a longer series, the pair counts. Throws
 * std::invalid_argument if fewer than three exposures differ, if the frames have no temporal noise, or if the flat
 * fields are darker than the dark frames. */
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

/** Sets the weighted estimate of the system gain: the slope of a line through the variances of all flat series in this
 * range and of all dark series, against their means.
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
 * without it, and the series that they are measured of.
 *
 * The bright series is the one with the most frames; of equal ones the one whose signal is nearest to half of \a
 * saturationSignalDn [DN]. The dark series is the one with the most frames; of equal ones the one whose exposure is
 * nearest to the bright series. All are from report.series. A variance that is not distinguished from 0 gives an upper
 * limit. The standard errors are valid for white patterns. DSNU needs report.gain. */
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

} // namespace sensornoise

#endif
