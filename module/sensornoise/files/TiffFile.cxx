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
#include "sensornoise/files/TiffFile.h"

#include "sensornoise/files/FileError.h"
#include "sensornoise/files/FrameSizes.h"
#include "sensornoise/files/TiffDirectory.h"
#include "sensornoise/files/TiffPage.h"
#include "sensornoise/files/TiffStrips.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <unordered_set>

namespace sensornoise
{
namespace
{
// ITK counts pages with 16 bits, and older versions of libtiff go no further.
constexpr std::uint64_t MaximumPages = 65534;

/** How many images ImageJ's description of the first page says there are; empty where there is no such description. */
std::string
ImagesOfImageJ(TiffBytes & tiff, const TiffDirectory & directory)
{
  const TiffEntry * const entry = directory.Find(270);
  if (entry == nullptr || entry->type != 2)
  {
    return "";
  }
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(entry->count, 65536)), '\0');
  tiff.File().Read(entry->offset, text.data(), text.size());
  const std::size_t images = text.rfind("ImageJ=", 0) == 0 ? text.find("\nimages=") : std::string::npos;
  return images == std::string::npos
           ? ""
           : text.substr(images + 1, text.find_first_of(std::string("\n\r\0", 3), images + 1) - images - 1);
}

void
RequireSamePage(const std::string & page, const TiffPage & found, const TiffPage & first)
{
  if (found.width != first.width || found.height != first.height)
  {
    throw FileError(page,
                    std::to_string(found.width) + " x " + std::to_string(found.height) +
                      " pixels, but the first page has " + std::to_string(first.width) + " x " +
                      std::to_string(first.height) + "; all pages must have the same size");
  }
  if (found.pixel != first.pixel)
  {
    throw FileError(page,
                    SamplesOf(found.pixel) + " samples, but the first page has " + SamplesOf(first.pixel) +
                      " ones; all pages must have the same");
  }
  if (found.compression != first.compression || found.predictor != first.predictor)
  {
    throw FileError(page, "compressed in another way than the first page; all pages must be compressed in the same");
  }
  if (found.orientation != first.orientation)
  {
    throw FileError(page,
                    "Orientation is " + std::to_string(found.orientation) + ", but " +
                      std::to_string(first.orientation) + " on the first page; all pages must have the same");
  }
}

/** Throws unless ITK makes as many frames of the pages as there are, which it counts by NewSubfileType. */
void
RequireAllPagesAreFrames(const std::string & file, std::uint64_t pages, std::uint64_t reduced, std::uint64_t full)
{
  if (pages > 1 && reduced > 0)
  {
    throw FileError(file,
                    "pages: " + std::to_string(pages) + ", of which " + std::to_string(reduced) +
                      " are said to be thumbnails or masks (NewSubfileType); expected frames alone");
  }
  if (pages > 1 && full > 0 && full != pages)
  {
    throw FileError(file,
                    "pages: " + std::to_string(pages) + ", but ITK reads " + std::to_string(full) +
                      " frames of them, because NewSubfileType is not the same on all; expected the same");
  }
}
} // namespace

void
InspectTiff(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
{
  TiffBytes                         tiff(file.name, bytes);
  TiffStrips                        strips(tiff);
  std::unordered_set<std::uint64_t> seen;
  TiffPage                          first;
  std::string                       images;
  std::uint64_t                     pages = 0;
  std::uint64_t                     reduced = 0;
  std::uint64_t                     full = 0;
  for (std::uint64_t offset = tiff.FirstDirectory(); offset != 0; ++pages)
  {
    const std::string page = pages == 0 ? file.name : file.name + ", page " + std::to_string(pages);
    if (!seen.insert(offset).second)
    {
      throw FileError(page, "damaged: its directory is that of a page before, so that its pages have no end");
    }
    if (pages == MaximumPages)
    {
      throw FileError(page, "has more than " + std::to_string(MaximumPages) + " pages; expected no more");
    }
    if (pages > 0 && !bytes.Holds(offset, 2))
    {
      throw FileError(file.name,
                      "truncated: " + std::to_string(pages) +
                        " of its pages can be read, but the file says that more "
                        "follow");
    }
    const TiffDirectory directory = tiff.ReadDirectory(page, offset);
    strips.AddDirectory(page, directory);
    const TiffPage found = ReadTiffPage(page, tiff, directory);
    if (pages == 0)
    {
      first = found;
      file.format = FrameFormat::Tiff;
      file.pixel = found.pixel;
      images = ImagesOfImageJ(tiff, directory);
    }
    RequireSamePage(page, found, first);
    SetFrameSizes(file, { first.width, first.height, pages + 1 });
    if (found.compression != TiffCompression::None && beforeInflating)
    {
      beforeInflating(file);
    }
    strips.CheckPage(page, found);
    reduced += found.isReduced ? 1 : 0;
    full += found.isFull ? 1 : 0;
    offset = directory.next;
  }
  if (pages == 0)
  {
    throw FileError(file.name, "damaged: a TIFF without a page; expected at least one");
  }
  RequireAllPagesAreFrames(file.name, pages, reduced, full);
  // ImageJ writes a stack above 4 GiB as one page and says in words how many follow
  if (!images.empty() && std::strtoull(images.c_str() + 7, nullptr, 10) != pages)
  {
    throw FileError(file.name, "pages: " + std::to_string(pages) + ", but ImageJ's description of it says " + images);
  }
  strips.RequireAllBytes(file.name);
}

} // namespace sensornoise
