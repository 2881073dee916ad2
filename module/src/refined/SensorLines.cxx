// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/GainEstimate.h"

#include "base/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sensornoise
{

namespace
{
using Shapes = std::array<WeightedShape, NumberOfShapes>;

/** Adds a shape of the covariance, times \a weight, to a sum. */
void
AddShape(double weight, const WeightedShape & shape, WeightedShape & sum)
{
  sum.ofVariance += weight * shape.ofVariance;
  sum.ofSignal += weight * shape.ofSignal;
  sum.ofSquare += weight * shape.ofSquare;
  sum.constantDn2 += weight * shape.constantDn2;
}

/** Returns the mean of all shapes of the covariance, weighted with their probabilities and coefficients. */
WeightedShape
MeanOf(const Shapes & shapes)
{
  WeightedShape mean;
  for (const WeightedShape & shape : shapes)
  {
    AddShape(shape.probability * shape.coefficient.value, shape, mean);
  }
  return mean;
}

/** Returns the mean shape of the covariance with all neighbours in all frames. A filter over frames scales the
 * covariance of neighbours, too, and the other way round. */
WeightedShape
MeanShape(const NoiseCorrelation & correlation)
{
  const WeightedShape space = MeanOf(correlation.shapes);
  const WeightedShape time = MeanOf(correlation.timeShapes);
  WeightedShape       mean;
  AddShape(1.0 + time.ofVariance, space, mean);
  AddShape(1.0 + space.ofVariance, time, mean);
  mean.ofVariance -= space.ofVariance * time.ofVariance;
  return mean;
}

/** Total covariance over lags as a function of the level, applied to a variance or a line. */
class TotalCovariance
{
public:
  TotalCovariance(const NoiseCorrelation & correlation, double blackDn, double quantisationDn2)
    : m_Mean(MeanShape(correlation))
    , m_BlackDn(blackDn)
    , m_QuantisationDn2(quantisationDn2)
    , m_StructuredDn2(correlation.SignificantStructuredNoise().value)
  {}

  /** Returns the sensor's variance, from the variance of a pixel at a level [DN^2]. */
  double
  SensorOf(double varianceDn2, double levelDn) const
  {
    const double signal = levelDn - m_BlackDn;
    const double noise = varianceDn2 - m_QuantisationDn2 - m_StructuredDn2;
    return m_QuantisationDn2 + noise * this->Factor() + m_Mean.constantDn2 +
           signal * (m_Mean.ofSignal + signal * m_Mean.ofSquare);
  }
  /** Returns the derivative of the sensor's variance with respect to a pixel's variance [1]. */
  double
  Factor() const
  {
    return 1.0 + m_Mean.ofVariance;
  }
  /** Returns the line of the sensor. \a lineOfSquare has slope and intercept of the line through the squared signal. */
  VarianceLine
  SensorOf(const VarianceLine & line, const Eigen::Vector2d & lineOfSquare) const
  {
    VarianceLine sensor = line;
    const double factor = this->Factor();
    sensor.gain = factor * line.gain + m_Mean.ofSignal + m_Mean.ofSquare * lineOfSquare(0);
    sensor.intercept = m_QuantisationDn2 + factor * (line.intercept - m_QuantisationDn2 - m_StructuredDn2) +
                       m_Mean.ofSquare * lineOfSquare(1) - m_Mean.ofSignal * m_BlackDn + m_Mean.constantDn2;
    sensor.lowestDn2 = line.lowestDn2 * factor;
    sensor.covariance = line.covariance * (factor * factor);
    sensor.curvature = line.curvature * factor + m_Mean.ofSquare;
    sensor.curvatureSd = line.curvatureSd * factor;
    sensor.noiseDispersionDn4 = line.noiseDispersionDn4 * factor * factor;
    return sensor;
  }

private:
  WeightedShape m_Mean;
  double        m_BlackDn;
  double        m_QuantisationDn2;
  double        m_StructuredDn2;
};

/** Returns slope and intercept of the line through the squared signal, with the weights of the curve. */
Eigen::Vector2d
LineOfSquare(const VarianceCurve & curve, double blackDn)
{
  double weight = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (const CurveBin & bin : curve.bins)
  {
    if (bin.weight > 0.0)
    {
      const double signal = curve.LevelOf(bin) - blackDn;
      weight += bin.weight;
      first += bin.weight * signal;
      second += bin.weight * signal * signal;
    }
  }
  if (!(weight > 0.0))
  {
    return Eigen::Vector2d::Zero();
  }
  const double mean = first / weight;
  const double meanSquare = second / weight;
  double       spread = 0.0;
  double       product = 0.0;
  for (const CurveBin & bin : curve.bins)
  {
    if (bin.weight > 0.0)
    {
      const double signal = curve.LevelOf(bin) - blackDn;
      spread += bin.weight * (signal - mean) * (signal - mean);
      product += bin.weight * (signal - mean) * (signal * signal - meanSquare);
    }
  }
  const double slope = spread > 0.0 ? product / spread : 2.0 * mean;
  return { slope, meanSquare - slope * (mean + blackDn) };
}

VarianceCurve
CurveOfSensor(const VarianceCurve & curve, const TotalCovariance & shared, const VarianceLine & line)
{
  VarianceCurve sensor{ line, {} };
  for (const CurveBin & bin : curve.bins)
  {
    CurveBin changed = bin;
    if (bin.weight > 0.0)
    {
      const double level = curve.LevelOf(bin);
      const double variance = curve.VarianceOf(bin);
      changed.weight = bin.weight / (shared.Factor() * shared.Factor());
      changed.x = changed.weight * (level - line.pivotDn);
      changed.excess = changed.weight * (shared.SensorOf(variance, level) - line.intercept - line.gain * level);
    }
    sensor.bins.push_back(changed);
  }
  return sensor;
}

/** Returns the covariance of the numbers that unitOf(shape) makes of a coefficient of 1: the errors of the
 * coefficients, and the dispersion between the shapes. The remaining probability is that the covariance is a constant,
 * which does not grow with the signal. */
template <typename TFunction>
Eigen::Matrix2d
ErrorOfShapes(const Shapes & shapes, TFunction unitOf)
{
  const Eigen::Vector2d mean = unitOf(MeanOf(shapes));
  double                constant = 1.0;
  Eigen::Matrix2d       error = Eigen::Matrix2d::Zero();
  for (const WeightedShape & shape : shapes)
  {
    const Eigen::Vector2d unit = unitOf(shape);
    const Eigen::Vector2d own = shape.coefficient.value * unit - mean;
    const Eigen::Vector2d chance = shape.coefficient.standardError * unit;
    error += shape.probability * (own * own.transpose() + chance * chance.transpose());
    constant -= shape.probability;
  }
  return error + std::max(0.0, constant) * mean * mean.transpose();
}

/** Returns the probability that the temporal covariance is not a constant, so that more lags would change the gain. */
double
ProbabilityOfFilter(const NoiseCorrelation & correlation)
{
  double probability = 0.0;
  for (const WeightedShape & shape : correlation.timeShapes)
  {
    probability += shape.ofVariance > 0.0 || shape.ofSignal > 0.0 ? shape.probability : 0.0;
  }
  return probability;
}

/** Returns the covariance of gain and intercept by the uncertainty of the noise correlation. */
Eigen::Matrix2d
ErrorOf(const NoiseCorrelation & correlation,
        const VarianceLine &     line,
        const VarianceLine &     sensor,
        const Eigen::Vector2d &  lineOfSquare,
        double                   blackDn,
        double                   quantisationDn2)
{
  const auto unitOf = [&](const WeightedShape & shape) {
    return Eigen::Vector2d(shape.ofVariance * Eigen::Vector2d(line.gain, line.intercept - quantisationDn2) +
                           shape.ofSignal * Eigen::Vector2d(1.0, -blackDn) + shape.ofSquare * lineOfSquare +
                           Eigen::Vector2d(0.0, shape.constantDn2));
  };
  const double    ofSpace = 1.0 + MeanOf(correlation.shapes).ofVariance;
  const double    ofTime = 1.0 + MeanOf(correlation.timeShapes).ofVariance;
  Eigen::Matrix2d error = ofTime * ofTime * ErrorOfShapes(correlation.shapes, unitOf) +
                          ofSpace * ofSpace * ErrorOfShapes(correlation.timeShapes, unitOf);
  const Eigen::Vector2d whole(sensor.gain, sensor.intercept - quantisationDn2);
  const double          beyond = std::hypot(ofTime * correlation.beyondReach,
                                   ofSpace * ProbabilityOfFilter(correlation) * correlation.beyondTimeLags);
  const double          relative = beyond * line.gain / std::max(smallestDivisor, sensor.gain);
  error += relative * relative * whole * whole.transpose();
  // The structured noise is subtracted before the factor of the filter is applied.
  const double ofStructured = FilterFactor(correlation) * correlation.SignificantStructuredNoise().standardError;
  error(1, 1) += ofStructured * ofStructured;
  return error;
}
} // namespace

SensorLines
LinesOf(const StaticVariance & variance)
{
  const Eigen::Vector2d lost = variance.lostVariance * Eigen::Vector2d(variance.line.gain, variance.line.intercept);
  return { variance.line,  variance.instrumentalLine, variance.fromFrames,
           variance.curve, lost * lost.transpose(),   variance.ofOwnLevels };
}

double
FilterFactor(const NoiseCorrelation & correlation)
{
  return 1.0 + MeanShape(correlation).ofVariance;
}

double
VarianceOfSensor(double varianceDn2, const NoiseCorrelation & correlation, double quantisationDn2)
{
  return TotalCovariance(correlation, 0.0, quantisationDn2).SensorOf(varianceDn2, 0.0);
}

double
StandardDeviationOfShapes(double varianceDn2, const NoiseCorrelation & correlation, double quantisationDn2)
{
  const double noise = varianceDn2 - quantisationDn2 - correlation.SignificantStructuredNoise().value;
  const auto   covarianceOf = [noise](const WeightedShape & shape) {
    return shape.ofVariance * noise + shape.constantDn2;
  };
  const auto deviationOf = [&covarianceOf](const Shapes & shapes) {
    const double mean = covarianceOf(MeanOf(shapes));
    double       square = 0.0;
    double       left = 1.0;
    for (const WeightedShape & shape : shapes)
    {
      const double own = shape.coefficient.value * covarianceOf(shape) - mean;
      square += shape.probability * own * own;
      left -= shape.probability;
    }
    return std::sqrt(square + std::max(0.0, left) * mean * mean);
  };
  return std::hypot((1.0 + MeanOf(correlation.timeShapes).ofVariance) * deviationOf(correlation.shapes),
                    (1.0 + MeanOf(correlation.shapes).ofVariance) * deviationOf(correlation.timeShapes));
}

SensorLines
AddCovariances(const SensorLines & lines, const NoiseCorrelation & correlation, double blackDn, double quantisationDn2)
{
  const TotalCovariance shared(correlation, blackDn, quantisationDn2);
  const Eigen::Vector2d square = LineOfSquare(lines.curve, blackDn);
  SensorLines           sensor;
  sensor.all = shared.SensorOf(lines.all, square);
  sensor.instrumentalLine = shared.SensorOf(lines.instrumentalLine, square);
  sensor.fromFrames = CurveOfSensor(lines.fromFrames, shared, shared.SensorOf(lines.fromFrames.line, square));
  sensor.curve = CurveOfSensor(lines.curve, shared, shared.SensorOf(lines.curve.line, square));
  sensor.ofOwnLevels = CurveOfSensor(lines.ofOwnLevels, shared, shared.SensorOf(lines.ofOwnLevels.line, square));
  sensor.covarianceOfCorrelation =
    lines.covarianceOfCorrelation + ErrorOf(correlation, lines.all, sensor.all, square, blackDn, quantisationDn2);
  return sensor;
}

} // namespace sensornoise
