// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/FreeMemory.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

using namespace sensornoise;

TEST(FreeMemory, BytesAsPeopleReadThem)
{
  EXPECT_EQ(TextOfBytes(5e5), "0.5 MB");
  EXPECT_EQ(TextOfBytes(2.436e9), "2.44 GB");
  EXPECT_EQ(TextOfBytes(1.6e12), "1.6 TB");
  EXPECT_EQ(TextOfBytes(3e20), "3e+05 PB");
}

TEST(FreeMemory, MoreThanThereIsIsRefused)
{
  EXPECT_NO_THROW(RequireMemory(1.0, "a byte"));
  if (!FreeMemoryBytes())
  {
    GTEST_SKIP() << "this system does not tell";
  }
  EXPECT_GT(*FreeMemoryBytes(), 1e6);
  try
  {
    RequireMemory(1e18, "the test");
    FAIL();
  }
  catch (const std::runtime_error & error)
  {
    EXPECT_EQ(std::string(error.what()).rfind("the test needs 1e+03 PB of memory, but ", 0), 0u) << error.what();
  }
}
