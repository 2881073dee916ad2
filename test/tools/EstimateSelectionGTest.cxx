// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace
{

/** Which frames and pixels are used: lists and stacks, --frames, --roi, --mask. */
class EstimateSelectionTool : public EstimateToolTest
{
protected:
  using MaskType = itk::Image<unsigned char, 2>;

  /** 0 in a block of columns, a different nonzero value in each row elsewhere. */
  static MaskType::Pointer
  MakeMask()
  {
    const auto mask = Make<MaskType>({ { 64, 64 } }, 0);
    for (int y = 0; y < 64; ++y)
    {
      for (int x = 0; x < 64; ++x)
      {
        mask->SetPixel({ { x, y } }, static_cast<unsigned char>(x >= 20 && x < 30 ? 0 : y + 1));
      }
    }
    return mask;
  }
};
} // namespace

TEST_F(EstimateSelectionTool, AListOfFramesGivesTheReportOfTheStackBitForBit)
{
  const auto        burst = MakeBurst();
  const std::string expected = JsonTextOf(Write("s.mha", burst.GetPointer()));
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    EXPECT_EQ(JsonTextOf(Joined(WriteList<unsigned short>(burst, extension))), expected) << extension;
  }
  for (const std::string name : { "s.tif", "s.nrrd", "s.mhd" })
  {
    EXPECT_EQ(JsonTextOf(Write(name, burst.GetPointer())), expected) << name;
  }
}

TEST_F(EstimateSelectionTool, EveryPixelTypeIsRead)
{
  const auto burst = MakeBurst();
  const auto pixels = burst->GetLargestPossibleRegion().GetNumberOfPixels();
  const auto gainAs = [&](auto zero, double scale) {
    using TypedStack = itk::Image<decltype(zero), 3>;
    const auto typed = Make<TypedStack>(burst->GetLargestPossibleRegion().GetSize(), zero);
    std::transform(burst->GetBufferPointer(),
                   burst->GetBufferPointer() + pixels,
                   typed->GetBufferPointer(),
                   [scale](double value) { return static_cast<decltype(zero)>(value * scale); });
    return ReportOf(Write("typed.mha", typed.GetPointer()))["gain"]["value"].template get<double>();
  };
  const double gain = ReportOf(Write("s.mha", burst.GetPointer()))["gain"]["value"];
  // the same integers, summed in another way
  EXPECT_NEAR(gainAs(short{}, 1.0), gain, 1e-9);
  // integers have some maps in single precision, with an error of 6e-8 of each number
  EXPECT_NEAR(gainAs(float{}, 1.0), gain, 1e-7);
  EXPECT_NEAR(gainAs(double{}, 1.0), gain, 1e-7);
  // a quantization step of 16 DN adds 1/12 of its square to each variance, which changes the intercept only
  EXPECT_NEAR(gainAs(static_cast<unsigned char>(0), 1.0 / 16.0), gain / 16.0, 0.05 / 16.0);
}

TEST_F(EstimateSelectionTool, FramesAreCutOutOfAStackAndAList)
{
  const auto        burst = MakeBurst(30);
  const auto        part = Cut<unsigned short>(burst, { { 0, 0, 3 } }, { { 64, 64, 22 } });
  const std::string expected = MeasuredTextOf(Write("part.mha", part.GetPointer()));
  for (const std::string name : { "s.mha", "s.tif", "s.nrrd" })
  {
    EXPECT_EQ(MeasuredTextOf(Write(name, burst.GetPointer()) + " --frames 3:25"), expected) << name;
  }
  EXPECT_EQ(MeasuredTextOf(Joined(WriteList<unsigned short>(burst, ".tif")) + "--frames 3:25"), expected);
}

TEST_F(EstimateSelectionTool, SeveralStacksAreOneBurst)
{
  const auto        burst = MakeBurst(30);
  const std::string expected = JsonTextOf(Write("whole.mha", burst.GetPointer()));
  const std::string cut = JsonTextOf("whole.mha --frames 3:25");
  for (const std::string extension : { ".mha", ".tif", ".nrrd" })
  {
    const auto        first = Cut<unsigned short>(burst, { { 0, 0, 0 } }, { { 64, 64, 14 } });
    const auto        second = Cut<unsigned short>(burst, { { 0, 0, 14 } }, { { 64, 64, 16 } });
    const std::string names =
      Write("a" + extension, first.GetPointer()) + " " + Write("b" + extension, second.GetPointer());
    EXPECT_EQ(JsonTextOf(names), expected) << extension;
    EXPECT_EQ(JsonTextOf(names + " --frames 3:25"), cut) << extension;
  }
  EXPECT_EQ(Run("a.mha b.mha --exposures 1,1,1"), 2);
  EXPECT_NE(m_Message.find("--exposures holds 3 numbers, but there are 30 frames"), std::string::npos) << m_Message;
}

TEST_F(EstimateSelectionTool, FramesThatAreChosenOfTheBurstAreNoChoiceOfThoseToCheck)
{
  const auto burst = MakeBurst(30);
  const auto part = Cut<unsigned short>(burst, { { 0, 0, 0 } }, { { 64, 64, 14 } });
  EXPECT_NE(Run(Write("s.mha", burst.GetPointer()) + " --frames 10:30 --check " + Write("part.mha", part.GetPointer())),
            2)
    << m_Message;
}

TEST_F(EstimateSelectionTool, FilesThatFramesLeavesOutAreNotOpened)
{
  std::vector<std::string> names = WriteList<unsigned short>(MakeBurst(26), ".tif");
  std::filesystem::remove(Path(names[0]));
  WriteText(names[25], "no image");
  EXPECT_EQ(ReportOf(Joined(names) + "--frames 1:25")["frames"], 24);
}

TEST_F(EstimateSelectionTool, RoiGivesTheReportOfTheCutStackBitForBit)
{
  const auto        burst = MakeBurst(24, "96x80");
  const auto        part = Cut<unsigned short>(burst, { { 9, 3, 0 } }, { { 80, 75, 24 } });
  const std::string expected = MeasuredTextOf(Write("part.mha", part.GetPointer()));
  for (const std::string name : { "s.mha", "s.tif", "s.nrrd" })
  {
    EXPECT_EQ(MeasuredTextOf(Write(name, burst.GetPointer()) + " --roi 9,3,80,75"), expected) << name;
  }
  const std::string list = Joined(WriteList<unsigned short>(burst, ".png"));
  EXPECT_EQ(MeasuredTextOf(list + "--roi 9,3,80,75"), expected);
  EXPECT_EQ(MeasuredTextOf("s.mha --roi 0,0,96,80"), MeasuredTextOf("s.mha"));

  const auto late = Cut<unsigned short>(burst, { { 9, 3, 2 } }, { { 80, 75, 20 } });
  Write("late.mha", late.GetPointer());
  EXPECT_EQ(MeasuredTextOf("s.mha --roi 9,3,80,75 --frames 2:22"), MeasuredTextOf("late.mha"));
}

TEST_F(EstimateSelectionTool, MaskLeavesOutThePixelsThatAreZero)
{
  const std::string    stack = Write("s.mha", MakeBurst().GetPointer());
  const nlohmann::json whole = ReportOf(stack);
  Write("mask.png", MakeMask().GetPointer());
  const std::string    text = JsonTextOf(stack + " --mask mask.png");
  const nlohmann::json masked = nlohmann::json::parse(text);
  EXPECT_EQ(masked["pixels"]["total"], 64 * 64);
  EXPECT_EQ(masked["pixels"]["valid"], 54 * 64 - whole["pixels"]["clipped"].get<int>());
  EXPECT_LT(masked["pixels"]["used"], whole["pixels"]["used"]);

  // any type, any nonzero value
  const auto fractions = Make<itk::Image<float, 2>>({ { 64, 64 } }, 0.25F);
  const auto mask = MakeMask();
  for (std::size_t i = 0; i < 64 * 64; ++i)
  {
    fractions->GetBufferPointer()[i] *= mask->GetBufferPointer()[i] != 0 ? 1.0F : 0.0F;
  }
  Write("mask.mha", fractions.GetPointer());
  EXPECT_EQ(JsonTextOf(stack + " --mask mask.mha"), text);

  Write("ones.png", Make<MaskType>({ { 64, 64 } }, 255).GetPointer());
  EXPECT_EQ(MeasuredTextOf(stack + " --mask ones.png"), MeasuredTextOf(stack));
}

TEST_F(EstimateSelectionTool, MaskIsThatOfTheWholeFrameAlsoWithRoi)
{
  const auto burst = MakeBurst();
  const auto mask = MakeMask();
  Write("s.mha", burst.GetPointer());
  Write("mask.png", mask.GetPointer());
  Write("part.mha", Cut<unsigned short>(burst, { { 6, 4, 0 } }, { { 56, 60, 24 } }).GetPointer());
  const auto partOfMask = Make<MaskType>({ { 56, 60 } }, 0);
  for (int y = 0; y < 60; ++y)
  {
    for (int x = 0; x < 56; ++x)
    {
      partOfMask->SetPixel({ { x, y } }, mask->GetPixel({ { x + 6, y + 4 } }));
    }
  }
  Write("part.png", partOfMask.GetPointer());
  const std::string text = MeasuredTextOf("s.mha --roi 6,4,56,60 --mask mask.png");
  EXPECT_EQ(text, MeasuredTextOf("part.mha --mask part.png"));
  EXPECT_NE(text, MeasuredTextOf("part.mha"));
}

// The checksum is Python's zlib.crc32(b"56x60:" + bytes of 0 and 1, row by row), of the part that was measured.
TEST_F(EstimateSelectionTool, WhatWasSelectedIsInTheSettings)
{
  const auto burst = MakeBurst(30);
  Write("s.mha", burst.GetPointer());
  Write("mask.png", MakeMask().GetPointer());
  const std::string    options = " --roi 6,4,56,60 --frames 3:25 --mask mask.png --threads 1";
  const nlohmann::json settings = ReportOf("s.mha" + options)["settings"];
  EXPECT_EQ(settings,
            nlohmann::json::parse(R"({"rolling_shutter": "auto", "mask_crc32": "deb2ea24", "roi_x": 6, "roi_y": 4,
      "roi_width": 56, "roi_height": 60, "frame_range_first": 3, "frame_range_end": 25})"));
  EXPECT_EQ(ReportOf(Joined(WriteList<unsigned short>(burst, ".tif")) + options)["settings"], settings);
  EXPECT_EQ(ReportOf("s.mha")["settings"], nlohmann::json::parse(R"({"rolling_shutter": "auto"})"));
}
