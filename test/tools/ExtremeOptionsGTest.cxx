// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace
{

/** Options with values that nobody means: each run ends with 0, 2 or 3 and no more than one sentence. */
class ExtremeOptionsTool : public EstimateToolTest
{
protected:
  void
  EndsWell(const std::string & command)
  {
    SCOPED_TRACE(command);
    const int code = RunCommand(command);
    EXPECT_TRUE(code == 0 || code == 2 || code == 3) << code << m_Message;
    const std::string & all = m_Message;
    if (code != 2) // an error says what was found
    {
      EXPECT_EQ((m_Output + all).find("nan"), std::string::npos) << m_Output << all;
    }
    for (const char * words : { "bad_alloc", "max_size", "filesystem error", "std::", "inf DN", "00000000" })
    {
      EXPECT_EQ(all.find(words), std::string::npos) << all;
    }
    std::istringstream lines(all);
    std::size_t        sentences = 0;
    for (std::string line; std::getline(lines, line);)
    {
      sentences += line.rfind("warning: ", 0) != 0 && line.rfind("note: ", 0) != 0 ? 1 : 0;
    }
    EXPECT_EQ(sentences, code == 0 ? 0u : 1u) << all;
  }
};
} // namespace

TEST_F(ExtremeOptionsTool, OffsetsOutsideTheLevelsAreRefused)
{
  Write("s.mha", MakeBurst().GetPointer());
  IsRefused("s.mha --offset 1e308", { "the offset is 1e+308 DN", "65536" });
  IsRefused("s.mha --offset=-1e9", { "the offset is -1e+09 DN", "65536" });
  IsRefused("s.mha --offset 100,1e308", { "standard error of 1e+308 DN" });
  const auto floats = Make<itk::Image<float, 3>>({ { 64, 64, 24 } }, 0.0F);
  const auto integers = Read<StackType>(Path("s.mha"));
  std::copy(integers->GetBufferPointer(), integers->GetBufferPointer() + 64 * 64 * 24, floats->GetBufferPointer());
  Write("f.mha", floats.GetPointer());
  IsRefused("f.mha --offset 1e308", { "the offset is 1e+308 DN", "1000 times the largest level" });
  EXPECT_EQ(Run("f.mha --quiet --offset 100"), 0) << m_Message;
}

TEST_F(ExtremeOptionsTool, MemoryLimitsHaveUnitsAndChangeNoNumber)
{
  Write("s.mha", MakeBurst().GetPointer());
  ASSERT_EQ(Run("s.mha --quiet --json -"), 0) << m_Message;
  const std::string expected = m_Output;
  for (const char * limit : { "100M", "1G", "96Mi", "100000000" })
  {
    EXPECT_EQ(Run(std::string("s.mha --quiet --json - --memory-limit ") + limit), 0) << limit << m_Message;
    EXPECT_EQ(m_Output, expected) << limit;
  }
  IsRefused("s.mha --memory-limit 1M", { "the memory limit is 1 MB; expected at least" });
}

TEST_F(ExtremeOptionsTool, EveryOptionOfTheEstimate)
{
  Write("s.mha", MakeBurst(6, "48x48").GetPointer());
  const std::string tool = "\"" + ToolFolder() + "/estimate-sensor-noise\" s.mha --quiet --json - ";
  for (const char * option : { "bit-depth", "step", "rolling-shutter", "offset", "threads", "memory-limit" })
  {
    for (const char * value : { "0", "-1", "1e308", "-1e308", "1e-308", "nan", "inf", "9223372036854775808", "''" })
    {
      EndsWell(tool + "--" + option + "=" + value);
    }
  }
  for (const char * option : { "clip", "level-range", "offset" })
  {
    for (const char * value : { "0,0", "0,1e308", "-1e308,1e308", "0,1e30", "nan,nan", "1e308,1e308", "5,", "," })
    {
      EndsWell(tool + "--" + option + "=" + value);
    }
  }
  for (const char * value : { "0,0,0,0", "0,0,9223372036854775807,1", "9223372036854775807,0,1,1", "0,0,1e308,1" })
  {
    EndsWell(tool + "--roi=" + value);
  }
  for (const char * value : { "0:9223372036854775807", "9223372036854775800:9223372036854775807", "5:4", "-1:4", ":" })
  {
    EndsWell(tool + "--frames=" + value);
  }
  for (const char * value : { "1e9", "1e308", "1e-308" })
  {
    EndsWell(tool + "--method published --rolling-shutter " + value);
  }
}

TEST_F(ExtremeOptionsTool, EveryOptionOfTheSimulator)
{
  const std::string tool = "\"" + ToolFolder() + "/simulate-sensor-noise\" --output o.mha --size 33x32 --frames 3 ";
  for (const char * option : { "gain",
                               "offset",
                               "read-noise",
                               "electrons",
                               "flicker-sd",
                               "optical-blur",
                               "rolling-shutter",
                               "prnu",
                               "dsnu",
                               "gain-pattern",
                               "column-offset-pattern",
                               "brighter-fatter",
                               "coupling",
                               "row-noise",
                               "defect-correction" })
  {
    for (const char * value : { "-1e308", "1e308", "1e-308", "nan", "1e9" })
    {
      EndsWell(tool + "--truth t.json --" + option + "=" + value + " && cat t.json");
    }
    EXPECT_EQ(RunCommand(tool + "--" + option + "=1e308"), 2) << option; // no unit makes sense of it
  }
  for (const char * value : { "nan,nan", "0,1e308", "1e308,1e308" })
  {
    EndsWell(tool + "--vibration-sd=" + value);
    EndsWell(tool + "--banding=" + value);
    EndsWell(tool + "--clip=" + value);
  }
}

TEST_F(ExtremeOptionsTool, WhatCannotBeHeldIsKnownBefore)
{
  const auto isRefused = [this](const std::string & command, const std::vector<std::string> & parts) {
    SCOPED_TRACE(command);
    EXPECT_EQ(RunCommand(command), 2);
    EXPECT_EQ(std::count(m_Message.begin(), m_Message.end(), '\n'), 1) << m_Message;
    for (const std::string & part : parts)
    {
      EXPECT_NE(m_Message.find(part), std::string::npos) << m_Message;
    }
  };
  const std::string simulator = "\"" + ToolFolder() + "/simulate-sensor-noise\" ";
  isRefused(simulator + "--output o.mha --size 99999x99999",
            { "99999 x 99999 pixels needs 160 GB of memory", "are free" });
  isRefused(simulator + "--output o.mha --frames 4294967295", { "4294967295 frames", "needs", "of memory" });
  isRefused(simulator + "--output o.mha --size 9999x999 --frames 1000000",
            { "cannot write o.mha", "free on the disk" });
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) // AddressSanitizer takes terabytes of addresses
  isRefused("ulimit -v 1000000; " + simulator + "--output o.nrrd --size 2048x2048 --frames 200",
            { "not written in parts", "needs 1.68 GB of memory" });
  Write("s.nrrd", Make<itk::Image<unsigned char, 3>>({ { 2048, 2048, 6 } }, 7).GetPointer());
  isRefused("ulimit -v 330000; \"" + ToolFolder() + "/estimate-sensor-noise\" s.nrrd --threads 1",
            { "2048 x 2048 pixels needs 235 MB of memory" });
#endif
}
