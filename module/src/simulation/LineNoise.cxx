// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/LineNoise.h"

#include "simulation/Random.h"
#include "simulation/RandomStreams.h"
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

} // namespace sensornoise
