// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_PageTestHelper_h
#define sensornoise_test_PageTestHelper_h

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

namespace sensornoise::test
{

inline bool
Contains(const std::string & text, const std::string & part)
{
  return text.find(part) != std::string::npos;
}

inline std::size_t
CountOf(const std::string & text, const std::string & part)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
  {
    ++count;
  }
  return count;
}

/** Returns "" if every tag is closed in its order, else the fault. */
inline std::string
FaultOfTags(const std::string & text)
{
  static const std::set<std::string> alone{ "meta", "img", "!DOCTYPE" };
  std::vector<std::string>           open;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1))
  {
    const std::size_t end = text.find('>', at);
    const std::string tag = text.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" /\n", 1));
    if (tag.front() == '/')
    {
      if (open.empty() || tag.substr(1) != open.back())
      {
        return "</" + tag.substr(1) + "> closes " + (open.empty() ? "nothing" : open.back());
      }
      open.pop_back();
    }
    else if (tag.back() != '/' && alone.count(name) == 0)
    {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : open.back() + " stays open";
}

/** Expects that a page has no address of another file, no invalid numbers, and no open tags. */
inline void
ExpectSound(const std::string & page)
{
  EXPECT_EQ(FaultOfTags(page), "");
  for (const char * const part : { "nan", "inf\"", "-inf", "http", "<script", "@import", "url(" })
  {
    const std::size_t at = page.find(part);
    EXPECT_EQ(at, std::string::npos) << page.substr(at - std::min<std::size_t>(at, 60), 120);
  }
}

} // namespace sensornoise::test

#endif
