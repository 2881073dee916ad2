// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"
#include "base/Text.h"
#include "report/Quantities.h"

#include <gtest/gtest.h>
#include <cmath>
#include <set>
#include <string>

using namespace sensornoise;

namespace
{
Report
ReportWithNoise()
{
  Report report;
  report.noiseCorrelation.emplace();
  return report;
}
} // namespace

TEST(SensorNoiseQuantityList, EveryEntryIsAnotherQuantity)
{
  const Report               report = ReportWithNoise();
  std::set<std::string>      names;
  std::set<const Quantity *> quantities;
  for (const QuantityEntry & entry : QuantityList())
  {
    names.insert(entry.path);
    names.insert(std::string("label ") + entry.label);
    quantities.insert(entry.of(report));
    EXPECT_EQ(std::string(entry.meaning).back(), '.') << entry.path;
  }
  EXPECT_EQ(names.size(), 2 * QuantityList().size());
  EXPECT_EQ(quantities.size(), QuantityList().size());
  EXPECT_EQ(quantities.count(nullptr), 0u);
}

TEST(SensorNoiseQuantityList, RecordHasEveryQuantityWithItsUnit)
{
  const std::string json = ToJson(ReportWithNoise());
  for (const QuantityEntry & entry : QuantityList())
  {
    // From object to object along the path, then the first unit.
    std::size_t at = 0;
    std::string path = std::string(entry.path) + ".";
    for (std::size_t dot = path.find('.'); dot != std::string::npos; path.erase(0, dot + 1), dot = path.find('.'))
    {
      at = json.find("\"" + path.substr(0, dot) + "\": {", at);
      ASSERT_NE(at, std::string::npos) << entry.path;
    }
    at = json.find("\"unit\": ", at);
    EXPECT_EQ(json.substr(at + 8, std::string(entry.unit).size() + 2), std::string("\"") + entry.unit + "\"")
      << entry.path;
  }
}

TEST(SensorNoiseQuantityList, TableHasALineForWhatEveryTableShows)
{
  const std::string table = MakeTable(Report());
  for (const QuantityEntry & entry : QuantityList())
  {
    EXPECT_EQ(table.find("\n" + WithSigns(entry.label) + "  ") != std::string::npos, entry.shown == ShownIn::EveryTable)
      << entry.label << '\n'
      << table;
  }
}

TEST(SensorNoiseQuantities, RootHasTheRootOfTheSquaresInterval)
{
  // 9 +- 0.6: d sqrt(s) = ds / (2 sqrt(s)).
  const Quantity root = RootOf(9.0, 0.6, 2.0);
  EXPECT_EQ(root.status, EstimateStatus::Identified);
  EXPECT_DOUBLE_EQ(*root.value, 3.0);
  EXPECT_DOUBLE_EQ(*root.standardError, 0.1);
  EXPECT_DOUBLE_EQ(*root.interval95->low, std::sqrt(9.0 - 1.2));
  EXPECT_DOUBLE_EQ(*root.interval95->high, std::sqrt(9.0 + 1.2));
  EXPECT_FALSE(root.bracket);
}

TEST(SensorNoiseQuantities, RootOfWhatMayBeZeroIsAnUpperLimit)
{
  const Quantity limit = RootOf(1.0, 0.5, 2.0); // the interval's lower end is 0
  EXPECT_EQ(limit.status, EstimateStatus::UpperLimit);
  EXPECT_FALSE(limit.value);
  EXPECT_FALSE(limit.standardError);
  EXPECT_DOUBLE_EQ(*limit.interval95->low, 0.0);
  EXPECT_DOUBLE_EQ(*limit.interval95->high, std::sqrt(2.0));
  EXPECT_EQ(limit.bracket->high, limit.interval95->high);
  EXPECT_EQ(RootOf(1.0, 0.4999, 2.0).status, EstimateStatus::Identified);
}

TEST(SensorNoiseQuantities, NoiseThatCarriedTheSquareBelowZeroDoesNotLowerTheLimit)
{
  EXPECT_EQ(RootOf(-3.0, 0.5, 2.0).interval95->high, RootOf(0.0, 0.5, 2.0).interval95->high);
  EXPECT_DOUBLE_EQ(*RootOf(-3.0, 0.5, 2.0).interval95->high, 1.0);
  EXPECT_EQ(RootOf(std::nan(""), 0.5, 2.0).status, EstimateStatus::UpperLimit);
}

TEST(SensorNoiseQuantities, ParametersOfTheSensorGoTogether)
{
  Report report;
  report.flickerSd = WithError(0.1, 0.01);
  for (Quantity * quantity : { &report.gain, &report.offset, &report.readNoise, &report.totalIntercept })
  {
    *quantity = WithError(1.0, 0.1);
  }
  SetSensorParameters(report, EstimateStatus::NotIdentifiable);
  for (const QuantityEntry & entry : QuantityList())
  {
    const bool isOfTheSensor = std::string(entry.path).find_first_of(".") == std::string::npos &&
                               std::string(entry.path) != "flicker_sd" && entry.of(report) != nullptr;
    if (isOfTheSensor)
    {
      EXPECT_EQ(entry.of(report)->status, EstimateStatus::NotIdentifiable) << entry.path;
      EXPECT_FALSE(entry.of(report)->value || entry.of(report)->interval95) << entry.path;
    }
  }
  EXPECT_EQ(report.flickerSd.status, EstimateStatus::Identified);
}
