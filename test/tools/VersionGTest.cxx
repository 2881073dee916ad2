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
#include "helpers/EstimateToolTestHelper.h"
#include "sensornoise/report/Version.h"

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
    const std::string command = "\"" SENSORNOISE_BIN "/" + program + "\" ";
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
