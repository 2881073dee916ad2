/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "helpers/FrameInputTestHelper.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace
{
using namespace sensornoise::test;
using sensornoise::tools::FrameInput;
using sensornoise::tools::OpenFrames;

/** TIFF files that ITK would convert, or read in part. */
class TiffCompletenessTool : public FrameInputTest
{};

/** One entry of a TIFF directory with a single value. */
struct Tag
{
  unsigned int number;
  unsigned int value;
};

/** A little-endian TIFF of pages of 8 x 4 pixels and 128 bytes, with what a page says beyond that or otherwise. */
std::string
TiffWith(const std::vector<std::vector<Tag>> & pages)
{
  std::string bytes;
  const auto  add = [&bytes](std::size_t value, int width) {
    for (; width > 0; --width, value >>= 8)
    {
      bytes += static_cast<char>(value & 255);
    }
  };
  add(0x002A4949, 4);
  add(8, 4);
  for (const std::vector<Tag> & page : pages)
  {
    std::map<unsigned int, unsigned int> tags{
      { 256, 8 }, { 257, 4 }, { 258, 16 }, { 259, 1 }, { 262, 1 }, { 277, 1 }
    };
    for (const Tag & tag : page)
    {
      tags[tag.number] = tag.value;
    }
    const bool        tiled = tags.count(322) != 0;
    const std::size_t end = bytes.size() + 2 + 12 * (tags.size() + 2) + 4;
    tags[tiled ? 324 : 273] = static_cast<unsigned int>(end);
    tags[tiled ? 325 : 279] = 128;
    add(tags.size(), 2);
    for (const auto & [number, value] : tags)
    {
      add(number, 2);
      add(4, 2); // type: 32 bits
      add(1, 4);
      add(value, 4);
    }
    add(&page == &pages.back() ? 0 : end + 128, 4);
    bytes.append(128, '\1');
  }
  return bytes;
}

TEST_F(TiffCompletenessTool, ATiffThatITKWouldConvertIsRefused)
{
  const FrameInput good = OpenFrames({ WriteText("good.tif", TiffWith({ {}, {}, {} })) });
  EXPECT_EQ(good.frames, 3u);
  const auto isRefused = [this](const std::vector<std::vector<Tag>> & pages, const std::vector<std::string> & parts) {
    OpeningIsRefusedWith({ WriteText("page.tif", TiffWith(pages)) }, parts);
  };
  isRefused({ { { 258, 32 } } }, { "page.tif", "component type unsigned int is not supported" });
  isRefused({ { { 258, 32 }, { 339, 2 } } }, { "page.tif", "component type int is not supported" });
  isRefused({ { { 339, 3 } } }, { "page.tif", "16-bit floating-point" });
  isRefused({ { { 258, 4 } } }, { "page.tif", "4-bit unsigned" });
  isRefused({ { { 258, 12 } } }, { "page.tif", "12-bit" });
  isRefused({ { { 322, 16 }, { 323, 16 } } }, { "page.tif", "tiled" });
  isRefused({ {}, { { 256, 4 } } }, { "page.tif, page 1", "4 x 4 pixels", "8 x 4" });
  isRefused({ {}, { { 258, 32 }, { 339, 3 } } }, { "page.tif, page 1", "32-bit floating-point", "unsigned_short" });
  isRefused({ {}, {}, { { 254, 1 } } }, { "page.tif", "pages: 3", "2 frames" });
  isRefused({ { { 257, 40 } } }, { "page.tif", "truncated: its strip 0 is at bytes 110 to 750", "the file has 238" });
}

/** Lets the entry of the first page that stands for a longer value point to that value, at the end of the file. */
std::string
TiffWithValueAtTheEnd(std::string tiff, Tag entry, unsigned int type, unsigned int count, const std::string & value)
{
  const std::string head{ static_cast<char>(entry.number & 255), static_cast<char>(entry.number >> 8), 4, 0 };
  const std::size_t at = tiff.find(head);
  tiff[at + 2] = static_cast<char>(type);
  tiff[at + 4] = static_cast<char>(count & 255);
  tiff[at + 5] = static_cast<char>(count >> 8);
  tiff[at + 8] = static_cast<char>(tiff.size() & 255);
  tiff[at + 9] = static_cast<char>(tiff.size() >> 8);
  return tiff + value;
}

TEST_F(TiffCompletenessTool, ATiffWithPagesOnlyImageJKnowsIsRefused)
{
  const std::string text("ImageJ=1.54\nimages=500\nslices=500\n\0", 35);
  const std::string tiff = TiffWithValueAtTheEnd(TiffWith({ { { 270, 0 } } }), { 270, 0 }, 2, text.size(), text);
  OpeningIsRefusedWith({ WriteText("imagej.tif", tiff) }, { "imagej.tif", "pages: 1", "images=500" });
}

TEST_F(TiffCompletenessTool, ATiffWithAPaletteIsRefused)
{
  // grey, but other greys than the pixels: ITK would read the palette's
  const std::string palette(3 * 256 * 2, '\0');
  const std::string page = TiffWith({ { { 258, 8 }, { 262, 3 }, { 320, 0 } } });
  const std::string tiff = TiffWithValueAtTheEnd(page, { 320, 0 }, 3, 3 * 256, palette);
  OpeningIsRefusedWith({ WriteText("palette.tif", tiff) }, { "palette.tif", "palette of colours" });
}

} // namespace
