// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Quadrature.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace sensornoise;

TEST(SensorNoiseQuadrature, IsTheRootOfTheSquares)
{
  EXPECT_DOUBLE_EQ(AddInQuadrature(2.0, -3.0, 6.0), 7.0);
  EXPECT_EQ(AddInQuadrature(0.0, 0.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(AddInQuadrature(2e200, 3e200, 6e200), 7e200);
}

TEST(SensorNoiseQuadrature, AnErrorThatIsNotKnownStaysSo)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(AddInQuadrature(infinity, 1.0, 0.0), infinity);
  EXPECT_EQ(AddInQuadrature(1.0, -infinity, 0.0), infinity);
  EXPECT_EQ(AddInQuadrature(1.0, 0.0, infinity), infinity);
  EXPECT_TRUE(std::isnan(AddInQuadrature(1.0, 0.0, std::nan(""))));
}
