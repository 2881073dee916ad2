// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "helpers/EstimateToolTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

namespace
{

/** Tests of the options about the data, and of the maps. */
class EstimateSettingsTool : public EstimateToolTest
{
protected:
  using MapType = itk::Image<double, 2>;
  using UseType = itk::Image<unsigned char, 2>;

  static std::size_t
  CountOf(const UseType * uses, sensornoise::PixelUse use)
  {
    const auto * first = uses->GetBufferPointer();
    const auto   pixels = uses->GetLargestPossibleRegion().GetNumberOfPixels();
    return static_cast<std::size_t>(std::count(first, first + pixels, static_cast<unsigned char>(use)));
  }
  static sensornoise::PixelUse
  UseAt(const UseType * uses, int x, int y)
  {
    return static_cast<sensornoise::PixelUse>(uses->GetPixel({ { x, y } }));
  }
};

using sensornoise::PixelUse;
} // namespace

TEST_F(EstimateSettingsTool, GivenDnSettingsAreInTheReport)
{
  const std::string    stack = Write("s.mha", MakeBurst().GetPointer());
  const nlohmann::json found = ReportOf(stack);
  EXPECT_EQ(found["bit_depth"], 12);
  EXPECT_EQ(found["bit_depth_source"], "data");
  EXPECT_EQ(found["quantisation_step"], 1.0);
  EXPECT_EQ(found["clip_low"], 0.0);
  EXPECT_EQ(found["clip_high"], 4095.0);
  EXPECT_EQ(found["clip_source"], "code range");
  EXPECT_EQ(JsonTextOf(stack + " --bit-depth auto --method refined"), JsonTextOf(stack));

  const nlohmann::json bits = ReportOf(stack + " --bit-depth 14");
  EXPECT_EQ(bits["bit_depth"], 14);
  EXPECT_EQ(bits["bit_depth_source"], "given");
  EXPECT_EQ(bits["clip_high"], 16383.0);

  const nlohmann::json clip = ReportOf(stack + " --clip 90,3000");
  EXPECT_EQ(clip["clip_low"], 90.0);
  EXPECT_EQ(clip["clip_high"], 3000.0);
  EXPECT_EQ(clip["clip_source"], "given");
  EXPECT_GT(clip["pixels"]["clipped"], 100);

  EXPECT_EQ(ReportOf(stack + " --step 0.5 --bit-depth 14")["quantisation_step"], 0.5);
}

TEST_F(EstimateSettingsTool, TheRollingShutterModeIsInTheReport)
{
  Write("s.mha", MakeBurst().GetPointer());
  EXPECT_EQ(ReportOf("s.mha --rolling-shutter off")["settings"]["rolling_shutter"], "off");
  const std::string    stack = "s.mha --method published";
  const nlohmann::json off = ReportOf(stack + " --rolling-shutter off");
  EXPECT_EQ(off["settings"]["rolling_shutter"], "off");
  EXPECT_EQ(off["settings"]["sigma_rows"], 0.0);
  EXPECT_TRUE(off["flicker_rows"].is_null());
  EXPECT_EQ(ReportOf(stack + " --rolling-shutter auto")["settings"]["rolling_shutter"], "auto");
  EXPECT_EQ(JsonTextOf(stack + " --rolling-shutter auto"), JsonTextOf(stack));

  const nlohmann::json fixed = ReportOf(stack + " --rolling-shutter 6.5");
  EXPECT_EQ(fixed["settings"]["rolling_shutter"], "fixed");
  EXPECT_EQ(fixed["settings"]["sigma_rows"], 6.5);
  ASSERT_EQ(fixed["flicker_rows"].size(), 24u);
  EXPECT_EQ(fixed["flicker_rows"][0].size(), 64u);
}

TEST_F(EstimateSettingsTool, MapsHoldMeanAndVarianceAndSayWhyAPixelIsLeftOut)
{
  const auto burst = MakeBurst();
  burst->SetPixel({ { 5, 7, 11 } }, 4095);
  burst->SetPixel({ { 50, 3, 2 } }, 0);
  for (int t = 0; t < 24; ++t)
  {
    burst->SetPixel({ { 40, 41, t } }, 1000);
  }
  const auto mask = Make<UseType>({ { 64, 64 } }, 1);
  mask->SetPixel({ { 0, 9 } }, 0);
  mask->SetPixel({ { 30, 30 } }, 0);
  Write("mask.png", mask.GetPointer());
  Write("s.mha", burst.GetPointer());
  const nlohmann::json report = ReportOf("s.mha --method published --mask mask.png --maps some/maps");
  EXPECT_EQ(FilesLeft(),
            (std::set<std::string>{ "s.mha",
                                    "mask.png",
                                    "some/maps/mean.mha",
                                    "some/maps/variance.mha",
                                    "some/maps/corrected_variance.mha",
                                    "some/maps/pixel_use.mha" }));
  const auto mean = Read<MapType>(Path("some/maps/mean.mha"));
  const auto variance = Read<MapType>(Path("some/maps/variance.mha"));
  const auto corrected = Read<MapType>(Path("some/maps/corrected_variance.mha"));
  const auto uses = Read<UseType>(Path("some/maps/pixel_use.mha"));
  for (int i = 0; i < 64; ++i)
  {
    double sum = 0.0;
    double squares = 0.0;
    for (int t = 0; t < 24; ++t)
    {
      const double value = burst->GetPixel({ { i, 63 - i, t } });
      sum += value;
      squares += value * value;
    }
    EXPECT_NEAR(mean->GetPixel({ { i, 63 - i } }), sum / 24.0, 1e-9);
    EXPECT_NEAR(variance->GetPixel({ { i, 63 - i } }), (squares - sum * sum / 24.0) / 23.0, 1e-6);
    // flicker adds to the variance: where it is corrected there is less, up to its chance correlation with the noise
    EXPECT_LT(corrected->GetPixel({ { i, 63 - i } }), 1.2 * variance->GetPixel({ { i, 63 - i } }));
  }
  EXPECT_EQ(UseAt(uses, 5, 7), PixelUse::Clipped);
  EXPECT_EQ(UseAt(uses, 50, 3), PixelUse::Clipped);
  EXPECT_EQ(UseAt(uses, 40, 41), PixelUse::Constant);
  EXPECT_EQ(UseAt(uses, 0, 9), PixelUse::Masked);
  EXPECT_EQ(UseAt(uses, 30, 30), PixelUse::Masked);
  EXPECT_EQ(UseAt(uses, 0, 10), PixelUse::Border);
  EXPECT_EQ(UseAt(uses, 63, 63), PixelUse::Border);
  EXPECT_EQ(CountOf(uses, PixelUse::Used), report["pixels"]["used"]);
  EXPECT_EQ(CountOf(uses, PixelUse::Clipped), report["pixels"]["clipped"]);
  EXPECT_EQ(CountOf(uses, PixelUse::Masked), 2u);
  EXPECT_EQ(CountOf(uses, PixelUse::Constant), 1u);
  EXPECT_EQ(CountOf(uses, PixelUse::Border), 4 * 63 - 1u);
  EXPECT_EQ(CountOf(uses, PixelUse::NotFinite), 0u);
  // edges of the target, whose gradients stand out even of these small vibrations' test
  EXPECT_EQ(CountOf(uses, PixelUse::Vibration),
            64 * 64 - 4 * 63 - 2u - CountOf(uses, PixelUse::Used) - CountOf(uses, PixelUse::Clipped));
  EXPECT_GT(CountOf(uses, PixelUse::Vibration), 0u);
}

TEST_F(EstimateSettingsTool, MapsOfTheRefinedMethodSayWhyAPixelIsLeftOut)
{
  const auto burst = MakeBurst();
  burst->SetPixel({ { 15, 17, 11 } }, 4095);
  for (int t = 0; t < 24; ++t)
  {
    burst->SetPixel({ { 40, 41, t } }, 1000);
  }
  const auto mask = Make<UseType>({ { 64, 64 } }, 1);
  mask->SetPixel({ { 30, 30 } }, 0);
  Write("mask.png", mask.GetPointer());
  const nlohmann::json report = ReportOf(Write("s.mha", burst.GetPointer()) + " --mask mask.png --maps maps");
  const auto           corrected = Read<MapType>(Path("maps/corrected_variance.mha"));
  const auto           uses = Read<UseType>(Path("maps/pixel_use.mha"));
  EXPECT_EQ(UseAt(uses, 15, 17), PixelUse::Clipped);
  EXPECT_EQ(UseAt(uses, 16, 17), PixelUse::NearClip);
  EXPECT_EQ(UseAt(uses, 40, 41), PixelUse::Constant);
  EXPECT_EQ(UseAt(uses, 30, 30), PixelUse::Masked);
  EXPECT_EQ(UseAt(uses, 0, 20), PixelUse::Border);
  EXPECT_EQ(CountOf(uses, PixelUse::Used), report["pixels"]["used"]);
  EXPECT_GT(CountOf(uses, PixelUse::Used), 3000u);
  EXPECT_EQ(CountOf(uses, PixelUse::Clipped), 1u);
  for (int y = 0; y < 64; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      EXPECT_TRUE(UseAt(uses, x, y) != PixelUse::Used || corrected->GetPixel({ { x, y } }) > 0.0) << x << ' ' << y;
    }
  }
}

TEST_F(EstimateSettingsTool, MapsOfARoiHaveItsSize)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  ReportOf(stack + " --maps whole");
  ReportOf(stack + " --roi 4,2,58,60 --maps part");
  const auto whole = Read<MapType>(Path("whole/mean.mha"));
  const auto part = Read<MapType>(Path("part/mean.mha"));
  ASSERT_EQ(part->GetLargestPossibleRegion().GetSize(), (itk::Size<2>{ { 58, 60 } }));
  EXPECT_EQ(part->GetBufferPointer()[58 * 3 + 5], whole->GetPixel({ { 4 + 5, 2 + 3 } }));
}

TEST_F(EstimateSettingsTool, SomePixelsOfAFloatStackMayBeNaN)
{
  using FloatStack = itk::Image<float, 3>;
  const auto burst = MakeBurst();
  const auto stack = Make<FloatStack>(burst->GetLargestPossibleRegion().GetSize(), 0.0F);
  std::copy(burst->GetBufferPointer(), burst->GetBufferPointer() + 64 * 64 * 24, stack->GetBufferPointer());
  const nlohmann::json whole = ReportOf(Write("whole.mha", stack.GetPointer()));
  const nlohmann::json integers = ReportOf(Write("integers.mha", burst.GetPointer()));
  for (const char * const name : { "bit_depth", "quantisation_step", "clip_high" })
  {
    EXPECT_EQ(whole[name], integers[name]) << name;
  }
  for (const char * const name : { "gain", "read_noise" })
  {
    const double value = integers[name]["value"];
    // Integers have some maps in single precision, with an error of 6e-8 of each number.
    EXPECT_NEAR(whole[name]["value"].get<double>(), value, 1e-7 * value) << name;
  }

  stack->SetPixel({ { 3, 4, 5 } }, std::numeric_limits<float>::quiet_NaN());
  stack->SetPixel({ { 3, 4, 9 } }, std::numeric_limits<float>::quiet_NaN());
  stack->SetPixel({ { 33, 50, 0 } }, std::numeric_limits<float>::infinity());
  stack->SetPixel({ { 60, 61, 23 } }, -std::numeric_limits<float>::infinity());
  const nlohmann::json report = ReportOf(Write("s.mha", stack.GetPointer()) + " --maps maps");
  EXPECT_NE(m_Message.find("3 pixels are NaN or infinite"), std::string::npos) << m_Message;
  EXPECT_EQ(report["pixels"]["not_finite"], 3);
  EXPECT_EQ(report["pixels"]["valid"], 64 * 64 - 3);
  // each pixel and its neighbours, which have no gradient, of more than 1000
  EXPECT_NEAR(report["gain"]["value"], whole["gain"]["value"].get<double>(), 0.02);
  const auto uses = Read<UseType>(Path("maps/pixel_use.mha"));
  EXPECT_EQ(UseAt(uses, 3, 4), PixelUse::NotFinite);
  EXPECT_EQ(UseAt(uses, 33, 50), PixelUse::NotFinite);
  EXPECT_EQ(UseAt(uses, 60, 61), PixelUse::NotFinite);
}
