// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "base/Text.h"

#include <gtest/gtest.h>
#include <string>

using namespace sensornoise;

TEST(SensorNoiseSigns, AreThoseThatPeopleWrite)
{
  EXPECT_EQ(WithSigns("0.474 +- 0.013 DN/e-"), "0.474 \u00B1 0.013 DN/e\u207B");
  EXPECT_EQ(WithSigns("e-"), "e\u207B");
  EXPECT_EQ(WithSigns("[e-] and DN^2"), "[e\u207B] and DN\u00B2");
  EXPECT_EQ(WithSigns("1e-05 of the-like"), "1e-05 of the-like");
  EXPECT_EQ(WithoutSigns(WithSigns("0.474 +- 0.013 DN/e-, 5 DN^2")), "0.474 +- 0.013 DN/e-, 5 DN^2");
}

TEST(SensorNoiseSigns, ColumnsStayInLineWithoutThem)
{
  EXPECT_EQ(WithoutSigns("\u00B1 1   2"), "+- 1  2");
  EXPECT_EQ(WithoutSigns("\u00B1 1 2"), "+- 1 2"); // one blank stays
  EXPECT_EQ(WithoutSigns("\u00B1\na   b"), "+-\na   b");
  Report report;
  report.gain = Quantity::Identified(0.473912);
  report.gain.standardError = 0.0131;
  report.intercept = Quantity::Identified(-46.39);
  report.intercept.standardError = 0.41;
  const std::string table = WithoutSigns(MakeTable(report));
  const std::size_t place = table.find("status") - table.find("quantity");
  for (const char * const label : { "gain g", "offset mu", "intercept sigma^2 - g mu", "total intercept" })
  {
    const std::size_t line = table.find(std::string("\n") + label) + 1;
    const std::size_t status = table.find_first_of("if", line + place); // "identified" or "failed"
    EXPECT_EQ(status - line, place) << table.substr(line, table.find('\n', line) - line);
    EXPECT_EQ(table[line + place - 1], ' ');
  }
}

TEST(SensorNoiseSigns, CountAsOneCharacterEach)
{
  EXPECT_EQ(PaddedRight("\u00B1 1", 5), "\u00B1 1  ");
  EXPECT_EQ(PaddedLeft("e\u207B", 4), "  e\u207B");
  EXPECT_EQ(PaddedLeft("12345", 4), "12345");
  EXPECT_EQ(CharactersIn("\u00B1 e\u207B\u00B2"), 5u);
}

// Values and the ends of intervals have two digits of the error.
TEST(SensorNoiseSigns, TablesRoundToTheError)
{
  const auto lineOf = [](double value, double error, double low, double high) {
    Report report;
    report.gain = Quantity::Identified(value);
    report.gain.standardError = error;
    report.gain.interval95 = Interval{ low, high };
    const std::string table = MakeTable(report);
    const std::size_t start = table.find("gain g");
    const std::string line = table.substr(start, table.find('\n', start) - start);
    return line.substr(line.find_first_not_of(' ', 6));
  };
  EXPECT_EQ(lineOf(0.473912, 0.0131, 0.4477, 0.50012),
            "0.474 \u00B1 0.013      DN/e\u207B    identified        [0.448, 0.500]");
  EXPECT_EQ(lineOf(12345.0, 678.0, 10989.0, 13701.0),
            "12350 \u00B1 680        DN/e\u207B    identified        [10989, 13701]");
  EXPECT_EQ(lineOf(0.0522012, 6.8e-06, 0.052188, 0.052215),
            "0.0522012 \u00B1 0.0000068  DN/e\u207B    identified        [0.0521880, 0.0522150]");
}
