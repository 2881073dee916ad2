// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/WarningCodes.h"
#include "helpers/SentencesTestHelper.h"

#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <string>

using namespace sensornoise;

TEST(SensorNoiseWarningCodes, NamesAreDifferentAndForPrograms)
{
  std::set<std::string> names;
  const std::regex      form("[a-z]+(-[a-z]+)*");
  for (const WarningKind & kind : WarningTable)
  {
    EXPECT_TRUE(std::regex_match(kind.name, form)) << kind.name;
    names.insert(kind.name);
    EXPECT_EQ(&KindOf(kind.code), &kind);
  }
  EXPECT_EQ(names.size(), WarningTable.size());
}

TEST(SensorNoiseWarningCodes, SentencesAreSentences)
{
  const std::set<std::string> severities{ "note", "warning", "error" };
  for (const WarningKind & kind : WarningTable)
  {
    const std::string sentence = kind.sentence;
    EXPECT_TRUE(sentence.front() >= 'A' && sentence.front() <= 'Z') << sentence;
    EXPECT_EQ(sentence.back(), '.') << sentence;
    EXPECT_EQ(sentence.find('|'), std::string::npos) << sentence; // a column of a table
    EXPECT_LE(test::WordsOfLongestSentence(sentence), test::MostWords) << sentence;
    EXPECT_EQ(severities.count(NameOf(kind.severity)), 1u);
  }
}
