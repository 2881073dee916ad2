// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ResponseCurve_h
#define sensornoise_simulation_ResponseCurve_h

#include "SensorNoiseExport.h"

#include <string>

namespace sensornoise
{

/** Kinds of bend. In each, u is the analogue signal in units of the full scale, R(u) that of the code, and R'(u) the
 * local gain in units of the camera's. */
enum class ResponseShape
{
  Straight,  ///< R = u
  Quadratic, ///< R' = 1 + size (1 - 2 u): size is the departure in the dark, -size at full scale
  Wave,      ///< R' = 1 + size cos(2 pi u): too high at both ends, too low in the middle
  Shoulder,  ///< R' = 1 + size up to 60 % of the scale, from there on a half cosine down to 1 - size
  Gamma,     ///< R = u^(1/size), a tone curve; 0 below 0
  SCurve     ///< R = (1 - size) u + size (3 u^2 - 2 u^3): film-like contrast
};

/** The shape's name as options spell it: "straight", "quadratic", "wave", "shoulder", "gamma", "s-curve". */
SensorNoise_EXPORT const char *
NameOf(ResponseShape shape);

/** \throws std::invalid_argument if no shape has this name. */
SensorNoise_EXPORT ResponseShape
ResponseShapeOf(const std::string & name);

/** The line from electrons to codes, and how it is bent. Departures of 2 to 4 % are common for CMOS sensors (the
 * linearity error of EMVA Standard 1288 says how far a sensor is off). */
struct ResponseSettings
{
  ResponseShape shape{ ResponseShape::Straight };
  /** Strength. Quadratic, Wave, Shoulder: relative departure of the local gain [1], above -1 and below 1. Gamma: the
   * exponent, such as 2.2 [1], from 0.1 to 10. SCurve: weight of the smooth step [1], from 0 to 1. Straight: without
   * meaning. */
  double size{ 0.0 };
  /** S, the signal at u = 1 [e-]; 0: the electrons of the scene's brightest pixel. */
  double fullScaleElectrons{ 0.0 };
};

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
