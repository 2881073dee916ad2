// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ResponseCurve_h
#define sensornoise_simulation_ResponseCurve_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"

#include <string>

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ResponseSettings & settings);

/** \class ResponseCurve
 * \brief Response R(u), with R(0) = 0: the mean code is offset + gain S R(signal / S).
 *
 * Every shape but Gamma runs from 0 to 1. Below u = 0 and above u = 1 the curve continues linearly, with the slope at
 * its end; Gamma is 0 below 0. */
class SensorNoise_EXPORT ResponseCurve
{
public:
  explicit ResponseCurve(const ResponseSettings & settings = {});

  bool
  IsLinear() const
  {
    return m_Shape == ResponseShape::Straight;
  }

  /** Returns R(u) [1]. */
  double
  Value(double u) const;

  /** Returns R'(u) [1]. For Gamma it is 0 at u = 0, the slope from the left. */
  double
  Slope(double u) const;

  /** Mean and standard deviation of the value of a curve. */
  struct Moments
  {
    double mean;
    double sd;
  };

  /** Returns the mean and the standard deviation of R(noise), for normal noise about 0 with standard deviation \a sd
   * [1]: the effect of the response on read noise in the dark. The result is exact for a linear response. For Gamma,
   * which clips one half of the noise, it is exact for noise below the order of the full scale. For the others it is
   * of first order in \a sd. */
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
