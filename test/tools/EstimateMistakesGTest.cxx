// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <string>
#include <vector>

// Mistakes of users on the command line and in files: the message says what was found and what to do.

namespace
{
class EstimateMistakes : public EstimateToolTest
{
protected:
  /** Expects exit code 2 and a sentence with these parts. */
  void
  IsAnswered(const std::string & arguments, const std::vector<std::string> & parts)
  {
    SCOPED_TRACE(arguments);
    EXPECT_EQ(Run(arguments), 2);
    SaysInOneSentence(parts);
  }

  /** Returns the pixels of a stack, the lowest byte first. */
  static std::string
  BytesOf(const StackType * stack)
  {
    const auto  pixels = stack->GetLargestPossibleRegion().GetNumberOfPixels();
    std::string bytes;
    for (std::size_t i = 0; i < pixels; ++i)
    {
      bytes += static_cast<char>(stack->GetBufferPointer()[i] % 256);
      bytes += static_cast<char>(stack->GetBufferPointer()[i] / 256);
    }
    return bytes;
  }
};
} // namespace

TEST_F(EstimateMistakes, AnUnknownOptionIsAnsweredWithTheOneThatIsMeant)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  IsAnswered(stack + " --ofset 100", { "there is no option --ofset", "is --offset meant?", "--help" });
  IsAnswered(stack + " -json r.json", { "there is no option -json", "is --json meant?" });
  IsAnswered(stack + " --bayr=RGGB", { "is --bayer meant?" });
  IsAnswered(stack + " --sharpness 3", { "there is no option --sharpness; --help lists all options" });
}

TEST_F(EstimateMistakes, AnOptionIsNoFileName)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  IsAnswered(stack + " --json --quiet", { "--json: --quiet is an option", "expected a value: --json FILE" });
  IsAnswered(stack + " --plot --hash", { "--plot: --hash is an option" });
}

TEST_F(EstimateMistakes, AReportThatTakesTheStackIsNamed)
{
  Write("s.mha", MakeBurst().GetPointer());
  IsAnswered("--json s.mha",
             { "no FRAME is left: --json takes the name behind it, s.mha", "s.mha --json report.json" });
  WriteText("r.json", "{}");
  EXPECT_EQ(Run("--json r.json"), 2);
  EXPECT_NE(m_Message.find("no FRAME was given"), std::string::npos) << m_Message;
}

TEST_F(EstimateMistakes, FormsOfNumbersAreSaid)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  IsAnswered(stack + " --roi 0.1,0.1,0.5,0.5", { "is not a whole number", "expected X,Y,W,H in pixels" });
  IsAnswered(stack + " --roi 10%,10%,50%,50%", { "expected X,Y,W,H in pixels" });
  IsAnswered(stack + " --roi 50,50,40,40",
             { "--roi asks for 40 x 40 pixels from 50,50", "the stack has 64 x 64 pixels", "expected a part of it" });
  IsAnswered(stack + " --frames 0:100", { "--frames asks for frames 0 to 99", "24 frames, counted from 0" });
  IsAnswered(stack + " --offset 100+-1", { "expected VALUE or VALUE,ERROR" });
  IsAnswered(stack + " --clip 4095,0", { "--clip: the clip levels are 4095 and 0 DN", "low < high" });
  IsAnswered(stack + " --memory-limit 4", { "the memory limit is 4 bytes" });
  for (const std::string size : { "-1", "4Q", "4.5G", "99999999999G", "G" })
  {
    IsAnswered(stack + " --memory-limit " + size, { "--memory-limit: it is \"" + size, "for example 4G" });
  }
  for (const std::string option : { "--channel", "--plane" })
  {
    IsAnswered(stack + " " + option + " -1", { option + ": it is \"-1\"; expected a whole number of 0 or more" });
  }
}

TEST_F(EstimateMistakes, AThumbnailAmongFramesAndAnEmptyFileAreNamed)
{
  using FrameType = itk::Image<unsigned short, 2>;
  std::filesystem::create_directory(Path("frames"));
  const auto burst = MakeBurst(6);
  for (const std::string & name : WriteList<unsigned short>(burst, ".tif"))
  {
    std::filesystem::rename(Path(name), Path("frames/" + name));
  }
  WriteText("frames/frame_103b.tif", "");
  EXPECT_NE(Run("frames"), 2) << m_Message;
  EXPECT_NE(m_Message.find("note: frames: 1 of 7 files is no image and is left out, frames/frame_103b.tif\n"),
            std::string::npos)
    << m_Message;
  WriteText("frames/frame_102b.txt", "a note");
  EXPECT_NE(Run("frames"), 2) << m_Message;
  EXPECT_NE(m_Message.find("2 of 8 files are no images and are left out, the first frames/frame_102b.txt by name\n"),
            std::string::npos)
    << m_Message;
  Write("frames/thumbnail.tif", Make<FrameType>({ { 16, 16 } }, 7).GetPointer());
  EXPECT_EQ(Run("frames"), 2);
  EXPECT_NE(m_Message.find("frames/thumbnail.tif: 16 x 16 pixels, but frames/frame_100.tif has 64 x 64"),
            std::string::npos)
    << m_Message;
  EXPECT_NE(m_Message.find("Leave the file out, or name the frames by a pattern, 'frame_*.tif'"), std::string::npos);
}

TEST_F(EstimateMistakes, MapsGoToAFolder)
{
  Write("s.mha", MakeBurst().GetPointer());
  WriteText("maps", "a file");
  IsAnswered("s.mha --maps maps", { "cannot write maps to maps (--maps): maps is a file; expected a folder" });
  IsAnswered("s.mha --maps maps/of/today", { "maps is a file; expected a folder" });
}

TEST_F(EstimateMistakes, ATruncatedFileIsCopiedAgain)
{
  const std::vector<std::string> names = WriteList<unsigned short>(MakeBurst(6), ".tif");
  std::filesystem::resize_file(Path(names[3]), 4000);
  IsAnswered(Joined(names), { names[3] + ": ", "truncated", "Copy the file again, or leave it out" });
}

TEST_F(EstimateMistakes, EmptyNamesAndFoldersAreNamed)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  IsAnswered(stack + " \"$unset\"", { "the name of a file is empty" });
  IsAnswered(stack + " --json \"$unset\"", { "--json: its value is empty", "expected --json FILE" });
  std::filesystem::create_directories(Path("day/burst"));
  IsAnswered("day", { "day: there is no file in this folder, and folders in it are not searched" });
}

TEST_F(EstimateMistakes, AFrameIsNoDarkFrame)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  Run(stack + " --dark ./s.mha");
  EXPECT_NE(m_Message.find("warning: ./s.mha is given as a frame and as a dark frame (--dark)"), std::string::npos)
    << m_Message;
}

TEST_F(EstimateMistakes, ExchangedDarkFramesAreAskedFor)
{
  Write("bright.mha", MakeBurst().GetPointer());
  ASSERT_EQ(RunCommand("\"" + ToolFolder() + "/simulate-sensor-noise\" --dark --size 64x64 --frames 24 --output d.mha"),
            0);
  EXPECT_EQ(Run("d.mha --dark bright.mha"), 3);
  EXPECT_NE(m_Message.find("The dark frames are brighter than the frames, with "), std::string::npos) << m_Message;
  EXPECT_NE(m_Message.find("Check whether they are exchanged"), std::string::npos) << m_Message;
}

TEST_F(EstimateMistakes, SwappedBytesAreNamed)
{
  WriteText("a.raw", BytesOf(MakeBurst()));
  EXPECT_EQ(Run("--raw 64x64:uint16be a.raw"), 3);
  EXPECT_NE(m_Message.find("warning: a.raw: its bytes look swapped"), std::string::npos) << m_Message;
  EXPECT_NE(m_Message.find("Use the type uint16le: --raw 64x64:uint16le"), std::string::npos) << m_Message;
  EXPECT_EQ(Run("--raw 64x64:uint16le a.raw"), 0) << m_Message;
  EXPECT_EQ(m_Message, "");
}

TEST_F(EstimateMistakes, NamesWithSpacesAndUmlautsAreNamesAsOthers)
{
  std::filesystem::create_directory(Path("s\u00fc\u00df ordner"));
  Write("s\u00fc\u00df ordner/b 1.mha", MakeBurst().GetPointer());
  EXPECT_EQ(Run("\"s\u00fc\u00df ordner/b 1.mha\" --json \"r \u00fc.json\" --plot \"p \u00fc.html\""), 0) << m_Message;
  EXPECT_EQ(FilesLeft().count("r \u00fc.json"), 1U);
  EXPECT_EQ(FilesLeft().count("p \u00fc.html"), 1U);
  EXPECT_EQ(Run("'s\u00fc\u00df*/*.mha' --quiet"), 0) << m_Message;
}

TEST_F(EstimateMistakes, StandardOutputThatIsFullIsAnswered)
{
  if (!std::filesystem::exists("/dev/full"))
  {
    GTEST_SKIP() << "no /dev/full";
  }
  Write("s.mha", MakeBurst().GetPointer());
  EXPECT_EQ(Run("s.mha > /dev/full"), 2);
  EXPECT_NE(m_Message.find("standard output: it is full or closed. Write a file: --json FILE"), std::string::npos)
    << m_Message;
}
