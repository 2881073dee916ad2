// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/DarkLevels.h"

#include "emva1288/Constants.h"
#include "emva1288/LevelLines.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sensornoise
{

double
ErrorVarianceOf(const EmvaSeries & series)
{
  const double values = static_cast<double>(series.width * series.height) * (static_cast<double>(series.frames) - 1.0);
  return 2.0 * series.temporalVarianceDn2 * series.temporalVarianceDn2 / values;
}

DarkLevels::DarkLevels(const std::vector<EmvaSeries> & series)
{
  for (const EmvaSeries & each : series)
  {
    if (!each.isDark)
    {
      continue;
    }
    const auto same = std::find_if(
      m_Series.begin(), m_Series.end(), [&each](const EmvaSeries & known) { return known.exposure == each.exposure; });
    if (same == m_Series.end())
    {
      m_Series.push_back(each);
    }
    else if (each.frames < same->frames)
    {
      *same = each;
    }
  }
  if (m_Series.empty())
  {
    throw std::invalid_argument("none of the " + std::to_string(series.size()) +
                                " series is dark; expected two or more dark frames, which determine the dark level. "
                                "Record them with the sensor covered.");
  }
  std::sort(m_Series.begin(), m_Series.end(), [](const EmvaSeries & a, const EmvaSeries & b) {
    return a.exposure < b.exposure;
  });
}

DarkLevels::Level
DarkLevels::At(double exposure) const
{
  const auto levelOf = [](const EmvaSeries & series, bool isMeasured) {
    return Level{ series.meanDn, series.temporalVarianceDn2, ErrorVarianceOf(series), isMeasured };
  };
  const auto above = std::find_if(
    m_Series.begin(), m_Series.end(), [exposure](const EmvaSeries & series) { return series.exposure >= exposure; });
  if (above == m_Series.end())
  {
    return levelOf(m_Series.back(), false);
  }
  if (above->exposure == exposure || above == m_Series.begin())
  {
    return levelOf(*above, above->exposure == exposure);
  }
  const EmvaSeries & below = *(above - 1);
  const double       weight = (exposure - below.exposure) / (above->exposure - below.exposure);
  const auto         between = [weight](double a, double b) { return a + weight * (b - a); };
  return { between(below.meanDn, above->meanDn),
           between(below.temporalVarianceDn2, above->temporalVarianceDn2),
           (1.0 - weight) * (1.0 - weight) * ErrorVarianceOf(below) + weight * weight * ErrorVarianceOf(*above),
           false };
}

bool
DarkLevels::HasLine() const
{
  return m_Series.size() >= InEmva.fewestDarkExposures;
}

LevelLine
DarkLevels::MeanLine() const
{
  std::vector<LevelValue> values;
  for (const EmvaSeries & series : m_Series)
  {
    values.push_back({ series.exposure, series.meanDn, 0.0 });
  }
  return FitLevelLine(values);
}

LevelLine
DarkLevels::VarianceLine() const
{
  std::vector<LevelValue> values;
  for (const EmvaSeries & series : m_Series)
  {
    values.push_back({ series.exposure, series.temporalVarianceDn2, ErrorVarianceOf(series) });
  }
  return FitLevelLine(values);
}

FittedNumber
DarkLevels::DarkVariance() const
{
  if (this->HasLine())
  {
    const LevelLine line = this->VarianceLine();
    return { line.intercept, line.interceptStandardError };
  }
  return { m_Series.front().temporalVarianceDn2, std::sqrt(ErrorVarianceOf(m_Series.front())) };
}

} // namespace sensornoise
