// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/ResponseCurve.h"

#include "simulation/SettingChecks.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sensornoise
{
namespace
{
constexpr double CurvePi = 3.14159265358979323846;
constexpr double ShoulderStart = 0.6;

constexpr std::array<std::pair<ResponseShape, const char *>, 6> ShapeNames{ { { ResponseShape::Straight, "straight" },
                                                                              { ResponseShape::Quadratic, "quadratic" },
                                                                              { ResponseShape::Wave, "wave" },
                                                                              { ResponseShape::Shoulder, "shoulder" },
                                                                              { ResponseShape::Gamma, "gamma" },
                                                                              { ResponseShape::SCurve, "s-curve" } } };

/** Returns the angle of the half cosine of the shoulder [rad]. */
double
ShoulderAngle(double u)
{
  return CurvePi * (u - ShoulderStart) / (1.0 - ShoulderStart);
}
} // namespace

const char *
NameOf(ResponseShape shape)
{
  for (const auto & [known, name] : ShapeNames)
  {
    if (known == shape)
    {
      return name;
    }
  }
  return "unknown";
}

ResponseShape
ResponseShapeOf(const std::string & name)
{
  for (const auto & [shape, known] : ShapeNames)
  {
    if (name == known)
    {
      return shape;
    }
  }
  throw std::invalid_argument("the response \"" + name +
                              "\" is not known; expected straight, quadratic, wave, shoulder, gamma or s-curve");
}

void
CheckSettings(const ResponseSettings & settings)
{
  RequireNotNegative(settings.fullScaleElectrons, "full scale of the response");
  const double size = settings.size;
  switch (settings.shape)
  {
    case ResponseShape::Straight:
      return;
    case ResponseShape::Gamma:
      RequireSetting(size >= 0.1 && size <= 10.0, "exponent of the response", size, "0.1 to 10");
      return;
    case ResponseShape::SCurve:
      RequireSetting(size >= 0.0 && size <= 1.0, "weight of the response's s-curve", size, "0 to 1");
      return;
    default:
      RequireSetting(size > -1.0 && size < 1.0, "bend of the response", size, "above -1 and below 1");
  }
}

ResponseCurve::ResponseCurve(const ResponseSettings & settings)
  : m_Shape(settings.shape)
  , m_Size(settings.size)
{
  CheckSettings(settings);
}

double
ResponseCurve::Value(double u) const
{
  if (u < 0.0)
  {
    return InnerSlope(0.0) * u;
  }
  return u > 1.0 ? InnerValue(1.0) + InnerSlope(1.0) * (u - 1.0) : InnerValue(u);
}

double
ResponseCurve::Slope(double u) const
{
  return InnerSlope(u < 0.0 ? 0.0 : u > 1.0 ? 1.0 : u);
}

double
ResponseCurve::InnerValue(double u) const
{
  switch (m_Shape)
  {
    case ResponseShape::Quadratic:
      return u + m_Size * (u - u * u);
    case ResponseShape::Wave:
      return u + m_Size * std::sin(2.0 * CurvePi * u) / (2.0 * CurvePi);
    case ResponseShape::Shoulder:
      return u +
             m_Size *
               (u <= ShoulderStart ? u : ShoulderStart + (1.0 - ShoulderStart) / CurvePi * std::sin(ShoulderAngle(u)));
    case ResponseShape::Gamma:
      return std::pow(u, 1.0 / m_Size);
    case ResponseShape::SCurve:
      return (1.0 - m_Size) * u + m_Size * u * u * (3.0 - 2.0 * u);
    default:
      return u;
  }
}

double
ResponseCurve::InnerSlope(double u) const
{
  switch (m_Shape)
  {
    case ResponseShape::Quadratic:
      return 1.0 + m_Size * (1.0 - 2.0 * u);
    case ResponseShape::Wave:
      return 1.0 + m_Size * std::cos(2.0 * CurvePi * u);
    case ResponseShape::Shoulder:
      return 1.0 + m_Size * (u <= ShoulderStart ? 1.0 : std::cos(ShoulderAngle(u)));
    case ResponseShape::Gamma:
      return u > 0.0 ? std::pow(u, 1.0 / m_Size - 1.0) / m_Size : 0.0;
    case ResponseShape::SCurve:
      return 1.0 - m_Size + 6.0 * m_Size * u * (1.0 - u);
    default:
      return 1.0;
  }
}

ResponseCurve::Moments
ResponseCurve::InTheDark(double sd) const
{
  if (m_Shape != ResponseShape::Gamma)
  {
    return { 0.0, InnerSlope(0.0) * sd };
  }
  // For a normal number n, E[n^p; n > 0] = 2^(p/2 - 1) Gamma((p + 1) / 2) / sqrt(pi).
  const auto halfMoment = [](double p) {
    return std::pow(2.0, 0.5 * p - 1.0) * std::tgamma(0.5 * (p + 1.0)) / std::sqrt(CurvePi);
  };
  const double power = 1.0 / m_Size;
  const double mean = halfMoment(power);
  const double scale = std::pow(sd, power);
  return { scale * mean, scale * std::sqrt(halfMoment(2.0 * power) - mean * mean) };
}

} // namespace sensornoise
