// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"
#include "sensornoise/Report.h"
#include "sensornoise/Version.h"

#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
/** Reads one JSON text (RFC 8259) without keeping anything but the names of the outermost object. */
class JsonChecker
{
public:
  explicit JsonChecker(const std::string & text)
    : m_Text(text)
  {
    m_IsValid = this->Value(0);
    this->Blank();
    m_IsValid = m_IsValid && m_At == m_Text.size();
  }
  bool                     m_IsValid{ false };
  std::vector<std::string> m_Names;

private:
  char
  Peek() const
  {
    return m_At < m_Text.size() ? m_Text[m_At] : '\0';
  }
  void
  Blank()
  {
    while (Peek() != '\0' && std::strchr(" \t\r\n", Peek()) != nullptr)
    {
      ++m_At;
    }
  }
  bool
  Take(const std::string & word)
  {
    this->Blank();
    const bool found = m_Text.compare(m_At, word.size(), word) == 0;
    m_At += found ? word.size() : 0;
    return found;
  }
  bool
  Digits()
  {
    const std::size_t first = m_At;
    while (std::isdigit(static_cast<unsigned char>(Peek())) != 0)
    {
      ++m_At;
    }
    return m_At > first;
  }
  bool
  Number()
  {
    m_At += Peek() == '-' ? 1 : 0;
    const bool zero = Peek() == '0';
    if (zero ? !Take("0") : !Digits())
    {
      return false;
    }
    if (Peek() == '.')
    {
      ++m_At;
      if (!Digits())
      {
        return false;
      }
    }
    if (Peek() == 'e' || Peek() == 'E')
    {
      ++m_At;
      m_At += Peek() == '+' || Peek() == '-' ? 1 : 0;
      return Digits();
    }
    return true;
  }
  bool
  String(std::string & content)
  {
    if (!Take("\""))
    {
      return false;
    }
    for (; m_At < m_Text.size() && Peek() != '"'; ++m_At)
    {
      if (static_cast<unsigned char>(Peek()) < 0x20)
      {
        return false;
      }
      if (Peek() == '\\')
      {
        ++m_At;
        if (Peek() == 'u')
        {
          for (int digit = 0; digit < 4; ++digit)
          {
            ++m_At;
            if (std::isxdigit(static_cast<unsigned char>(Peek())) == 0)
            {
              return false;
            }
          }
        }
        else if (Peek() == '\0' || std::strchr("\"\\/bfnrt", Peek()) == nullptr)
        {
          return false;
        }
      }
      content += Peek();
    }
    return Take("\"");
  }
  bool
  Value(int depth)
  {
    this->Blank();
    std::string name;
    if (Peek() != '{' && Peek() != '[')
    {
      return Peek() == '"' ? String(name) : Take("null") || Take("true") || Take("false") || Number();
    }
    const bool isObject = Take("{");
    if (!isObject)
    {
      ++m_At;
    }
    const char * const end = isObject ? "}" : "]";
    if (Take(end))
    {
      return true;
    }
    do
    {
      name.clear();
      if (isObject && !(String(name) && Take(":")))
      {
        return false;
      }
      if (isObject && depth == 0)
      {
        m_Names.push_back(name);
      }
      if (!Value(depth + 1))
      {
        return false;
      }
    } while (Take(","));
    return Take(end);
  }

  const std::string & m_Text;
  std::size_t         m_At{ 0 };
};

/** Returns the JSON text that follows the first occurrence of "name": in the record. */
std::string
TextAfter(const std::string & json, const std::string & name)
{
  const std::size_t at = json.find('"' + name + "\": ");
  return at == std::string::npos ? std::string() : json.substr(at + name.size() + 4);
}

bool
Begins(const std::string & text, const std::string & start)
{
  return text.compare(0, start.size(), start) == 0;
}

Report
FullReport()
{
  Report report;
  report.method = "published";
  report.settings = { { "level", 0.01 }, { "rolling_shutter", std::string("auto") }, { "flag", true } };
  report.frames = 2;
  report.framesDistinct = 2;
  report.width = 4;
  report.height = 3;
  report.bitDepth = 12;
  report.quantisationStepDn = 1.0;
  report.clipLowDn = 0.0;
  report.clipHighDn = 4095.0;
  report.pixels = { 12, 11, 10, 1, 0 };
  report.gain = Quantity::Identified(0.3);
  report.gain.standardError = 0.01;
  report.gain.interval95 = Interval{ 0.28, 0.32 };
  report.offset = Quantity::Without(EstimateStatus::NotIdentifiable);
  report.offset.bracket = Interval{ 22.0, std::nullopt };
  report.flickerSd = Quantity::Without(EstimateStatus::UpperLimit);
  report.covariance = { { { 1.0, 2.0, 3.0 }, { 2.0, 4.0, 5.0 }, { 3.0, 5.0, 6.0 } } };
  report.flicker = { 0.01, -0.01 };
  report.flickerRows = { { 0.1, std::nan(""), -0.1 }, { 0.0, 0.0, 0.0 } };
  report.motion = { { 0.5, -0.5 }, { 0.0, 1e-9 } };
  report.fit.reducedChi2 = 1.02;
  report.affineBaseline = Report::Baseline{ 0.0, 0.31, -3.0 };
  report.quadraticBaseline = Report::Baseline{ 0.25, 0.3, -2.0 };
  report.Warn(WarningCode::NotStatic, "message");
  report.Warn(WarningCode::VarianceNotAffine, "message");
  report.scatter = { { 1.0, 2.0 }, { 3.0, 4.0 }, { 5.0, 6.0 }, { 5, 5 } };
  return report;
}
} // namespace

TEST(SensorNoiseReportJson, CheckerDistinguishesJsonFromOtherText)
{
  for (const std::string text : { "{}", "[1, -0.5e-7, null]", "{\"a\": {\"b\": []}, \"c\": \"\\u0001\\\"\"}\n" })
  {
    EXPECT_TRUE(JsonChecker(text).m_IsValid) << text;
  }
  for (const std::string text : { "{\"a\": }", "[1,]", "{\"a\" 1}", "nan", "[1 2]", "{} {}", "\"\n\"", "1.", "01" })
  {
    EXPECT_FALSE(JsonChecker(text).m_IsValid) << text;
  }
}

TEST(SensorNoiseReportJson, RecordIsValidAndHasAllNamesInOrder)
{
  std::istringstream list(
    "schema version method settings frames frames_distinct frames_left_out width height channel bit_depth "
    "bit_depth_source "
    "quantisation_step clip_low clip_high clip_source pixels gain offset read_noise read_noise_median "
    "read_noise_electrons intercept variance_slope total_intercept flicker_sd vibration covariance flicker "
    "flicker_rows motion noise_correlation linearity fit affine_baseline "
    "quadratic_baseline warnings "
    "scatter");
  const std::vector<std::string> names{ std::istream_iterator<std::string>(list), {} };
  for (const Report & report : { Report(), FullReport() })
  {
    const std::string json = ToJson(report);
    const JsonChecker checker(json);
    EXPECT_TRUE(checker.m_IsValid) << json;
    EXPECT_EQ(checker.m_Names, names);
    EXPECT_EQ(json.back(), '\n');
  }
}

TEST(SensorNoiseReportJson, EmptyReportHasNullsAndFailures)
{
  const std::string json = ToJson(Report());
  EXPECT_TRUE(Begins(TextAfter(json, "schema"), "\"itk-sensornoise-report/1\""));
  EXPECT_TRUE(Begins(TextAfter(json, "version"), std::string("\"") + GetModuleVersion() + "\","));
  for (const char * name : { "bit_depth",
                             "quantisation_step",
                             "clip_low",
                             "clip_high",
                             "matrix",
                             "flicker_rows",
                             "motion",
                             "reduced_chi2",
                             "affine_baseline",
                             "quadratic_baseline" })
  {
    EXPECT_TRUE(Begins(TextAfter(json, name), "null")) << name;
  }
  EXPECT_TRUE(Begins(TextAfter(json, "settings"), "{}"));
  EXPECT_TRUE(Begins(TextAfter(json, "flicker"), "[]"));
  EXPECT_TRUE(Begins(TextAfter(json, "gain"),
                     "{\"value\": null, \"standard_error\": null, \"interval95\": null, \"status\": \"failed\", "
                     "\"unit\": \"DN/e-\", \"bracket\": null}"));
}

TEST(SensorNoiseReportJson, QuantitiesCarryAllTheirMembers)
{
  const std::string json = ToJson(FullReport());
  EXPECT_TRUE(Begins(TextAfter(json, "gain"),
                     "{\"value\": 0.3, \"standard_error\": 0.01, \"interval95\": [0.28, 0.32], "
                     "\"status\": \"identified\", \"unit\": \"DN/e-\", \"bracket\": null}"));
  EXPECT_TRUE(Begins(TextAfter(json, "offset"),
                     "{\"value\": null, \"standard_error\": null, \"interval95\": null, "
                     "\"status\": \"not-identifiable\", \"unit\": \"DN\", \"bracket\": [22, null]}"));
  EXPECT_NE(TextAfter(json, "flicker_sd").find("\"upper-limit\""), std::string::npos);
  EXPECT_TRUE(Begins(TextAfter(json, "settings"), "{\"level\": 0.01, \"rolling_shutter\": \"auto\", \"flag\": true}"));
  EXPECT_TRUE(Begins(TextAfter(json, "of"), "[\"gain\", \"intercept\", \"offset\"], \"matrix\": [[1, 2, 3], [2"));
  EXPECT_TRUE(Begins(TextAfter(json, "flicker_rows"), "[[0.1, null, -0.1], [0, 0, 0]]"));
  EXPECT_TRUE(Begins(TextAfter(json, "motion"), "[[0.5, -0.5], [0, 1e-09]]"));
  EXPECT_TRUE(Begins(TextAfter(json, "affine_baseline"), "{\"gain\": 0.31, \"intercept\": -3}"));
  EXPECT_TRUE(Begins(TextAfter(json, "quadratic_baseline"), "{\"curvature\": 0.25, \"gain\": 0.3, "));
  EXPECT_TRUE(Begins(TextAfter(json, "warnings"),
                     "[{\"code\": \"not-static\", \"severity\": \"note\", \"message\": \"message\"}, "
                     "{\"code\": \"variance-not-affine\", \"severity\": \"error\", "));
  EXPECT_TRUE(Begins(TextAfter(json, "count"), "[5, 5]"));
}

TEST(SensorNoiseReportJson, DoublesReadBackAsTheSameBits)
{
  using Limits = std::numeric_limits<double>;
  for (const double number : { 0.1,
                               1.0 / 3.0,
                               -2.0 / 7e30,
                               1e-300,
                               Limits::max(),
                               Limits::lowest(),
                               Limits::min(),
                               Limits::denorm_min(),
                               4095.0,
                               123456789012345680.0,
                               -0.0 })
  {
    Report report;
    report.gain = Quantity::Identified(number);
    const std::string json = ToJson(report);
    EXPECT_TRUE(JsonChecker(json).m_IsValid) << json;
    const double read = std::strtod(TextAfter(json, "value").c_str(), nullptr);
    EXPECT_EQ(std::memcmp(&read, &number, sizeof(read)), 0) << number;
  }
}

TEST(SensorNoiseReportJson, NumbersThatJsonDoesNotKnowAreNull)
{
  for (const double number : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    Report report;
    report.gain = Quantity::Identified(number);
    report.flicker = { 1.0, number };
    report.affineBaseline = Report::Baseline{ 0.0, number, number };
    const std::string json = ToJson(report);
    EXPECT_TRUE(JsonChecker(json).m_IsValid) << json;
    EXPECT_TRUE(Begins(TextAfter(json, "gain"), "{\"value\": null,"));
    EXPECT_TRUE(Begins(TextAfter(json, "flicker"), "[1, null]"));
    EXPECT_TRUE(Begins(TextAfter(json, "affine_baseline"), "{\"gain\": null, \"intercept\": null}"));
  }
}

TEST(SensorNoiseReportJson, StringsAreEscaped)
{
  Report report;
  report.Warn(WarningCode::NotStatic,
              "a\"b\\c, tab\there\nand\x01"
              "\x1f, \xc3\xa9"); // the last is an e with acute accent in UTF-8
  const std::string json = ToJson(report);
  EXPECT_TRUE(JsonChecker(json).m_IsValid) << json;
  EXPECT_TRUE(Begins(TextAfter(json, "message"), "\"a\\\"b\\\\c, tab\\u0009here\\u000aand\\u0001\\u001f, \xc3\xa9\"}"));
}
