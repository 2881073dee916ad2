// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ParallelWork.h"
#include "helpers/StackTestHelper.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;

TEST(ForAll, AllAreCalledAndTheFirstErrorInTheirOrderIsThrown)
{
  for (const ParallelFor & parallelFor : { ParallelFor(SerialFor), ParallelFor(test::Threads(3)) })
  {
    std::vector<int> calls(100, 0);
    const auto       call = [&calls](std::size_t k) {
      ++calls[k];
      if (k == 97 || k == 42)
      {
        throw std::runtime_error(std::to_string(k));
      }
    };
    std::string error;
    try
    {
      ForAll(calls.size(), parallelFor, call);
    }
    catch (const std::runtime_error & thrown)
    {
      error = thrown.what();
    }
    EXPECT_EQ(error, "42");
    EXPECT_EQ(calls, std::vector<int>(100, 1));
    EXPECT_NO_THROW(ForAll(42, parallelFor, call));
  }
}
