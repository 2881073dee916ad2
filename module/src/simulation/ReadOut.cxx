// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/ReadOut.h"

#include "base/Quantiles.h"
#include "simulation/FixedPattern.h"
#include "simulation/Random.h"
#include "simulation/SettingChecks.h"

#include <cmath>

namespace sensornoise
{

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
LineNoise::AddTo(double * codesDn, std::size_t width, std::size_t frame, std::size_t y) const
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
    codesDn[x] += rowDn + (m_Settings.columnNoiseSdDn > 0.0 ? m_Settings.columnNoiseSdDn * random.Normal() : 0.0);
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
ReadOut::ReadRow(std::size_t frame, std::size_t y, const double * electrons, const double * normals, double * codesDn)
  const
{
  for (std::size_t x = 0; x < m_Width; ++x)
  {
    const std::size_t pixel = y * m_Width + x;
    const double      gain = m_Camera.gainDnPerElectron * RelativeGain(pixel);
    if (m_Response.IsLinear())
    {
      const double noiseDn = RelativeGain(pixel) * ReadNoiseDn(pixel) * normals[x];
      codesDn[x] = gain * electrons[x] + OffsetDn(pixel) + noiseDn;
    }
    else
    {
      const double signal = electrons[x] + ReadNoiseDn(pixel) / m_Camera.gainDnPerElectron * normals[x];
      codesDn[x] = gain * m_FullScaleElectrons * m_Response.Value(signal / m_FullScaleElectrons) + OffsetDn(pixel);
    }
  }
  m_LineNoise.AddTo(codesDn, m_Width, frame, y);
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
