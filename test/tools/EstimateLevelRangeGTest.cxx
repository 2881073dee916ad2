// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "helpers/EstimateToolTestHelper.h"

#include <cmath>
#include <string>

namespace
{
using sensornoise::PixelUse;

/** --level-range. */
class EstimateLevelRangeTool : public EstimateToolTest
{
protected:
  using MapType = itk::Image<double, 2>;
  using UseType = itk::Image<unsigned char, 2>;

  /** Returns the level that the range limits: the mean of a pixel's 8 neighbours [DN]. */
  static double
  NeighbourMean(const MapType * mean, int x, int y)
  {
    double sum = 0.0;
    for (int dy = -1; dy <= 1; ++dy)
    {
      for (int dx = -1; dx <= 1; ++dx)
      {
        sum += dx != 0 || dy != 0 ? mean->GetPixel({ { x + dx, y + dy } }) : 0.0;
      }
    }
    return sum / 8.0;
  }
};
} // namespace

TEST_F(EstimateLevelRangeTool, PixelsAtOtherLevelsAreLeftOutAndSaidToBe)
{
  const std::string    stack = Write("s.mha", MakeBurst().GetPointer());
  const nlohmann::json whole = ReportOf(stack + " --maps whole");
  const nlohmann::json report = ReportOf(stack + " --level-range 500,2500 --maps part");
  EXPECT_EQ(report["settings"]["level_range_low"], 500.0);
  EXPECT_EQ(report["settings"]["level_range_high"], 2500.0);
  EXPECT_FALSE(whole["settings"].contains("level_range_low"));
  const auto mean = Read<MapType>(Path("part/mean.mha"));
  const auto before = Read<UseType>(Path("whole/pixel_use.mha"));
  const auto uses = Read<UseType>(Path("part/pixel_use.mha"));
  int        outside = 0;
  for (int y = 1; y < 63; ++y)
  {
    for (int x = 1; x < 63; ++x)
    {
      const double level = NeighbourMean(mean, x, y);
      const auto   use = static_cast<PixelUse>(uses->GetPixel({ { x, y } }));
      if (level < 500.0 || level > 2500.0)
      {
        EXPECT_NE(use, PixelUse::Used) << x << ' ' << y;
        outside += use == PixelUse::OutsideRange ? 1 : 0;
      }
      else
      {
        EXPECT_NE(use, PixelUse::OutsideRange) << x << ' ' << y;
      }
      // A pixel that was used before is used, or outside of the range. Nothing else changes but the few outliers of the
      // tails.
      if (static_cast<PixelUse>(before->GetPixel({ { x, y } })) == PixelUse::Used && (level < 500.0 || level > 2500.0))
      {
        EXPECT_EQ(use, PixelUse::OutsideRange) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(outside, 200);
  EXPECT_LT(report["pixels"]["used"], whole["pixels"]["used"]);
  // Camera B: g = 1 DN/e-.
  ASSERT_EQ(report["gain"]["status"], "identified");
  EXPECT_NEAR(report["gain"]["value"], 1.0, 4.0 * report["gain"]["standard_error"].get<double>());
  EXPECT_GT(report["gain"]["standard_error"], whole["gain"]["standard_error"]);
}

TEST_F(EstimateLevelRangeTool, ARangeThatHoldsAllLevelsChangesNothingElse)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  nlohmann::json    whole = ReportOf(stack);
  nlohmann::json    ranged = ReportOf(stack + " --level-range=-10,1e6");
  EXPECT_EQ(ranged["settings"]["level_range_low"], -10.0);
  whole.erase("settings");
  ranged.erase("settings");
  EXPECT_EQ(ranged, whole);
}

TEST_F(EstimateLevelRangeTool, WrongUseIsRefused)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  IsRefused(stack + " --level-range 500", { "--level-range", "\"500\" holds 1 number", "expected LOW,HIGH" });
  IsRefused(stack + " --level-range 500,high", { "--level-range", "\"high\"", "not a number" });
  IsRefused(stack + " --level-range 500,500", { "--level-range", "from 500 to 500 DN", "lower level first" });
  IsRefused(stack + " --level-range 500,2000 --method published",
            { "--level-range", "published fits all levels", "--method refined" });
}

TEST_F(EstimateLevelRangeTool, ARangeWithoutPixelsGivesNoEstimate)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  GivesNoEstimate(stack + " --level-range 50000,60000", {});
}
