// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/NoiseExport.h"
#include "sensornoise/WarningCodes.h"
#include "sensornoise/ReportText.h"
#include "helpers/CheckoutTestHelper.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>
#include <string>

// The documentation and the tests mention every warning and every quantity.

using namespace sensornoise;

namespace
{
std::string
TextOfFile(const std::filesystem::path & name)
{
  std::ifstream file(name);
  EXPECT_TRUE(file.is_open()) << name;
  return { std::istreambuf_iterator<char>(file), {} };
}

/** Returns the first cells, in backquotes, of the rows of the table of \a document whose head begins with \a head. */
std::set<std::string>
FirstCells(const std::string & document, const std::string & head)
{
  std::set<std::string> cells;
  std::size_t           at = document.find("\n" + head);
  EXPECT_NE(at, std::string::npos) << head;
  for (at = document.find('\n', at + 1) + 1; document[at] == '|'; at = document.find('\n', at) + 1)
  {
    if (document.compare(at, 3, "| `") == 0)
    {
      cells.insert(document.substr(at + 3, document.find('`', at + 3) - at - 3));
    }
  }
  return cells;
}
} // namespace

TEST(SensorNoiseDocuments, DocumentationHasTheTableOfWarnings)
{
  const std::string     document = TextOfFile(SourceFolder() + "/documentation/reference/warnings.md");
  std::set<std::string> names;
  for (const WarningKind & kind : WarningTable)
  {
    names.insert(kind.name);
    const std::string row =
      std::string("\n| `") + kind.name + "` | " + NameOf(kind.severity) + " | " + kind.sentence + " |\n";
    EXPECT_NE(document.find(row), std::string::npos) << "warnings.md lacks this row:" << row;
  }
  EXPECT_EQ(FirstCells(document, "| code |"), names);
}

TEST(SensorNoiseDocuments, DocumentationHasTheListOfQuantities)
{
  const std::string     document = TextOfFile(SourceFolder() + "/documentation/reference/quantities.md");
  std::set<std::string> paths;
  for (const QuantityEntry & entry : QuantityList())
  {
    paths.insert(entry.path);
    const std::string row =
      std::string("\n| `") + entry.path + "` | " + entry.label + " | " + entry.unit + " | " + entry.meaning + " |";
    EXPECT_NE(document.find(row), std::string::npos) << "quantities.md lacks this row:" << row;
  }
  EXPECT_EQ(FirstCells(document, "| quantity |"), paths);
}

TEST(SensorNoiseDocuments, DocumentationHasTheTableOfExportFormats)
{
  const std::string     document = TextOfFile(SourceFolder() + "/documentation/reference/exports.md");
  std::set<std::string> names;
  for (const ExportFormat & format : ExportFormats())
  {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    const std::string row = std::string("\n| `") + format.name + "` | " + format.consumer + " | " +
                            NameOf(format.takes) + " | " + NameOf(format.exactness) + " | " + format.fields + " |\n";
    EXPECT_NE(document.find(row), std::string::npos) << "exports.md lacks this row:" << row;
    EXPECT_NE(document.find("\n## " + std::string(format.name) + "\n"), std::string::npos)
      << "exports.md does not say how " << format.name << " is used";
  }
  EXPECT_EQ(FirstCells(document, "| format |"), names);
}

TEST(SensorNoiseDocuments, EveryWarningOccursInATest)
{
  // By its name in C++, or by the name of the record in tests of the tools and of Python.
  std::string tests;
  for (const char * folder : { "/test", "/wrapping/test" })
  {
    for (const auto & entry : std::filesystem::recursive_directory_iterator(SourceFolder() + folder))
    {
      const std::filesystem::path extension = entry.path().extension();
      if (extension == ".cxx" || extension == ".h" || extension == ".py")
      {
        tests += TextOfFile(entry.path());
      }
    }
  }
  const std::string table = TextOfFile(SourceFolder() + "/module/include/sensornoise/WarningCodes.h");
  const std::regex  line("(WarningCode::[A-Za-z]+),\\s*(\"[a-z-]+\")");
  std::size_t       codes = 0;
  for (std::sregex_iterator match(table.begin(), table.end(), line), end; match != end; ++match)
  {
    const bool isProvoked =
      tests.find((*match)[1].str() + ")") != std::string::npos || tests.find((*match)[2]) != std::string::npos;
    EXPECT_TRUE(isProvoked) << "no test provokes " << (*match)[2];
    ++codes;
  }
  EXPECT_EQ(codes, WarningTable.size());
}
