// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
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
