// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Text.h"
#include "helpers/EstimateToolTestHelper.h"
#include "sensornoise/ReportText.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace
{

using EstimateTool = EstimateToolTest;

std::set<std::string>
NamesOf(const nlohmann::json & object)
{
  std::set<std::string> names;
  for (const auto & member : object.items())
  {
    names.insert(member.key());
  }
  return names;
}

/** \a hasError: with a standard error and an interval where it is identified. */
void
IsAQuantity(const nlohmann::json & report, const std::string & path, const std::string & unit, bool hasError)
{
  SCOPED_TRACE(path);
  const nlohmann::json & quantity = report.at(nlohmann::json::json_pointer(path));
  EXPECT_EQ(NamesOf(quantity),
            (std::set<std::string>{ "value", "standard_error", "interval95", "status", "unit", "bracket" }));
  EXPECT_EQ(quantity["unit"], unit);
  EXPECT_EQ(quantity["value"].is_null(), quantity["status"] != "identified");
  const bool isIdentified = quantity["status"] == "identified";
  EXPECT_EQ(quantity["standard_error"].is_null(), !(hasError && isIdentified));
  EXPECT_EQ(quantity["interval95"].is_null(), !(hasError && (isIdentified || quantity["status"] == "upper-limit")));
}
} // namespace

class EstimateToolWith
  : public EstimateToolTest
  , public ::testing::WithParamInterface<const char *>
{};
INSTANTIATE_TEST_SUITE_P(Method, EstimateToolWith, ::testing::Values("refined", "published"));

TEST_P(EstimateToolWith, TheReportHasTheDocumentedNamesAndUnits)
{
  const std::string    stack = Write("s.mha", MakeBurst().GetPointer());
  const bool           isRefined = GetParam() == std::string("refined");
  const nlohmann::json report = ReportOf(stack + " --method " + GetParam());
  EXPECT_EQ(m_Message, "");
  EXPECT_EQ(NamesOf(report),
            (std::set<std::string>{ "schema",
                                    "version",
                                    "method",
                                    "settings",
                                    "frames",
                                    "frames_distinct",
                                    "frames_left_out",
                                    "width",
                                    "height",
                                    "channel",
                                    "bit_depth",
                                    "bit_depth_source",
                                    "quantisation_step",
                                    "clip_low",
                                    "clip_high",
                                    "clip_source",
                                    "pixels",
                                    "gain",
                                    "variance_slope",
                                    "offset",
                                    "read_noise",
                                    "read_noise_median",
                                    "read_noise_electrons",
                                    "intercept",
                                    "total_intercept",
                                    "covariance",
                                    "noise_correlation",
                                    "linearity",
                                    "flicker_sd",
                                    "vibration",
                                    "flicker",
                                    "flicker_rows",
                                    "motion",
                                    "fit",
                                    "affine_baseline",
                                    "quadratic_baseline",
                                    "warnings",
                                    "scatter" }));
  for (const sensornoise::QuantityEntry & entry : sensornoise::QuantityList())
  {
    std::string path = std::string("/") + entry.path;
    std::replace(path.begin(), path.end(), '.', '/');
    if (path.find("/noise_correlation/") == 0 && report["noise_correlation"].is_null())
    {
      continue; // the published method
    }
    IsAQuantity(report, path, entry.unit, isRefined);
  }
  EXPECT_EQ(report["schema"], "itk-sensornoise-report/1");
  EXPECT_EQ(report["method"], GetParam());
  EXPECT_EQ(report["frames"], 24);
  EXPECT_EQ(report["frames_distinct"], 24);
  EXPECT_EQ(report["width"], 64);
  EXPECT_EQ(report["height"], 64);
  EXPECT_EQ(report["flicker"].size(), 24u);
  EXPECT_EQ(NamesOf(report["pixels"]), (std::set<std::string>{ "total", "valid", "used", "clipped", "not_finite" }));
  EXPECT_EQ(report["pixels"]["total"], 64 * 64);
  EXPECT_EQ(
    NamesOf(report["fit"]),
    (std::set<std::string>{ "reduced_chi2", "curvature", "curvature_z", "nonlinearity", "offset_line_phi", "line" }));
  EXPECT_EQ(report["covariance"]["of"], (std::vector<std::string>{ "gain", "intercept", "offset" }));
  EXPECT_EQ(report["covariance"]["matrix"].is_null(), !isRefined);
  EXPECT_EQ(report["motion"].is_null(), !isRefined);
  if (isRefined)
  {
    EXPECT_EQ(report["covariance"]["matrix"].size(), 3u);
    EXPECT_NEAR(
      report["covariance"]["matrix"][0][0], std::pow(report["gain"]["standard_error"].get<double>(), 2), 1e-12);
    EXPECT_EQ(report["motion"].size(), 24u);
    EXPECT_EQ(report["motion"][0].size(), 2u);
    EXPECT_EQ(JsonTextOf(stack), m_Output); // the default
  }
  EXPECT_EQ(NamesOf(report["scatter"]), (std::set<std::string>{ "mean", "variance", "corrected_variance", "count" }));
  EXPECT_EQ(report["scatter"]["mean"].size(), report["scatter"]["count"].size());
}

TEST_P(EstimateToolWith, TheSimulatedCameraIsRecoveredAndItsFlickerIsNotMistakenForNoise)
{
  const nlohmann::json report =
    ReportOf(Write("s.mha", MakeBurst(40, "128x128").GetPointer()) + " --method " + GetParam());
  // Camera B: gain 1 DN/e-, offset 100 DN, read noise 8 DN. Some 10^4 pixels with variances of 39 degrees of freedom:
  // each is off by sqrt(2 / 39) = 23 %, all together by 0.2 %; the flicker estimate adds about 1 %.
  EXPECT_NEAR(report["gain"]["value"], 1.0, 0.04);
  // The offset's spread is about 3 DN for a burst as short as this.
  EXPECT_NEAR(report["offset"]["value"], 100.0, 12.0);
  // sigma^2 = intercept + g mu, so that the error of the read noise is about 12 / (2 x 8) DN.
  EXPECT_NEAR(report["read_noise"]["value"], 8.0, 1.0);
  EXPECT_NEAR(report["read_noise_electrons"]["value"],
              report["read_noise"]["value"].get<double>() / report["gain"]["value"].get<double>(),
              1e-12);
  // A line through the uncorrected variance takes flicker of 5 % at up to 3000 DN for noise.
  EXPECT_GT(report["affine_baseline"]["gain"], 3.0);
}

TEST_P(EstimateToolWith, ATableForPeopleIsOnStandardOutput)
{
  const std::string    stack = Write("s.mha", MakeBurst().GetPointer()) + " --method " + GetParam();
  const nlohmann::json report = ReportOf(stack);
  ASSERT_EQ(Run(stack), 0);
  EXPECT_EQ(m_Message, "");
  EXPECT_NE(m_Output.find("24 frames of 64 x 64 pixels, 12 bits (data)"), std::string::npos) << m_Output;
  const std::vector<std::pair<std::string, std::string>> rows{ { "gain g", "gain" },
                                                               { "offset mu", "offset" },
                                                               { "read noise sigma", "read_noise" },
                                                               { "read noise sigma / g", "read_noise_electrons" },
                                                               { "intercept sigma^2 - g mu", "intercept" },
                                                               { "flicker sd", "flicker_sd" } };
  for (const auto & [label, name] : rows)
  {
    const nlohmann::json & quantity = report[name];
    const double           value = quantity["value"];
    const auto             unit = sensornoise::WithSigns(quantity["unit"].get<std::string>());
    std::string            error;
    std::string            digits = "";
    if (quantity["standard_error"].is_null())
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.5g", value);
      digits = text;
    }
    else
    {
      const std::string measured =
        sensornoise::WithSigns(sensornoise::Measured(value, quantity["standard_error"].get<double>()));
      digits = measured.substr(0, measured.find(' '));
      error = sensornoise::PaddedRight(measured.substr(measured.find(' ') + 1), 12);
    }
    const std::string line = "\n" + sensornoise::PaddedRight(sensornoise::WithSigns(label), 24) + " " +
                             sensornoise::PaddedLeft(digits, 12) + " " + error + " " +
                             sensornoise::PaddedRight(unit, 8) + " " + quantity["status"].get<std::string>();
    EXPECT_NE(m_Output.find(line), std::string::npos) << line << " is not in\n" << m_Output;
  }
}

TEST_F(EstimateTool, AFileAndStandardOutputHoldTheSameJson)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  const std::string text = JsonTextOf(stack);
  EXPECT_EQ(text.front(), '{');
  ASSERT_EQ(Run(stack + " --json r.json"), 0);
  EXPECT_EQ(m_Output.rfind("24 frames", 0), 0u); // the table
  EXPECT_EQ(ReadText(Path("r.json")), text);
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha", "r.json" }));

  WriteText("r.json", "an older report");
  ASSERT_EQ(Run(stack + " --quiet --json r.json"), 0);
  EXPECT_EQ(m_Output, "");
  EXPECT_EQ(ReadText(Path("r.json")), text);
}

TEST_F(EstimateTool, TheNumberOfThreadsChangesNothing)
{
  const std::string stack = Write("s.mha", MakeBurst().GetPointer());
  for (const std::string options : { "", " --method published", " --method published --rolling-shutter 8" })
  {
    const std::string one = JsonTextOf(stack + options + " --threads 1");
    EXPECT_EQ(JsonTextOf(stack + options + " --threads 7"), one);
    EXPECT_EQ(JsonTextOf(stack + options), one);
  }
}

TEST_F(EstimateTool, WarningsAreOnStandardErrorAndInTheReport)
{
  const nlohmann::json report = ReportOf(Write("s.mha", MakeBurst(16).GetPointer()));
  ASSERT_FALSE(report["warnings"].empty());
  EXPECT_EQ(report["warnings"][0]["code"], "few-frames");
  std::string expected;
  for (const auto & warning : report["warnings"])
  {
    expected += warning["severity"].get<std::string>() + ": " + warning["message"].get<std::string>() + " [" +
                warning["code"].get<std::string>() + "]\n";
  }
  EXPECT_EQ(m_Message, expected);
}

TEST_F(EstimateTool, FramesThatAreWrittenTwiceAreCountedOnce)
{
  const auto simulate = [this](const std::string & flags) {
    ASSERT_EQ(
      RunCommand("\"" + ToolFolder() + "/simulate-sensor-noise\" --seed 3 --flicker-sd 0.1 --size 64x64 " + flags), 0)
      << m_Message;
  };
  simulate("--output once.mha --frames 24");
  simulate("--output twice.mha --frames 48 --repeat 2");
  for (const std::string method : { " --method refined", " --method published" })
  {
    const nlohmann::json once = ReportOf("once.mha" + method);
    const nlohmann::json twice = ReportOf("twice.mha" + method);
    EXPECT_EQ(once["frames_distinct"], 24);
    EXPECT_EQ(twice["frames_distinct"], 24);
    EXPECT_EQ(twice["frames"], 48);
    EXPECT_EQ(twice["warnings"][0]["code"], "repeated-frames");
    for (const char * name :
         { "gain", "offset", "read_noise", "intercept", "flicker_sd", "vibration", "fit", "scatter" })
    {
      EXPECT_EQ(twice[name], once[name]) << name;
    }
    for (std::size_t t = 0; t < 48; ++t)
    {
      EXPECT_EQ(twice["flicker"][t], once["flicker"][t / 2]) << t;
    }
  }
}

TEST_F(EstimateTool, NoProgressGoesIntoAPipe)
{
  ASSERT_EQ(Run(Write("s.mha", MakeBurst().GetPointer())), 0);
  EXPECT_EQ(m_Message, "");
  EXPECT_EQ(m_Output.find('\r'), std::string::npos);
}

TEST_F(EstimateTool, HelpNamesEveryOptionAndTheExitCodes)
{
  EXPECT_EQ(Run("--help"), 0);
  EXPECT_EQ(m_Message, "");
  for (const char * option : { "--method",
                               "--bit-depth",
                               "--clip",
                               "--step",
                               "--rolling-shutter",
                               "--offset",
                               "--dark",
                               "--check",
                               "--roi",
                               "--mask",
                               "--frames",
                               "--threads",
                               "--json",
                               "--maps",
                               "--quiet",
                               "Exit code" })
  {
    EXPECT_NE(m_Output.find(option), std::string::npos) << option;
  }
}

TEST_P(EstimateToolWith, CompandedDataAreNamed)
{
  ASSERT_EQ(RunCommand("\"" + ToolFolder() +
                       "/simulate-sensor-noise\" --output companded.mha --companding 8 --size 96x96 "
                       "--frames 24 --flicker-sd 0.1 --reference texture"),
            0);
  const std::string    stack = std::string("companded.mha --method ") + GetParam();
  const nlohmann::json report = ReportOf(stack);
  EXPECT_NE(report["warnings"].dump().find("companded"), std::string::npos) << report["warnings"];
  EXPECT_NE(report["warnings"].dump().find("the quantization step is "), std::string::npos);
  const nlohmann::json even = ReportOf(stack + " --step 1");
  EXPECT_EQ(even["warnings"].dump().find("companded"), std::string::npos);
  const double gain = report["gain"]["value"];
  const double slope = report["variance_slope"]["value"];
  if (GetParam() == std::string("refined"))
  {
    EXPECT_GT(slope, 1.01 * gain);
  }
  else
  {
    EXPECT_EQ(slope, gain);
  }
}
