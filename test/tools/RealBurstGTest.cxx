// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace
{

/** A burst of a real camera, which is not in the repository: Photron FASTCAM Nova S16, 15 frames of 384 x 384 pixels,
 * 12 bits, 30000 frames a second (ball_12bit.mraw of pyMRAW, MIT licence). A plate at rest fills the rows 334 to 383;
 * above it a ball moves in front of a saturated background. Nobody has published the camera's gain, so that the numbers
 * below are those that a program without any code in common found in the same pixels. */
class RealBurstTool : public EstimateToolTest
{
protected:
  static std::filesystem::path
  FindBurst()
  {
    const char * const given = std::getenv("SENSORNOISE_BURST");
    return given != nullptr ? std::filesystem::path(given)
                            : std::filesystem::path(SourceFolder()) / "../shared/data/ball_12bit.mraw";
  }
  static std::string
  Burst()
  {
    return std::filesystem::absolute(FindBurst()).string();
  }
};

/** A test that needs the burst skips without it, and says so. */
class RealBurstOnFileTool : public RealBurstTool
{
protected:
  void
  SetUp() override
  {
    RealBurstTool::SetUp();
    if (!std::filesystem::exists(FindBurst()))
    {
      GTEST_SKIP() << "skipped: there is no file " << FindBurst().string()
                   << "; set SENSORNOISE_BURST to the path of ball_12bit.mraw";
    }
  }

  /** Returns a report, whether or not anything was estimated. */
  nlohmann::json
  ReportOfBurst(const std::string & options)
  {
    const int exitCode = Run("\"" + Burst() + "\" --raw 384x384:uint12msb --quiet --json - " + options);
    EXPECT_TRUE(exitCode == 0 || exitCode == 3) << exitCode << m_Message;
    EXPECT_TRUE(nlohmann::json::accept(m_Output)) << m_Output; // JSON knows no NaN
    const nlohmann::json report = nlohmann::json::parse(m_Output, nullptr, false);
    EXPECT_EQ(exitCode == 3, report["gain"]["value"].is_null() && report["intercept"]["value"].is_null());
    return report;
  }
};

std::set<std::string>
WarningsOf(const nlohmann::json & report)
{
  std::set<std::string> codes;
  for (const auto & warning : report["warnings"])
  {
    codes.insert(warning["code"].get<std::string>());
  }
  return codes;
}

/** Returns the constant and the slope of the least-squares line. */
std::array<double, 2>
LineThrough(const std::vector<double> & x, const std::vector<double> & y)
{
  const auto n = static_cast<double>(x.size());
  double     sx = 0.0;
  double     sy = 0.0;
  double     sxx = 0.0;
  double     sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  const double slope = (sxy - sx * sy / n) / (sxx - sx * sx / n);
  return { (sy - slope * sx) / n, slope };
}

const std::string plate = "--roi 0,334,384,50 ";
} // namespace

TEST_F(RealBurstOnFileTool, ItsHeaderSaysTheSame)
{
  if (!std::filesystem::exists(std::filesystem::path(Burst()).replace_extension(".cihx")))
  {
    GTEST_SKIP() << "skipped: there is no .cihx file beside " << Burst();
  }
  const nlohmann::json raw = ReportOfBurst(plate + "--bit-depth 12");
  Run("\"" + Burst() + "\" --quiet --json - " + plate + "--bit-depth 12");
  const nlohmann::json report = nlohmann::json::parse(m_Output, nullptr, false);
  EXPECT_EQ(report["variance_slope"], raw["variance_slope"]);
  EXPECT_EQ(report["frames"], 15);
}

TEST_F(RealBurstOnFileTool, MeanAndVarianceOfThePlateAreThoseOfAnotherProgram)
{
  const nlohmann::json report = ReportOfBurst(plate + "--maps maps");
  EXPECT_EQ(report["frames"], 15);
  EXPECT_EQ(report["bit_depth"], 12);
  EXPECT_EQ(report["clip_high"], 4095.0);
  const auto            mean = Read<itk::Image<double, 2>>(Path("maps/mean.mha"));
  const auto            variance = Read<itk::Image<double, 2>>(Path("maps/variance.mha"));
  std::vector<double>   x;
  std::vector<double>   y;
  constexpr std::size_t pixels = 384 * 50;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    if (mean->GetBufferPointer()[p] < 3000.0)
    {
      x.push_back(mean->GetBufferPointer()[p]);
      y.push_back(variance->GetBufferPointer()[p]);
    }
  }
  // The other program's figures, to the digits that it gave: 17254 pixels, variance = 70.9 DN^2 + 0.4534 DN mean. The
  // line is 0.001 of its slope and 0.5 DN^2 off if it divides by another number or leaves out a few clipped pixels.
  EXPECT_EQ(x.size(), 17254u);
  const auto [constant, slope] = LineThrough(x, y);
  EXPECT_NEAR(slope, 0.4534, 0.0005);
  EXPECT_NEAR(constant, 70.9, 0.5);
}

// Flicker steepens the other program's line, 0.4534, by 4 %.
TEST_F(RealBurstOnFileTool, TheVarianceOfThePlateIsTheOtherProgramsWithoutTheFlicker)
{
  const nlohmann::json slope = ReportOfBurst(plate)["variance_slope"];
  ASSERT_EQ(slope["status"], "identified");
  EXPECT_NEAR(slope["value"], 0.96 * 0.4534, 4.0 * slope["standard_error"].get<double>());
  EXPECT_LT(slope["standard_error"], 0.01);
}

// Neighbours in a column have a noise correlation of some 4.5 %, as a laboratory program without any code in common
// found; the covariance of neighbours is missing in the variance.
TEST_F(RealBurstOnFileTool, TheRefinedGainOfThePlateIncludesTheCorrelation)
{
  const nlohmann::json report = ReportOfBurst(plate);
  ASSERT_EQ(report["gain"]["status"], "identified");
  EXPECT_EQ(WarningsOf(report).count("noise-correlated"), 1u);
  const nlohmann::json & noise = report["noise_correlation"];
  EXPECT_EQ(noise["kind"], "crosstalk");
  for (const nlohmann::json & lag : noise["space"])
  {
    const bool isBelow = lag["lag"] == nlohmann::json({ 0, 1 });
    EXPECT_NEAR(lag["value"], isBelow ? 0.045 : 0.0, 4.0 * lag["standard_error"].get<double>()) << lag;
    EXPECT_LT(lag["standard_error"], 0.01) << lag;
  }
  const double sum = 1.0 + 2.0 * 0.045;
  EXPECT_NEAR(report["gain"]["value"], sum * 0.96 * 0.4534, 3.0 * report["gain"]["standard_error"].get<double>());
  EXPECT_LT(report["gain"]["standard_error"], 0.03);
  EXPECT_GT(report["pixels"]["used"], 384 * 50 / 2);
}

// The plate flickers by 0.26 %, and the plate's texture leaves the published method's mask a sixteenth of its pixels,
// mostly dark: far too little for a flicker that small. The report has to say so.
TEST_F(RealBurstOnFileTool, TheFlickerOfThePlateIsTooSmallForOffsetAndReadNoise)
{
  const nlohmann::json        report = ReportOfBurst(plate + "--method published");
  const std::set<std::string> warnings = WarningsOf(report);
  EXPECT_EQ(warnings.count("few-frames"), 1u);
  EXPECT_EQ(warnings.count("offset-not-identifiable"), 1u);
  EXPECT_EQ(report["offset"]["status"], "not-identifiable");
  EXPECT_EQ(report["read_noise"]["status"], "not-identifiable");
  EXPECT_EQ(report["flicker_sd"]["status"], "upper-limit");
  EXPECT_GT(report["flicker_sd"]["bracket"][1], 0.00261);
  // Flicker can only steepen the line, by 4 % of the plate's 0.4534 according to the other program; the pixels that the
  // mask keeps are few, and their line is within a third of it.
  EXPECT_NEAR(report["affine_baseline"]["gain"], 0.4534, 0.15);
  if (!report["gain"]["value"].is_null() && std::abs(report["gain"]["value"].get<double>() - 0.436) > 0.1)
  {
    EXPECT_TRUE(warnings.count("offset-line-misfit") + warnings.count("corrected-variance-curved") > 0) << m_Message;
    EXPECT_GT(report["fit"]["reduced_chi2"], 2.0);
  }
}

TEST_F(RealBurstOnFileTool, TheSaturatedBackgroundAndTheBallAreNotMistakenForThePlate)
{
  const nlohmann::json refined = ReportOfBurst("--maps maps");
  EXPECT_EQ(WarningsOf(refined).count("near-clip-level"), 1u);
  // All but a few of the used pixels lie on the plate, in the lowest 50 rows.
  const auto           use = Read<itk::Image<unsigned char, 2>>(Path("maps/pixel_use.mha"));
  const std::ptrdiff_t total = 384 * 384;
  const std::ptrdiff_t above = 384 * 334;
  const auto *         first = use->GetBufferPointer();
  EXPECT_EQ(std::count(first, first + total, 0), refined["pixels"]["used"].get<std::ptrdiff_t>());
  EXPECT_LT(std::count(first, first + above, 0), total / 100);
  EXPECT_GT(std::count(first + above, first + total, 0), (total - above) / 2);
  if (!refined["gain"]["value"].is_null())
  {
    EXPECT_NEAR(refined["gain"]["value"], 0.96 * 0.4534, 4.0 * refined["gain"]["standard_error"].get<double>());
  }
  const nlohmann::json report = ReportOfBurst("--method published");
  EXPECT_EQ(report["width"], 384);
  EXPECT_EQ(report["height"], 384);
  EXPECT_GT(report["pixels"]["clipped"], 384 * 384 * 3 / 4);
  EXPECT_LT(report["pixels"]["used"], 384 * 384 / 10);
  // The ball and its shadow change the illumination by tens of per cent where they pass. No line describes that.
  const std::set<std::string> warnings = WarningsOf(report);
  EXPECT_TRUE(warnings.count("offset-line-misfit") + warnings.count("corrected-variance-curved") +
                warnings.count("variance-not-affine") >
              0)
    << m_Message;
}

TEST_F(RealBurstOnFileTool, ThreadsAndPartsChangeNothing)
{
  for (const std::string & options : { plate, plate + "--method published " })
  {
    ReportOfBurst(options + "--threads 1");
    const std::string one = m_Output;
    ReportOfBurst(options + "--threads 7");
    EXPECT_EQ(m_Output, one);
  }
}
