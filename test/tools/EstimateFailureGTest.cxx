// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include "itkVersion.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

/** Stacks from which nothing can be estimated, wrong use, and output that cannot be written. */
class EstimateFailureTool : public EstimateToolTest
{};
} // namespace

TEST_F(EstimateFailureTool, ClippedPixelsGiveNoEstimate)
{
  for (const unsigned short level : { std::uint16_t{ 0 }, std::uint16_t{ 4095 } })
  {
    Write("s.mha", Make<StackType>({ { 32, 32, 20 } }, level).GetPointer());
    GivesNoEstimate("s.mha --bit-depth 12", { "only 0 pixels", "clip", "expected at least" });
    GivesNoEstimate("s.mha --bit-depth 12 --method published", { "only 0 pixels", "clip", "expected at least" });
  }
  Write("s.mha", MakeBurst().GetPointer());
  GivesNoEstimate("s.mha --clip 0,1", { "only 0 pixels", "clip", "expected at least" });
}

TEST_F(EstimateFailureTool, AConstantStackGivesNoEstimate)
{
  for (const std::string name : { "s.mha", "s.nrrd", "s.tif" })
  {
    const auto stack = Make<StackType>({ { 32, 32, 20 } }, 700);
    GivesNoEstimate(Write(name, stack.GetPointer()),
                    { "counted once", "only 1 distinct frame is left", "expected at least 5" });
    for (unsigned short t = 0; t < 20; ++t)
    {
      stack->SetPixel({ { 0, 0, t } }, 700 + t); // a pixel at the border distinguishes the frames
    }
    GivesNoEstimate(Write(name, stack.GetPointer()), { "only 0 pixels", "expected at least" });
  }
}

TEST_F(EstimateFailureTool, TheSameFrameTwelveTimesGivesNoEstimate)
{
  const std::string name = WriteList<unsigned short>(MakeBurst(1), ".tif").front();
  GivesNoEstimate(Joined(std::vector<std::string>(12, name)),
                  { "counted once", "only 1 distinct frame is left", "expected at least 5" });
}

TEST_F(EstimateFailureTool, PixelsThatAreAllNaNGiveNoEstimate)
{
  using FloatStack = itk::Image<float, 3>;
  const auto nan = Make<FloatStack>({ { 32, 32, 20 } }, std::numeric_limits<float>::quiet_NaN());
  GivesNoEstimate(Write("s.mha", nan.GetPointer()), { "only 0 pixels", "expected at least" });
  const nlohmann::json report = ReportOf("s.mha", 3);
  EXPECT_EQ(report["pixels"]["not_finite"], 32 * 32);
}

TEST_F(EstimateFailureTool, OneIntensityGivesNoEstimate)
{
  const auto      stack = Make<StackType>({ { 48, 48, 20 } }, 0);
  std::mt19937_64 random(1);
  std::for_each(stack->GetBufferPointer(), stack->GetBufferPointer() + 48 * 48 * 20, [&random](unsigned short & pixel) {
    pixel = static_cast<unsigned short>(1000 + random() % 64);
  });
  GivesNoEstimate(Write("s.mha", stack.GetPointer()), {});
  GivesNoEstimate("s.mha --method published", { "the even areas span", "expected more than", "dark and bright" });
}

TEST_F(EstimateFailureTool, QuantizationThatHidesTheNoiseGivesNoEstimate)
{
  const auto stack = MakeBurst();
  std::for_each(stack->GetBufferPointer(), stack->GetBufferPointer() + 64 * 64 * 24, [](unsigned short & pixel) {
    pixel = static_cast<unsigned short>(pixel / 128 * 128);
  });
  GivesNoEstimate(Write("s.mha", stack.GetPointer()), { "quantization step of 128 DN", "Use more bits" });
}

TEST_F(EstimateFailureTool, AReportWithoutAnEstimateIsWrittenWhole)
{
  Write("s.mha", Make<StackType>({ { 32, 32, 20 } }, 700).GetPointer());
  EXPECT_EQ(Run("s.mha --json r.json"), 3);
  EXPECT_EQ(nlohmann::json::parse(ReadText(Path("r.json")))["gain"]["status"], "failed");
  EXPECT_NE(m_Output.find("20 frames (1 different) of 32 x 32 pixels"), std::string::npos);
}

TEST_F(EstimateFailureTool, UnknownAndMalformedOptionsAreRefused)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  IsRefused(stack + " --colour red", { "--colour" });
  IsRefused(stack + " --bayer RGBW", { "--bayer" });
  IsRefused(stack + " --method best", { "--method", "best", "refined", "published" });
  IsRefused(stack + " --bit-depth 17", { "--bit-depth", "17", "1 to 16" });
  IsRefused(stack + " --bit-depth many", { "--bit-depth", "many" });
  IsRefused(stack + " --clip 100", { "--clip", "holds 1 number;", "expected LOW,HIGH" });
  IsRefused(stack + " --clip 100,50", { "--clip", "100 and 50 DN", "expected low < high" });
  IsRefused(stack + " --step 0", { "--step", "the quantization step is 0 DN", "positive number" });
  IsRefused(stack + " --rolling-shutter never", { "--rolling-shutter", "never" });
  IsRefused(stack + " --rolling-shutter 8",
            { "--rolling-shutter: it is 8", "method refined", "expected auto or off, or --method published" });
  IsRefused(stack + " --rolling-shutter 0", { "--rolling-shutter", "0 rows", "positive number" });
  IsRefused(stack + " --threads 0", { "--threads", "0", "1 to 1024" });
  IsRefused(stack + " --threads", { "--threads" });
}

TEST_F(EstimateFailureTool, RoiAndFramesOutsideTheStackAreRefused)
{
  const auto        burst = MakeBurst();
  const std::string stack = Write("s.mha", burst.GetPointer());
  const std::string list = Joined(WriteList<unsigned short>(burst, ".tif"));
  for (const std::string & input : { stack, list })
  {
    IsRefused(input + " --roi 40,0,25,10", { "25 x 10 pixels from 40,0", "64 x 64 pixels" });
    IsRefused(input + " --frames 10:25", { "--frames", "24" });
  }
  IsRefused(stack + " --roi 0,0,10", { "--roi", "holds 3 numbers", "expected X,Y,W,H in pixels" });
  IsRefused(stack + " --roi 0,0,10,x", { "--roi", "\"x\"", "not a whole number" });
  IsRefused(stack + " --roi 0,0,0,10", { "--roi", "0,0,0,10", "no pixels" });
  IsRefused(stack + " --roi=-1,0,10,10", { "--roi", "negative corner" });
  IsRefused(stack + " --frames 7", { "--frames", "holds 1 number;", "expected A:B" });
  IsRefused(stack + " --frames 7:7", { "--frames", "7:7 holds no frame" });
  IsRefused(stack + " --frames 3:7", { "the stack has 4 frames", "expected at least 5" });
}

TEST_F(EstimateFailureTool, OutputThatCannotBeWrittenIsNoticedBeforeTheWorkBegins)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  const auto        isRefused = [&](const std::string & options, const std::vector<std::string> & parts) {
    EXPECT_EQ(Run(stack + options), 2) << m_Message;
    SaysInOneSentence(parts);
    EXPECT_EQ(m_Output, "");
    EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha" }));
  };
  isRefused(" --json nowhere/r.json", { "cannot write nowhere/r.json", "no folder nowhere" });
  isRefused(" --maps s.mha", { "cannot write maps to s.mha", "s.mha is a file; expected a folder" });
  std::filesystem::create_directories(Path("r.json"));
  isRefused(" --json r.json", { "cannot write r.json", "it is a folder" });
}

#ifndef _WIN32
TEST_F(EstimateFailureTool, AFullDiskLeavesNothing)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  // No file may grow beyond a few kilobytes, and the shell's signal for that is ignored: writing fails as on a full
  // disk.
  const std::string tool = "trap '' XFSZ; ulimit -f 16; \"" + ToolFolder() + "/estimate-sensor-noise\" s.mha --quiet ";
  EXPECT_EQ(RunCommand(tool + "--json r.json"), 2);
  SaysInOneSentence({ "cannot write r.json" });
  EXPECT_EQ(RunCommand(tool + "--maps maps"), 2);
  // ITK 5 does not notice it, ITK 6 does.
  const std::string reason = ITK_VERSION_MAJOR < 6 ? "the disk may be full" : "File cannot be written";
  EXPECT_NE(m_Message.find("cannot write maps/mean.mha: " + reason), std::string::npos) << m_Message;
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha" }));
}

TEST_F(EstimateFailureTool, StandardOutputThatIsFullIsAnError)
{
  if (!std::filesystem::exists("/dev/full"))
  {
    GTEST_SKIP() << "there is no /dev/full here";
  }
  Write("s.mha", MakeBurst().GetPointer());
  EXPECT_EQ(RunCommand("\"" + ToolFolder() + "/estimate-sensor-noise\" s.mha --quiet --json - > /dev/full"), 2);
  SaysInOneSentence({ "cannot write", "standard output" });
}
#endif
