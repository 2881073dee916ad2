// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "browser/BurstMemory.h"
#include "browser/ToolArguments.h"
#include "files/FrameFormats.h"
#include "helpers/CheckoutTestHelper.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

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

TEST(BrowserPage, ArgumentsOfTheToolAreFilesAndOptions)
{
  using namespace sensornoise::browser;
  ToolRequest request;
  request.files = { "a.tif", "my burst/b.tif" };
  EXPECT_EQ(ArgumentsOfTool(request), "a.tif \"my burst/b.tif\"");
  request.dark = { "dark/d.tif", "dark/-e$.tif" };
  request.raw = "640x480:uint16le";
  request.options.method = "published";
  request.options.bayer = "RGGB";
  request.options.bitDepth = 12;
  request.options.offsetDn = 64.5;
  EXPECT_EQ(ArgumentsOfTool(request),
            "a.tif \"my burst/b.tif\" --dark d.tif \"./-e\\$.tif\" --method published --bayer RGGB --bit-depth 12 "
            "--offset 64.5 --raw 640x480:uint16le");
}

TEST(BrowserPage, ManyFilesAreNamedTogether)
{
  using namespace sensornoise::browser;
  const auto arguments = [](const std::vector<std::string> & files) {
    ToolRequest request;
    request.files = files;
    return ArgumentsOfTool(request);
  };
  EXPECT_EQ(arguments({ "b/1.tif", "b/2.tif", "b/3.tif", "b/4.tif", "b/5.tif" }), "b/");
  EXPECT_EQ(arguments({ "1.tif", "2.tif", "3.tif", "4.tif", "5.tif" }), "*.tif");
  EXPECT_EQ(arguments({ "1.tif", "2.png", "3.tif", "4.tif", "5.tif" }), "FRAMES");
}

TEST(BrowserPage, AnErrorForMemoryRepeatsFilesAndOptions)
{
  using namespace sensornoise::browser;
  Burst burst;
  burst.geometry.width = burst.geometry.height = 8000;
  burst.frames = 100;
  burst.arguments = "large.raw --raw 8000x8000:uint16le";
  try
  {
    RequirePageMemory(burst, {});
    FAIL() << "it was not refused";
  }
  catch (const std::runtime_error & error)
  {
    const std::string sentence = error.what();
    EXPECT_NE(sentence.find("estimate-sensor-noise large.raw --raw 8000x8000:uint16le --plot"), std::string::npos)
      << sentence;
  }
}
