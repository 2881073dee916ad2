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
/** Weights of the values in slope and intercept: the line is the sum of weights times values. */
struct LineWeights
{
  std::vector<double> ofSlope;
  std::vector<double> ofIntercept;
};

LineWeights
WeightsOf(const std::vector<LevelValue> & values, const std::vector<double> & weights)
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
  LineWeights line;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    line.ofSlope.push_back(weights[i] * (values[i].x - mean) / squares);
    line.ofIntercept.push_back(weights[i] / sum - mean * line.ofSlope.back());
  }
  return line;
}

/** Returns the line with these weights, its errors and its reduced chi-square. */
LevelLine
LineBy(const LineWeights & weights, const std::vector<LevelValue> & values)
{
  LevelLine line;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    line.slope += weights.ofSlope[i] * values[i].y;
    line.intercept += weights.ofIntercept[i] * values[i].y;
  }
  const bool areKnown =
    std::all_of(values.begin(), values.end(), [](const LevelValue & value) { return value.variance > 0.0; });
  line.dof = static_cast<double>(values.size()) - 2.0;
  double chi2 = 0.0;
  double slopeVariance = 0.0;
  double interceptVariance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double variance = areKnown ? values[i].variance : 1.0;
    const double residual = values[i].y - line.intercept - line.slope * values[i].x;
    chi2 += residual * residual / variance;
    slopeVariance += weights.ofSlope[i] * weights.ofSlope[i] * variance;
    interceptVariance += weights.ofIntercept[i] * weights.ofIntercept[i] * variance;
  }
  const double scatter = line.dof > 0.0 ? chi2 / line.dof : 0.0;
  const double factor = areKnown ? std::max(1.0, scatter) : scatter;
  line.reducedChi2 = areKnown ? scatter : 1.0;
  line.slopeStandardError = std::sqrt(slopeVariance * factor);
  line.interceptStandardError = std::sqrt(interceptVariance * factor);
  return line;
}
} // namespace

LevelLine
FitLevelLine(const std::vector<LevelValue> & values)
{
  return LineBy(WeightsOf(values, std::vector<double>(values.size(), 1.0)), values);
}

LevelLine
FitWeightedLine(const std::vector<LevelValue> & values)
{
  std::vector<double> weights;
  for (const LevelValue & value : values)
  {
    weights.push_back(1.0 / value.variance);
  }
  return LineBy(WeightsOf(values, weights), values);
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
  for (const LevelValue & value : values)
  {
    weights.push_back(1.0 / (value.y * value.y));
  }
  const LineWeights of = WeightsOf(values, weights);
  LevelLine         line;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    line.slope += of.ofSlope[i] * values[i].y;
    line.intercept += of.ofIntercept[i] * values[i].y;
  }
  return line;
}

} // namespace sensornoise
