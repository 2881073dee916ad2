// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/Random.h"
#include "simulation/SimulatedSensor.h"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
struct Nonlinearity
{
  ResponseShape shape;
  double        size;
};

const std::vector<Nonlinearity> Nonlinearities{ { ResponseShape::Straight, 0.0 },    { ResponseShape::Quadratic, 0.04 },
                                                { ResponseShape::Quadratic, -0.02 }, { ResponseShape::Wave, 0.04 },
                                                { ResponseShape::Wave, -0.04 },      { ResponseShape::Shoulder, 0.02 },
                                                { ResponseShape::Shoulder, -0.04 },  { ResponseShape::Gamma, 2.2 },
                                                { ResponseShape::SCurve, 0.5 } };

ResponseCurve
MakeCurve(const Nonlinearity & nonlinearity)
{
  return ResponseCurve({ nonlinearity.shape, nonlinearity.size });
}

std::string
ErrorOf(const ResponseSettings & settings)
{
  try
  {
    CheckSettings(settings);
  }
  catch (const std::invalid_argument & error)
  {
    return error.what();
  }
  return "no error";
}
} // namespace

TEST(SensorNoiseResponseCurve, SlopeIsTheDerivativeOfTheValue)
{
  for (const Nonlinearity & nonlinearity : Nonlinearities)
  {
    SCOPED_TRACE(std::string(NameOf(nonlinearity.shape)) + ' ' + std::to_string(nonlinearity.size));
    const ResponseCurve curve = MakeCurve(nonlinearity);
    for (const double u : { -0.3, 0.05, 0.3, 0.5, 0.55, 0.65, 0.9, 0.99, 1.2 })
    {
      // Central difference of step h: error h^2 / 6 |R'''|, below 2e-8, for R''' is at most 784 (Gamma at 0.05).
      constexpr double h = 1e-5;
      EXPECT_NEAR((curve.Value(u + h) - curve.Value(u - h)) / (2.0 * h), curve.Slope(u), 1e-7) << u;
    }
  }
}

TEST(SensorNoiseResponseCurve, EveryCurveStartsAtZeroAndEndsAtOneButTheShouldersArea)
{
  for (const Nonlinearity & nonlinearity : Nonlinearities)
  {
    SCOPED_TRACE(std::string(NameOf(nonlinearity.shape)) + ' ' + std::to_string(nonlinearity.size));
    const ResponseCurve curve = MakeCurve(nonlinearity);
    EXPECT_EQ(curve.Value(0.0), 0.0);
    // The shoulder's slope is 1 + size on 60 % of the range, and on average 1 on the rest.
    const double end = nonlinearity.shape == ResponseShape::Shoulder ? 1.0 + 0.6 * nonlinearity.size : 1.0;
    EXPECT_NEAR(curve.Value(1.0), end, 1e-15);
  }
}

TEST(SensorNoiseResponseCurve, SizeIsTheDeviationOfTheLocalGain)
{
  const ResponseCurve quadratic({ ResponseShape::Quadratic, 0.04 });
  EXPECT_NEAR(quadratic.Slope(0.0), 1.04, 1e-15);
  EXPECT_NEAR(quadratic.Slope(0.5), 1.0, 1e-15);
  EXPECT_NEAR(quadratic.Slope(1.0), 0.96, 1e-15);
  const ResponseCurve wave({ ResponseShape::Wave, -0.02 });
  EXPECT_NEAR(wave.Slope(0.0), 0.98, 1e-15);
  EXPECT_NEAR(wave.Slope(0.5), 1.02, 1e-15);
  EXPECT_NEAR(wave.Slope(1.0), 0.98, 1e-15);
  const ResponseCurve shoulder({ ResponseShape::Shoulder, 0.04 });
  EXPECT_NEAR(shoulder.Slope(0.0), 1.04, 1e-15);
  EXPECT_NEAR(shoulder.Slope(0.6), 1.04, 1e-15);
  EXPECT_NEAR(shoulder.Slope(0.8), 1.0, 1e-15);
  EXPECT_NEAR(shoulder.Slope(1.0), 0.96, 1e-15);
  EXPECT_NEAR(ResponseCurve({ ResponseShape::Gamma, 2.0 }).Value(0.25), 0.5, 1e-15);
  const ResponseCurve sCurve({ ResponseShape::SCurve, 0.4 });
  EXPECT_NEAR(sCurve.Slope(0.0), 0.6, 1e-15);
  EXPECT_NEAR(sCurve.Slope(0.5), 1.2, 1e-15); // 1 + size / 2
}

TEST(SensorNoiseResponseCurve, BeyondItsEndsACurveIsStraight)
{
  for (const Nonlinearity & nonlinearity : Nonlinearities)
  {
    SCOPED_TRACE(NameOf(nonlinearity.shape));
    const ResponseCurve curve = MakeCurve(nonlinearity);
    EXPECT_NEAR(curve.Value(1.5), curve.Value(1.0) + 0.5 * curve.Slope(1.0), 1e-15);
    EXPECT_NEAR(curve.Value(-0.5), -0.5 * curve.Slope(0.0), 1e-15);
  }
  const ResponseCurve gamma({ ResponseShape::Gamma, 2.2 });
  EXPECT_EQ(gamma.Value(-0.1), 0.0);
  EXPECT_EQ(gamma.Slope(-0.1), 0.0);
}

TEST(SensorNoiseResponseCurve, InTheDarkTheNoiseHasTheMomentsOfItsOutput)
{
  constexpr double sd = 0.003;
  constexpr int    count = 200000;
  for (const Nonlinearity & nonlinearity : Nonlinearities)
  {
    SCOPED_TRACE(NameOf(nonlinearity.shape));
    const ResponseCurve curve = MakeCurve(nonlinearity);
    const auto          expected = curve.InTheDark(sd);
    CounterSeededRandom random(5);
    double              sum = 0.0;
    double              squares = 0.0;
    for (int i = 0; i < count; ++i)
    {
      const double value = curve.Value(sd * random.Normal());
      sum += value;
      squares += value * value;
    }
    const double mean = sum / count;
    const double found = std::sqrt(squares / count - mean * mean);
    // 5 standard errors. The error of the standard deviation is the error for a normal law, which is wider than for a
    // truncated law. The second order of the curve adds R''(0) sd^2 / 2, with |R''| below 3.
    EXPECT_NEAR(mean, expected.mean, 5.0 * expected.sd / std::sqrt(count) + 1.5 * sd * sd);
    EXPECT_NEAR(found, expected.sd, 5.0 * expected.sd / std::sqrt(2.0 * count) + 1.5 * sd * sd);
  }
}

TEST(SensorNoiseResponseCurve, NamesReadBack)
{
  for (const Nonlinearity & nonlinearity : Nonlinearities)
  {
    EXPECT_EQ(ResponseShapeOf(NameOf(nonlinearity.shape)), nonlinearity.shape);
  }
  EXPECT_EQ(ResponseShapeOf("straight"), ResponseShape::Straight);
  EXPECT_EQ(ResponseShapeOf("quadratic"), ResponseShape::Quadratic);
  EXPECT_EQ(ResponseShapeOf("wave"), ResponseShape::Wave);
  EXPECT_EQ(ResponseShapeOf("shoulder"), ResponseShape::Shoulder);
  EXPECT_EQ(ResponseShapeOf("gamma"), ResponseShape::Gamma);
  EXPECT_EQ(ResponseShapeOf("s-curve"), ResponseShape::SCurve);
  EXPECT_THROW(ResponseShapeOf("bent"), std::invalid_argument);
}

TEST(SensorNoiseResponseCurve, BadSettingsAreRefused)
{
  EXPECT_EQ(ErrorOf({ ResponseShape::Straight, 77.0 }), "no error");
  EXPECT_EQ(ErrorOf({ ResponseShape::Quadratic, 1.0 }),
            "the non-linearity of the response is 1; expected above -1 and below 1");
  EXPECT_EQ(ErrorOf({ ResponseShape::Gamma, 0.0 }), "the exponent of the response is 0; expected 0.1 to 10");
  EXPECT_EQ(ErrorOf({ ResponseShape::SCurve, -0.1 }), "the weight of the response's s-curve is -0.1; expected 0 to 1");
  EXPECT_EQ(ErrorOf({ ResponseShape::Wave, 0.1, -3.0 }), "the full scale of the response is -3; expected 0 to 1e9");
}
