// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/RawLayout.h"
#include "helpers/CheckoutTestHelper.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>

// The page that measures bursts in a browser, as far as it can be tested without one.

namespace
{
std::string
TextOfPage()
{
  std::ifstream file(SourceFolder() + "/examples/browser/page/index.html");
  return { std::istreambuf_iterator<char>(file), {} };
}

/** Returns the text that an input shows while it is empty. */
std::string
PlaceholderOf(const std::string & page, const std::string & id)
{
  const std::string before = "placeholder=\"";
  const std::size_t element = page.find("<input id=\"" + id + '"');
  const std::size_t begin = page.find(before, element) + before.size();
  return page.substr(begin, page.find('"', begin) - begin);
}
} // namespace

TEST(BrowserPage, TheExampleOfALayoutIsALayout)
{
  const std::string example = PlaceholderOf(TextOfPage(), "raw");
  ASSERT_EQ(example.rfind("640x480", 0), 0U) << example;
  sensornoise::RawLayout layout;
  ASSERT_NO_THROW(layout = sensornoise::ReadRawLayout(example)) << example;
  EXPECT_EQ(layout.width, 640U);
  EXPECT_EQ(layout.height, 480U);
}
