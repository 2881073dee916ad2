// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackFrames.h"
#include "sensornoise/FrameGeometry.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

using namespace sensornoise;

TEST(SensorNoiseStackRequirements, NoMoreFramesThanHaveExactSums)
{
  const FrameGeometry geometry{ 3, 3, 1 };
  EXPECT_NO_THROW(RequireStack(geometry, MaximumFrames, 0));
  try
  {
    RequireStack(geometry, MaximumFrames + 1, 0);
    FAIL();
  }
  catch (const std::invalid_argument & error)
  {
    EXPECT_EQ(std::string(error.what()),
              "the stack has 4194305 frames; expected at most 4194304. Measure a part of them: --frames");
  }
}
