// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"
#include "sensornoise/Version.h"

#include <string>

namespace
{

/** Each program says its name and version. */
class VersionTool : public EstimateToolTest
{
protected:
  void
  SaysItsVersion(const std::string & program)
  {
    const std::string command = "\"" + ToolFolder() + "/" + program + "\" ";
    EXPECT_EQ(RunCommand(command + "--version"), 0);
    EXPECT_EQ(m_Output, program + " " + sensornoise::GetModuleVersion() + "\n");
    EXPECT_EQ(m_Message, "");
    EXPECT_EQ(RunCommand(command + "--help"), 0);
    EXPECT_NE(m_Output.find("--version"), std::string::npos) << m_Output;
    EXPECT_TRUE(FilesLeft().empty());
  }
};
} // namespace

TEST_F(VersionTool, EstimateSaysItsVersion)
{
  SaysItsVersion("estimate-sensor-noise");
}

TEST_F(VersionTool, SimulateSaysItsVersion)
{
  SaysItsVersion("simulate-sensor-noise");
}
