// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_SentencesTestHelper_h
#define sensornoise_test_SentencesTestHelper_h

#include "page/PageSections.h"
#include "sensornoise/Report.h"

#include <algorithm>
#include <cstddef>
#include <regex>
#include <sstream>
#include <string>

namespace sensornoise::test
{

/** Words that a sentence of a message has at most: longer ones have to be read twice. */
inline constexpr std::size_t MostWords = 40;

/** Returns the number of words, numbers and signs of the longest sentence of \a text. */
inline std::size_t
WordsOfLongestSentence(const std::string & text)
{
  const std::regex           end("[.?] +(?=[A-Z])");
  std::sregex_token_iterator sentence(text.begin(), text.end(), end, -1);
  std::size_t                most = 0;
  for (; sentence != std::sregex_token_iterator(); ++sentence)
  {
    std::istringstream words(sentence->str());
    std::size_t        count = 0;
    for (std::string word; words >> word;)
    {
      ++count;
    }
    most = std::max(most, count);
  }
  return most;
}

/** Returns whether the message itself ends with an action, as a command: "...: give the offset (--offset)". */
inline bool
HasAction(const Warning & warning)
{
  std::string action = SplitWarning(warning).action;
  if (action.size() < 2)
  {
    return false;
  }
  action = action.substr(1, action.size() - 2); // without its first letter and the full stop
  const std::string & text = warning.message;
  return text.size() > action.size() && text.compare(text.size() - action.size(), std::string::npos, action) == 0;
}

} // namespace sensornoise::test

#endif
