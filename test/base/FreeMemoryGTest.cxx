/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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
