// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_VarianceCurve_h
#define sensornoise_pixels_VarianceCurve_h

#include "SensorNoiseExport.h"
#include "pixels/VarianceLine.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Sums over the pixels of an intensity bin, with the weights of the fit. */
struct CurveBin
{
  /** Number of members. */
  static constexpr std::size_t Sums = 4;

  double pixels{ 0.0 }; ///< number of pixels
  double weight{ 0.0 }; ///< sum of the weights [1/DN^4]
  double x{ 0.0 };      ///< sum of weight times the mean above the line's pivot [1/DN^3]
  double excess{ 0.0 }; ///< sum of weight times the variance above the line [1/DN^2]

  CurveBin &
  operator+=(const CurveBin & other);
};

/** Excess of the slope in an interval of the levels over the line's gain. */
struct SlopeExcess
{
  double value{ 0.0 };     ///< excess of the slope [DN/e-]
  double variance{ 0.0 };  ///< sampling variance of the slope in the interval minus the slope of all levels [DN^2/e-^2]
  double levelsDn2{ 0.0 }; ///< weighted variance of the levels of the interval [DN^2]
};

/** \class VarianceCurve
 * \brief Deviation of the variance from a line as a function of the intensity, which shows whether the response is
 * linear.
 *
 * The size of a deviation is tested, not its significance alone. The contribution of sampling noise to it is
 * subtracted. */
struct SensorNoise_EXPORT VarianceCurve
{
  /** Largest number of bins. */
  static constexpr std::size_t Bins = 64;

  VarianceLine          line;
  std::vector<CurveBin> bins; ///< bins of equal numbers of pixels, from dark to bright

  /** Returns the reduced chi-square of the bins' mean excesses: 1 if they are sampling noise about a line [1]. */
  double
  ReducedChi2() const;

  /** Returns the non-linearity D: the largest deviation of the mean of a sixteenth of the bins, relative to the line,
   * less the deviation expected by chance [1]. \a dispersion is the variance of the excesses over the variance by their
   * weights, 1 or more [1]. */
  double
  Nonlinearity(double dispersion) const;

  /** Returns the mean level of a bin [DN]. */
  double
  LevelOf(const CurveBin & bin) const
  {
    return line.pivotDn + bin.x / bin.weight;
  }

  /** Returns the mean variance of a bin [DN^2]. */
  double
  VarianceOf(const CurveBin & bin) const
  {
    return line.intercept + line.gain * this->LevelOf(bin) + bin.excess / bin.weight;
  }

  /** Returns the signal of the darkest bin as a fraction of the signal of the brightest bin, both above \a blackDn [1];
   * 1 without bins. */
  double
  DarkestFraction(double blackDn) const;

  /** Returns the excesses of the slope in the darker and the brighter half of the levels, divided once by the number of
   * pixels and once by the information on the slope. A half of one level is left out. */
  std::vector<SlopeExcess>
  FitHalves() const;

private:
  /** Returns the sum of the bins [first, last). */
  CurveBin
  SumOf(std::size_t first, std::size_t last) const;
  /** Slope of the excess over some bins, about their mean level. */
  struct Slope
  {
    double information; ///< weighted sum of the squared deviations
    double weight;      ///< sum of the weights
    double excess;      ///< slope of the excess [DN/e-]
  };
  Slope
  SlopeOf(std::size_t first, std::size_t last) const;
};

} // namespace sensornoise

#endif
