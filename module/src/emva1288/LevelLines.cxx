// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/LevelLines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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
 * expectation. Of value i with the variance v and the leverage h, the weighted square w (1 - h) v is expected. This
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

} // namespace sensornoise
