// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ParallelWork.h"
#include "helpers/StackTestHelper.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

TEST(FirstTouch, AMapHasTheValueEverywhere)
{
  for (const std::size_t count : { 0, 1, 4096, 100003 })
  {
    EXPECT_EQ(MakeMap<double>(count, test::Threads(3)), std::vector<double>(count, 0.0));
    EXPECT_EQ(MakeMap<short>(count, test::Threads(3), -7), std::vector<short>(count, -7));
  }
}
