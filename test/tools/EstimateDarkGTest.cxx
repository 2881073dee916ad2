// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <cmath>
#include <set>
#include <string>

namespace
{

/** --offset and --dark. */
class EstimateDarkTool : public EstimateToolTest
{
protected:
  /** Makes dark frames of the camera of MakeBurst(): offset 100 DN, read noise 8 DN. */
  StackType::Pointer
  MakeDark(unsigned int frames, const std::string & size = "64x64")
  {
    EXPECT_EQ(RunCommand("\"" + ToolFolder() +
                         "/simulate-sensor-noise\" --output ../dark.mha --seed 8 --electrons 1e-9"
                         " --frames " +
                         std::to_string(frames) + " --size " + size),
              0)
      << m_Message;
    return Read<StackType>(m_Folder / "dark.mha");
  }

  /** Expects an identified quantity within 4 standard errors of the truth. */
  static void
  IsNear(const nlohmann::json & quantity, double truth)
  {
    ASSERT_EQ(quantity["status"], "identified");
    EXPECT_NEAR(quantity["value"], truth, 4.0 * quantity["standard_error"].get<double>());
  }
};
} // namespace

TEST_F(EstimateDarkTool, DarkFramesDetermineOffsetAndReadNoise)
{
  const std::string    stack = Write("s.mha", MakeBurst().GetPointer());
  const auto           dark = MakeDark(12);
  const std::string    text = JsonTextOf(stack + " --dark " + Write("d.mha", dark.GetPointer()));
  const nlohmann::json report = nlohmann::json::parse(text);
  IsNear(report["offset"], 100.0);
  IsNear(report["read_noise"], 8.0);
  // sigma / sqrt(N T) and sigma / sqrt(2 N (T - 1))
  EXPECT_NEAR(report["offset"]["standard_error"], 8.0 / std::sqrt(4096 * 12), 0.004);
  EXPECT_NEAR(report["read_noise"]["standard_error"], 8.0 / std::sqrt(2 * 4096 * 11), 0.003);
  EXPECT_EQ(report["settings"]["dark_frames"], 12);
  EXPECT_EQ(report["settings"]["offset"], report["offset"]["value"]);
  EXPECT_TRUE(report["settings"].contains("dark_variance"));

  // one file a frame, given together or one by one
  const auto names = WriteList<unsigned short>(dark, ".tif");
  EXPECT_EQ(JsonTextOf(stack + " --dark " + Joined(names)), text);
  std::string repeated;
  for (const std::string & name : names)
  {
    repeated += " --dark " + name;
  }
  EXPECT_EQ(JsonTextOf(stack + repeated), text);
}

TEST_F(EstimateDarkTool, OneDarkFrameDeterminesTheOffsetOnly)
{
  const std::string    stack = Write("s.mha", MakeBurst().GetPointer());
  const nlohmann::json report = ReportOf(stack + " --dark " + WriteList<unsigned short>(MakeDark(1), ".tif").front());
  IsNear(report["offset"], 100.0);
  EXPECT_EQ(report["settings"]["dark_frames"], 1);
  EXPECT_FALSE(report["settings"].contains("dark_variance"));
}

TEST_F(EstimateDarkTool, DarkFramesAreCutAsTheOthersByRoi)
{
  const auto burst = MakeBurst();
  const auto dark = MakeDark(12);
  Write("s.mha", burst.GetPointer());
  Write("d.mha", dark.GetPointer());
  Write("part.mha", Cut<unsigned short>(burst, { { 6, 4, 2 } }, { { 50, 56, 20 } }).GetPointer());
  Write("dpart.mha", Cut<unsigned short>(dark, { { 6, 4, 0 } }, { { 50, 56, 12 } }).GetPointer());
  EXPECT_EQ(MeasuredTextOf("s.mha --roi 6,4,50,56 --frames 2:22 --dark d.mha"),
            MeasuredTextOf("part.mha --dark dpart.mha"));
}

TEST_F(EstimateDarkTool, MapsHoldOffsetAndReadNoiseOfEachPixel)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  const auto        dark = MakeDark(12);
  Write("d.mha", dark.GetPointer());
  const std::set<std::string> maps{
    "s.mha", "d.mha", "m/mean.mha", "m/variance.mha", "m/corrected_variance.mha", "m/pixel_use.mha"
  };
  ReportOf(stack + " --maps m");
  EXPECT_EQ(FilesLeft(), maps);
  ReportOf(stack + " --maps m --dark " + WriteList<unsigned short>(MakeDark(1), ".tif").front());
  EXPECT_EQ(FilesLeft().count("m/pixel_offset.mha"), 0u) << "one frame tells no pixel's noise";
  ReportOf(stack + " --maps m --dark d.mha");
  for (const char * quantity : { "offset", "read_noise" })
  {
    const std::string name = std::string("m/pixel_") + quantity;
    const auto        value = Read<itk::Image<double, 2>>(Path(name + ".mha"));
    const auto        low = Read<itk::Image<double, 2>>(Path(name + "_low.mha"));
    const auto        high = Read<itk::Image<double, 2>>(Path(name + "_high.mha"));
    const double      truth = quantity == std::string("offset") ? 100.0 : 8.0;
    double            inside = 0.0;
    for (int i = 0; i < 64; ++i)
    {
      for (int j = 0; j < 64; ++j)
      {
        inside += low->GetPixel({ { i, j } }) < truth && truth < high->GetPixel({ { i, j } }) ? 1.0 / 4096.0 : 0.0;
        ASSERT_LT(low->GetPixel({ { i, j } }), value->GetPixel({ { i, j } }));
        ASSERT_GT(high->GetPixel({ { i, j } }), value->GetPixel({ { i, j } }));
      }
    }
    EXPECT_NEAR(inside, 0.95, 0.014) << quantity; // give or take 0.34 %
  }
}

TEST_F(EstimateDarkTool, MapsOfAnEarlierEstimateAreRemoved)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  Write("d.mha", MakeDark(12).GetPointer());
  const std::string one = WriteList<unsigned short>(MakeDark(1), ".tif").front();
  for (const std::string & later : { stack + " --maps m", stack + " --maps m --dark " + one })
  {
    ReportOf(stack + " --maps m --dark d.mha");
    ASSERT_EQ(FilesLeft().count("m/pixel_read_noise_high.mha"), 1u);
    ReportOf(later);
    EXPECT_EQ(FilesLeft().count("m/mean.mha"), 1u);
    for (const std::string & file : FilesLeft())
    {
      EXPECT_TRUE(file == "m/pixel_use.mha" || file.rfind("m/pixel_", 0) == std::string::npos) << file;
    }
  }
}

TEST_F(EstimateDarkTool, AnOffsetThatIsGivenStandsInsideItsLimits)
{
  const std::string    stack = Write("s.mha", MakeBurst().GetPointer());
  const nlohmann::json report = ReportOf(stack + " --offset 100,0.25");
  EXPECT_EQ(report["offset"]["value"], 100.0);
  EXPECT_EQ(report["offset"]["standard_error"], 0.25);
  EXPECT_EQ(report["settings"]["offset"], 100.0);
  EXPECT_EQ(report["settings"]["offset_standard_error"], 0.25);
  IsNear(report["read_noise"], 8.0);
  const nlohmann::json outside = ReportOf(stack + " --offset -3.5");
  EXPECT_EQ(outside["settings"]["offset"], -3.5);
  EXPECT_EQ(outside["offset"]["status"], "failed");
  EXPECT_EQ(ReportOf(stack + " --offset=100")["offset"]["standard_error"], 0.0);
}

TEST_F(EstimateDarkTool, NoFlickerIsNeeded)
{
  ASSERT_EQ(
    RunCommand("\"" + ToolFolder() + "/simulate-sensor-noise\" --output s.mha --flicker-sd 0 --size 96x96 --frames 30"),
    0);
  EXPECT_EQ(ReportOf("s.mha")["read_noise"]["status"], "not-identifiable");
  EXPECT_NE(m_Message.find("[offset-not-identifiable]"), std::string::npos) << m_Message;
  IsNear(ReportOf("s.mha --offset 100,0.1")["read_noise"], 8.0);
  EXPECT_EQ(m_Message, "");
}

TEST_F(EstimateDarkTool, WrongUseIsRefused)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  Write("d.mha", MakeDark(5).GetPointer());
  IsRefused(stack + " --offset 100 --dark d.mha", { "--offset", "--dark" });
  IsRefused(stack + " --offset 100 --method published", { "--offset", "published", "--method refined" });
  IsRefused(stack + " --dark d.mha --method published", { "--dark", "published", "--method refined" });
  IsRefused(stack + " --offset much", { "--offset", "much", "not a number" });
  IsRefused(stack + " --offset 1,2,3", { "--offset", "holds 3 numbers", "expected VALUE or VALUE,ERROR" });
  IsRefused(stack + " --offset 100,-1", { "100", "standard error of -1", "expected" });
  IsRefused(stack + " --dark nowhere.mha", { "nowhere.mha", "does not exist" });
  IsRefused("--dark d.mha s.mha",
            { "no FRAME is left: --dark takes all names behind it, here 2" }); // both are dark frames
  Write("wide.mha", MakeDark(5, "66x64").GetPointer());
  IsRefused(stack + " --dark wide.mha", { "the dark frames have 66 x 64 pixels", "wide.mha", "have 64 x 64 pixels" });
  Write("bytes.mha", Make<itk::Image<unsigned char, 3>>({ { 64, 64, 5 } }, 100).GetPointer());
  IsRefused(stack + " --dark bytes.mha", { "pixels of type unsigned char", "pixels of type unsigned short" });
  const auto names = WriteList<unsigned short>(MakeDark(2), ".tif");
  Write("other.tif", Make<itk::Image<unsigned short, 2>>({ { 64, 60 } }, 100).GetPointer());
  IsRefused(stack + " --dark " + Joined(names) + "other.tif", { "other.tif", "64 x 60 pixels", "the same size" });
  Write("black.mha", Make<StackType>({ { 64, 64, 5 } }, 0).GetPointer());
  IsRefused(stack + " --dark black.mha", { "dark frames reach a clip level", "black level is cut off" });
}
