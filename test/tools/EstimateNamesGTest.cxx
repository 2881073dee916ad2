// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

// Names on the command line: frames and dark frames, folders, patterns, help.

namespace
{

class EstimateNamesTool : public EstimateToolTest
{
protected:
  /** Writes the burst into the folder `frames`, in which the order of text differs from the order of time. */
  std::string
  WriteFolder()
  {
    const auto  burst = MakeBurst();
    const auto  names = WriteList<unsigned short>(burst, ".tif");
    std::size_t number = 1;
    std::filesystem::create_directory(Path("frames"));
    for (const std::string & name : names)
    {
      std::filesystem::rename(Path(name), Path("frames/f" + std::to_string(number++) + ".tif"));
    }
    return Write("s.mha", burst.GetPointer());
  }

  /** Lines of --help at a width of the terminal. */
  std::vector<std::string>
  LinesOfHelp(const std::string & program, const std::string & width)
  {
    EXPECT_EQ(RunCommand("COLUMNS=" + width + " \"" + ToolFolder() + "/" + program + "\" --help"), 0);
    std::vector<std::string> lines;
    std::istringstream       text(m_Output);
    for (std::string line; std::getline(text, line);)
    {
      lines.push_back(line);
    }
    return lines;
  }
};

TEST_F(EstimateNamesTool, AFolderAndAPatternAreReadInTheOrderOfNumbers)
{
  const std::string expected = JsonTextOf(WriteFolder());
  EXPECT_EQ(JsonTextOf("frames"), expected);
  EXPECT_EQ(JsonTextOf("'frames/f*.tif'"), expected);
  EXPECT_EQ(m_Message, "");
  WriteText("frames/notes.txt", "a note");
  WriteText("frames/.hidden", "a note");
  EXPECT_EQ(JsonTextOf("frames"), expected);
  EXPECT_NE(m_Message.find("note: frames: 1 of 25 files is no image and is left out, frames/"), std::string::npos)
    << m_Message;
  // what the shell makes of the pattern stays as it is, with a note
  EXPECT_NE(JsonTextOf("frames/f*.tif"), expected);
  EXPECT_NE(m_Message.find("note: frames/f2.tif is read after frames/f19.tif, as the shell sorts names as text"),
            std::string::npos)
    << m_Message;
  IsRefused("'frames/*.png'", { "frames/*.png: no file matches this pattern" });
  std::filesystem::create_directory(Path("none"));
  WriteText("none/notes.txt", "a note");
  IsRefused("none", { "none: none of the 1 files in this folder is an image; expected camera raw, TIFF" });
}

TEST_F(EstimateNamesTool, DarkTakesAFolderAndAPattern)
{
  const std::string stack = WriteFolder();
  ASSERT_EQ(
    RunCommand("\"" + ToolFolder() + "/simulate-sensor-noise\" --output dark.mha --dark --size 64x64 --frames 12"), 0)
    << m_Message;
  const std::string expected = JsonTextOf(stack + " --dark dark.mha");
  EXPECT_NE(expected.find("dark"), std::string::npos);
  const auto names = WriteList<unsigned short>(Read<StackType>(Path("dark.mha")), ".tif");
  std::filesystem::create_directory(Path("darks"));
  for (const std::string & name : names)
  {
    std::filesystem::rename(Path(name), Path("darks/" + name));
  }
  EXPECT_EQ(JsonTextOf(stack + " --dark darks"), expected);
  EXPECT_EQ(JsonTextOf(stack + " --dark 'darks/*.tif'"), expected);
  EXPECT_EQ(JsonTextOf("--dark 'darks/*.tif' -- " + stack), expected);
}

TEST_F(EstimateNamesTool, ALostFrameIsExplained)
{
  IsRefused("--dark d.mha f.mha",
            { "no FRAME is left: --dark takes all names behind it, here 2. Write the frames first: ",
              "estimate-sensor-noise FRAMES --dark DARKS",
              "--dark DARKS -- FRAMES" });
  IsRefused("--check g.mha", { "no FRAME is left: --check takes all names behind it, here 1" });
  IsRefused("--quiet", { "no FRAME was given; expected image files, a folder or a stack" });
}

TEST_F(EstimateNamesTool, HelpHasAnExampleFirstAndGroups)
{
  const std::vector<std::string> lines = LinesOfHelp("estimate-sensor-noise", "80");
  ASSERT_GT(lines.size(), 10u);
  EXPECT_EQ(lines[0], "Example:");
  EXPECT_EQ(lines[1].rfind("  estimate-sensor-noise frame_*.tif --dark", 0), 0u) << lines[1];
  EXPECT_NE(m_Output.find("\nUsage: estimate-sensor-noise FRAME... [OPTIONS]\n"), std::string::npos) << m_Output;
  std::size_t at = 0;
  for (const char * const group : { "Input", "Sensor", "Output", "Checks", "Other" })
  {
    const std::size_t found = m_Output.find("\n" + std::string(group) + ":\n");
    ASSERT_NE(found, std::string::npos) << group;
    EXPECT_GT(found, at) << group;
    at = found;
  }
  EXPECT_GT(m_Output.find("--threads"), at);
  EXPECT_EQ(m_Output.find("TEXT"), std::string::npos);
  EXPECT_EQ(m_Output.find("\n\n\n"), std::string::npos);
}

TEST_F(EstimateNamesTool, HelpIsWrappedAtTheWidthOfTheTerminal)
{
  for (const std::string width : { "60", "80", "132" })
  {
    for (const std::string program : { "estimate-sensor-noise", "simulate-sensor-noise" })
    {
      std::size_t longest = 0;
      for (const std::string & line : LinesOfHelp(program, width))
      {
        longest = std::max(longest, line.size());
        EXPECT_TRUE(line.size() <= std::stoul(width) || line.find("  estimate-sensor-noise") == 0) << line;
      }
      EXPECT_GT(longest, std::stoul(width) * 3 / 4) << width;
      EXPECT_EQ(m_Output.find(ToolFolder()), std::string::npos);
    }
  }
}
} // namespace
