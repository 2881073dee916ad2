// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ResponseCurve_h
#define sensornoise_simulation_ResponseCurve_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"

#include <string>

namespace sensornoise
{

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ResponseSettings & settings);

/** \class ResponseCurve
 * R(u), with R(0) = 0: the mean code is offset + gain S R(signal / S). Every shape but Gamma runs from 0 to 1. Below
 * u = 0 and above u = 1 the curve goes on straight, with the slope of its end; Gamma is 0 below 0. */
class SensorNoise_EXPORT ResponseCurve
{
public:
  explicit ResponseCurve(const ResponseSettings & settings = {});

  bool
  IsStraight() const
  {
    return m_Shape == ResponseShape::Straight;
  }

  /** R(u) [1]. */
  double
  Value(double u) const;

  /** R'(u) [1]; of Gamma 0 at u = 0, the slope from the left. */
  double
  Slope(double u) const;

  /** Mean and standard deviation of a curve's value. */
  struct Moments
  {
    double mean;
    double sd;
  };

  /** Mean and standard deviation of R(noise), noise normal about 0 with standard deviation \a sd [1]: what read noise
   * looks like in the dark. Exact for a straight curve and, up to noise of the order of the full scale, for Gamma,
   * which cuts one half of the noise off; to first order in \a sd for the others. */
  Moments
  InTheDark(double sd) const;

private:
  double
  InnerValue(double u) const;
  double
  InnerSlope(double u) const;

  ResponseShape m_Shape;
  double        m_Size;
};

} // namespace sensornoise

#endif
