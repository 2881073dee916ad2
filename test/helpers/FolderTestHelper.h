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
#ifndef sensornoise_test_FolderTestHelper_h
#define sensornoise_test_FolderTestHelper_h

#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <string>

namespace sensornoise::test
{

/** A test with an empty folder of its own, which goes with it. */
class FolderTest : public ::testing::Test
{
protected:
  void
  SetUp() override
  {
    const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    // two builds may be tested at the same time
    m_Folder =
      std::filesystem::path(::testing::TempDir()) / ("SensorNoise" + test + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(m_Folder);
  }
  void
  TearDown() override
  {
    std::filesystem::remove_all(m_Folder);
  }

  std::string
  Path(const std::string & name) const
  {
    return (m_Folder / name).string();
  }

  std::filesystem::path m_Folder;
};

} // namespace sensornoise::test

#endif
