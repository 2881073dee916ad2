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

/** Sums over the pixels of a bin of the intensity, with the fit's weights; x is the mean above the line's pivot. */
struct CurveBin
{
  static constexpr std::size_t Sums = 4;

  double pixels{ 0.0 };
  double weight{ 0.0 };
  double x{ 0.0 };      ///< of weight times x
  double excess{ 0.0 }; ///< of weight times the variance above the line

  CurveBin &
  operator+=(const CurveBin & other);
};

/** By how much the slope of a part of the levels exceeds the line's gain. */
struct SlopeExcess
{
  double value{ 0.0 };     ///< [DN/e-]
  double variance{ 0.0 };  ///< of the difference between a part and the whole, from sampling [DN^2/e-^2]
  double levelsDn2{ 0.0 }; ///< weighted variance of the levels of the part [DN^2]
};

/** \class VarianceCurve
 * \brief The variance along the intensity, as it departs from a line: what tells whether the response is straight.
 *
 * The size of a departure is judged, never its significance alone: what sampling noise makes of it is taken off. */
struct SensorNoise_EXPORT VarianceCurve
{
  static constexpr std::size_t Bins = 64;

  VarianceLine          line;
  std::vector<CurveBin> bins; ///< of equal count of pixels, from dark to bright

  /** Of the bins' mean excesses: 1 if the variance is a line but for its sampling noise. */
  double
  ReducedChi2() const;

  /** D, the largest departure of the mean of a sixteenth of the pixels, relative to the line, without what chance makes
   * of it [1]. \a dispersion is what the excesses scatter by beyond their weights, 1 or more. */
  double
  Nonlinearity(double dispersion) const;

  /** The mean level of a bin [DN]. */
  double
  LevelOf(const CurveBin & bin) const
  {
    return line.pivotDn + bin.x / bin.weight;
  }

  /** The mean variance of a bin [DN^2]. */
  double
  VarianceOf(const CurveBin & bin) const
  {
    return line.intercept + line.gain * this->LevelOf(bin) + bin.excess / bin.weight;
  }

  /** Part of the brightest levels' light, above \a blackDn, that the darkest have [1]; 1 without levels. */
  double
  DarkestShare(double blackDn) const;

  /** Of the darker and the brighter half, parted by the count of pixels and by the information on the slope; a half of
   * one level is left out. */
  std::vector<SlopeExcess>
  SlopesOfHalves() const;

private:
  /** Of the bins from \a first up to \a last. */
  CurveBin
  SumOf(std::size_t first, std::size_t last) const;
  /** Of the bins' levels about their mean. */
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
