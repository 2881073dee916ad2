// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/SimulatedSensor.h"

#include "base/Quantiles.h"
#include "simulation/Random.h"
#include "simulation/FrameProcessing.h"

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
      RequireSetting(size > -1.0 && size < 1.0, "non-linearity of the response", size, "above -1 and below 1");
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

void
CheckSettings(const LineNoiseSettings & settings)
{
  RequireNotNegative(settings.rowNoiseSdDn, "row noise");
  RequireNotNegative(settings.columnNoiseSdDn, "column noise");
  RequireNotNegative(settings.bandingAmplitudeDn, "amplitude of the banding");
  RequireSetting(settings.bandingPeriodRows > 0.0 && settings.bandingPeriodRows <= 1e9,
                 "period of the banding",
                 settings.bandingPeriodRows,
                 "a number of rows above 0, at most 1e9");
}

LineNoise::LineNoise(const LineNoiseSettings & settings, std::uint64_t seed, bool isDark)
  : m_Settings(settings)
  , m_Seed(seed)
  , m_IsDark(isDark)
{}

double
LineNoise::OfRow(std::size_t frame, std::size_t y) const
{
  constexpr double twoPi = 6.283185307179586476925;
  double           noiseDn = 0.0;
  if (m_Settings.rowNoiseSdDn > 0.0)
  {
    CounterSeededRandom random(m_Seed, StreamNumber(RandomStream::RowNoise, m_IsDark), frame, y);
    noiseDn += m_Settings.rowNoiseSdDn * random.Normal();
  }
  if (m_Settings.bandingAmplitudeDn > 0.0)
  {
    CounterSeededRandom random(m_Seed, StreamNumber(RandomStream::Banding, m_IsDark), frame);
    const double        phase = twoPi * random.Uniform();
    noiseDn +=
      m_Settings.bandingAmplitudeDn * std::sin(twoPi * static_cast<double>(y) / m_Settings.bandingPeriodRows + phase);
  }
  return noiseDn;
}

void
LineNoise::AddTo(double * valuesDn, std::size_t width, std::size_t frame, std::size_t y) const
{
  if (!IsOn())
  {
    return;
  }
  const double rowDn = OfRow(frame, y);
  // The numbers of the columns are drawn again for every row, so that a row depends on its own counters only.
  CounterSeededRandom random(m_Seed, StreamNumber(RandomStream::ColumnNoise, m_IsDark), frame);
  for (std::size_t x = 0; x < width; ++x)
  {
    valuesDn[x] += rowDn + (m_Settings.columnNoiseSdDn > 0.0 ? m_Settings.columnNoiseSdDn * random.Normal() : 0.0);
  }
}

ReadOut::ReadOut(const SimulationSettings & settings, std::size_t width, std::size_t height)
  : m_Camera(settings.camera)
  , m_Width(width)
  , m_Height(height)
  , m_Response(settings.flaws.response)
  , m_FullScaleElectrons(settings.flaws.response.fullScaleElectrons > 0.0 ? settings.flaws.response.fullScaleElectrons
                                                                          : settings.camera.electrons)
  , m_LineNoise(settings.flaws.lineNoise, settings.seed, settings.isDark)
  , m_RelativeGain(DrawGainPattern(settings.flaws.pattern, settings.seed, width, height))
  , m_OffsetDn(DrawOffsetDn(settings, width, height))
  , m_ReadNoiseDn(DrawReadNoiseDn(settings, width, height))
{}

void
ReadOut::ReadRow(std::size_t frame, std::size_t y, const double * electrons, const double * normals, double * valuesDn)
  const
{
  for (std::size_t x = 0; x < m_Width; ++x)
  {
    const std::size_t pixel = y * m_Width + x;
    const double      gain = m_Camera.gainDnPerElectron * RelativeGain(pixel);
    if (m_Response.IsLinear())
    {
      const double noiseDn = RelativeGain(pixel) * ReadNoiseDn(pixel) * normals[x];
      valuesDn[x] = gain * electrons[x] + OffsetDn(pixel) + noiseDn;
    }
    else
    {
      const double signal = electrons[x] + ReadNoiseDn(pixel) / m_Camera.gainDnPerElectron * normals[x];
      valuesDn[x] = gain * m_FullScaleElectrons * m_Response.Value(signal / m_FullScaleElectrons) + OffsetDn(pixel);
    }
  }
  m_LineNoise.AddTo(valuesDn, m_Width, frame, y);
}

double
ReadOut::LocalGainAt(std::size_t pixel, double electrons) const
{
  return m_Camera.gainDnPerElectron * RelativeGain(pixel) * m_Response.Slope(electrons / m_FullScaleElectrons);
}

ResponseCurve::Moments
ReadOut::InTheDark(std::size_t pixel) const
{
  return m_Response.InTheDark(ReadNoiseDn(pixel) / (m_Camera.gainDnPerElectron * m_FullScaleElectrons));
}

double
ReadOut::PixelReadNoiseDn(std::size_t pixel) const
{
  return m_Response.IsLinear()
           ? RelativeGain(pixel) * ReadNoiseDn(pixel)
           : m_Camera.gainDnPerElectron * RelativeGain(pixel) * m_FullScaleElectrons * InTheDark(pixel).sd;
}

double
ReadOut::PixelOffsetDn(std::size_t pixel) const
{
  return OffsetDn(pixel) +
         m_Camera.gainDnPerElectron * RelativeGain(pixel) * m_FullScaleElectrons * InTheDark(pixel).mean;
}

ReadOut::ReadNoise
ReadOut::SummariseReadNoise() const
{
  if (m_RelativeGain.empty() && m_ReadNoiseDn.empty())
  {
    return { PixelReadNoiseDn(0), PixelReadNoiseDn(0) };
  }
  std::vector<double> noiseDn(m_Width * m_Height);
  double              squares = 0.0;
  for (std::size_t pixel = 0; pixel < noiseDn.size(); ++pixel)
  {
    noiseDn[pixel] = PixelReadNoiseDn(pixel);
    squares += noiseDn[pixel] * noiseDn[pixel];
  }
  return { std::sqrt(squares / static_cast<double>(noiseDn.size())), Quantile(noiseDn, 0.5) };
}

} // namespace sensornoise
