// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"


#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace sensornoise
{

namespace
{
/** Coefficients of the values in slope and intercept: the line is the sum of coefficients times values. */
struct LineCoefficients
{
  std::vector<double> ofSlope;
  std::vector<double> ofIntercept;
};

LineCoefficients
CoefficientsOf(const std::vector<LevelValue> & values, const std::vector<double> & weights)
{
  double sum = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    sum += weights[i];
    mean += weights[i] * values[i].x;
  }
  mean /= sum;
  double squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    squares += weights[i] * (values[i].x - mean) * (values[i].x - mean);
  }
  LineCoefficients coefficients;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    coefficients.ofSlope.push_back(weights[i] * (values[i].x - mean) / squares);
    coefficients.ofIntercept.push_back(weights[i] / sum - mean * coefficients.ofSlope.back());
  }
  return coefficients;
}

/** Returns slope and intercept. */
LevelLine
LineBy(const LineCoefficients & coefficients, const std::vector<LevelValue> & values)
{
  LevelLine line;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    line.slope += coefficients.ofSlope[i] * values[i].y;
    line.intercept += coefficients.ofIntercept[i] * values[i].y;
  }
  return line;
}

/** Returns the line with its errors and its reduced chi-square: the weighted sum of the squared residuals over its
 * expectation. The expected weighted square of a value with the variance v and the leverage h is w (1 - h) v. This
 * holds for equal weights and for w = 1 / v. */
LevelLine
LineWithErrors(const std::vector<LevelValue> & values, const std::vector<double> & weights)
{
  const LineCoefficients coefficients = CoefficientsOf(values, weights);
  LevelLine              line = LineBy(coefficients, values);
  const bool             areKnown =
    std::all_of(values.begin(), values.end(), [](const LevelValue & value) { return value.variance > 0.0; });
  double squares = 0.0;
  double expected = 0.0;
  double slopeVariance = 0.0;
  double interceptVariance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double variance = areKnown ? values[i].variance : 1.0;
    const double residual = values[i].y - line.intercept - line.slope * values[i].x;
    const double leverage = coefficients.ofIntercept[i] + coefficients.ofSlope[i] * values[i].x;
    squares += weights[i] * residual * residual;
    expected += weights[i] * (1.0 - leverage) * variance;
    slopeVariance += coefficients.ofSlope[i] * coefficients.ofSlope[i] * variance;
    interceptVariance += coefficients.ofIntercept[i] * coefficients.ofIntercept[i] * variance;
  }
  const double scatter = expected > 0.0 ? squares / expected : 0.0;
  const double factor = areKnown ? std::max(1.0, scatter) : scatter;
  line.dof = static_cast<double>(values.size()) - 2.0;
  line.reducedChi2 = areKnown ? scatter : 1.0;
  line.slopeStandardError = std::sqrt(slopeVariance * factor);
  line.interceptStandardError = std::sqrt(interceptVariance * factor);
  return line;
}
} // namespace

LevelLine
FitLevelLine(const std::vector<LevelValue> & values)
{
  return LineWithErrors(values, std::vector<double>(values.size(), 1.0));
}

LevelLine
FitWeightedLine(const std::vector<LevelValue> & values)
{
  std::vector<double> weights;
  weights.reserve(values.size());
  for (const LevelValue & value : values)
  {
    weights.push_back(1.0 / value.variance);
  }
  return LineWithErrors(values, weights);
}

LevelLine
FitLineThroughOrigin(const std::vector<LevelValue> & values)
{
  double products = 0.0;
  double squares = 0.0;
  for (const LevelValue & value : values)
  {
    products += value.x * value.y;
    squares += value.x * value.x;
  }
  LevelLine line;
  line.slope = products / squares;
  line.dof = static_cast<double>(values.size()) - 1.0;
  line.reducedChi2 = 1.0;
  double residuals = 0.0;
  for (const LevelValue & value : values)
  {
    residuals += (value.y - line.slope * value.x) * (value.y - line.slope * value.x);
  }
  line.slopeStandardError = std::sqrt(residuals / line.dof / squares);
  return line;
}

LevelLine
FitRelativeLine(const std::vector<LevelValue> & values)
{
  std::vector<double> weights;
  weights.reserve(values.size());
  for (const LevelValue & value : values)
  {
    weights.push_back(1.0 / (value.y * value.y));
  }
  return LineBy(CoefficientsOf(values, weights), values);
}

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
