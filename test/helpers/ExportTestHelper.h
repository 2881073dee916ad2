// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ExportTestHelper_h
#define ExportTestHelper_h

#include "sensornoise/NoiseExport.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <vector>

/** A stored report of one channel, as a camera of g = 0.5 DN/e-, mu = 64.5 DN, sigma = 1.5 DN has it. */
class ExportTest : public ::testing::Test
{
protected:
  static constexpr double gain = 0.5;
  static constexpr double offset = 64.5;
  static constexpr double readNoise = 1.5;
  static constexpr double slope = 0.5;
  static constexpr double intercept = readNoise * readNoise - gain * offset + 1.0 / 12.0;
  static constexpr double black = 64.0;
  static constexpr double white = 4095.0;

  void
  SetUp() override
  {
    m_Report.name = "report.json";
    m_Report.texts["/schema"] = "itk-sensornoise-report/1";
    this->AddChannel("", "mono", slope, intercept);
    m_Report.numbers["/camera/black_level"] = black;
    m_Report.numbers["/camera/white_level"] = white;
    m_Report.numbers["/camera/bit_depth"] = 12;
  }

  void
  AddChannel(const std::string & at, const std::string & name, double slopeDn, double interceptDn2)
  {
    m_Report.texts[at + "/channel"] = name;
    this->SetQuantity(at + "/variance_slope", slopeDn);
    this->SetQuantity(at + "/total_intercept", interceptDn2);
    this->SetQuantity(at + "/gain", gain);
    this->SetQuantity(at + "/offset", offset);
    this->SetQuantity(at + "/read_noise", readNoise);
    m_Report.numbers[at + "/gain/standard_error"] = 0.001;
    m_Report.numbers[at + "/read_noise_electrons/standard_error"] = 0.02;
    m_Report.numbers[at + "/clip_high"] = 4000.0;
    m_Report.numbers[at + "/scatter/mean/0"] = 100.0;
    m_Report.numbers[at + "/scatter/mean/1"] = 3000.0;
  }
  void
  SetQuantity(const std::string & at, double value)
  {
    m_Report.numbers[at + "/value"] = value;
    m_Report.texts[at + "/status"] = "identified";
  }
  void
  RemoveQuantity(const std::string & at, const std::string & status)
  {
    m_Report.numbers.erase(at + "/value");
    m_Report.texts[at + "/status"] = status;
  }

  /** Makes a mosaic, whose channels have slopes of 0.5, 0.6, 0.7 and 0.8 DN/e-. */
  void
  MakeMosaic()
  {
    const std::vector<std::string> names{ "R", "G1", "G2", "B" };
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      this->AddChannel("/channels/" + std::to_string(i), names[i], MosaicSlope(i), MosaicIntercept(i));
    }
  }
  static double
  MosaicSlope(std::size_t channel)
  {
    return 0.5 + 0.1 * static_cast<double>(channel);
  }
  static double
  MosaicIntercept(std::size_t channel)
  {
    return 3.0 - MosaicSlope(channel) * offset;
  }

  sensornoise::NoiseExport
  Export(const std::string & format, const sensornoise::ExportSettings & settings = {}) const
  {
    return sensornoise::ExportNoise(format, { sensornoise::ReadCameraNoise(m_Report, settings) });
  }
  /** Returns the only file of an export. */
  std::string
  TextOf(const std::string & format, const sensornoise::ExportSettings & settings = {}) const
  {
    const sensornoise::NoiseExport made = this->Export(format, settings);
    EXPECT_EQ(made.files.size(), 1U);
    return made.files.empty() ? "" : made.files.front().bytes;
  }
  void
  IsRefused(const std::string &                 format,
            const std::vector<std::string> &    parts,
            const sensornoise::ExportSettings & settings = {}) const
  {
    SCOPED_TRACE(format);
    try
    {
      this->Export(format, settings);
      ADD_FAILURE() << "was exported";
    }
    catch (const sensornoise::ExportError & error)
    {
      for (const std::string & part : parts)
      {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << " is not in: " << error.what();
      }
    }
  }

  /** Returns the number behind the first \a key of a text; NaN: there is none. */
  static double
  NumberAfter(const std::string & text, const std::string & key)
  {
    const std::size_t at = text.find(key);
    return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + key.size(), nullptr);
  }

  /** Compares a variance of a consumer [DN^2], a function of the level, with the line a x + b: to 1e-6. */
  template <typename TVariance>
  static void
  IsTheLine(TVariance variance, double slopeDn = slope, double interceptDn2 = intercept)
  {
    for (const double level : { 100.0, 500.0, 2000.0, 4000.0 })
    {
      const double expected = slopeDn * level + interceptDn2;
      EXPECT_NEAR(variance(level), expected, 1e-6 * expected) << "at the level " << level;
    }
  }

  sensornoise::StoredReport m_Report;
};

#endif
