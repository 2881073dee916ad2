// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/files/TiffFile.h"

#include "sensornoise/files/FileError.h"
#include "sensornoise/files/FrameSizes.h"
#include "sensornoise/files/TiffDirectory.h"
#include "sensornoise/files/TiffFrames.h"
#include "sensornoise/files/TiffPage.h"
#include "sensornoise/files/TiffStrips.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

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

/** How many planes MetaMorph says that there are, of which it lists one as a page; 0 where it says nothing. */
std::uint64_t
PlanesOfMetaMorph(const TiffDirectory & directory)
{
  const TiffEntry * const entry = directory.Find(33629);
  return entry == nullptr ? 0 : entry->count;
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
  if (found.pixel != first.pixel || found.stored != first.stored)
  {
    throw FileError(page,
                    SamplesOf(found) + " samples, but the first page has " + SamplesOf(first) +
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

/** What is read from a TIFF on the way along its chain of pages. */
class TiffInspection
{
public:
  TiffInspection(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
    : m_Bytes(bytes)
    , m_File(file)
    , m_BeforeInflating(beforeInflating)
    , m_Tiff(file.name, bytes)
    , m_Strips(m_Tiff)
  {}

  void
  Run()
  {
    std::uint64_t offset = m_Tiff.FirstDirectory();
    for (; offset != 0; ++m_Pages)
    {
      const std::string page = m_Pages == 0 ? m_File.name : m_File.name + ", page " + std::to_string(m_Pages);
      CheckOffset(page, offset);
      offset = ReadPage(page, offset);
    }
    RequireAllPages();
    m_Strips.RequireAllBytes(m_File.name);
    m_File.spacing = m_First.spacing;
    m_File.reader = std::make_shared<TiffFrames>(std::move(m_Directories));
  }

private:
  void
  CheckOffset(const std::string & page, std::uint64_t offset)
  {
    if (!m_Seen.insert(offset).second)
    {
      throw FileError(page, "damaged: its directory is that of a page before, so that its pages have no end");
    }
    if (m_Pages == MaximumPages)
    {
      throw FileError(page, "has more than " + std::to_string(MaximumPages) + " pages; expected no more");
    }
    if (m_Pages > 0 && !m_Bytes.Holds(offset, 2))
    {
      throw FileError(m_File.name,
                      "truncated: " + std::to_string(m_Pages) +
                        " of its pages can be read, but the file says that more follow");
    }
  }

  /** Returns where the next page's directory is. */
  std::uint64_t
  ReadPage(const std::string & page, std::uint64_t offset)
  {
    const TiffDirectory directory = m_Tiff.ReadDirectory(page, offset);
    m_Directories.push_back(offset);
    m_Strips.AddDirectory(page, directory);
    const TiffPage found = ReadTiffPage(page, m_Tiff, directory);
    if (m_Pages == 0)
    {
      m_First = found;
      m_File.pixel = found.pixel;
      m_File.stored = found.stored;
      m_Images = ImagesOfImageJ(m_Tiff, directory);
      m_Planes = PlanesOfMetaMorph(directory);
    }
    RequireSamePage(page, found, m_First);
    SetFrameSizes(m_File, { m_First.width, m_First.height, m_Pages + 1 });
    if (found.compression != TiffCompression::None && m_BeforeInflating)
    {
      m_BeforeInflating(m_File);
    }
    m_Strips.CheckPage(page, found);
    m_Reduced += found.isReduced ? 1 : 0;
    return directory.next;
  }

  /** Throws unless each page is a frame, and no program says that there are more. */
  void
  RequireAllPages() const
  {
    const std::string pages = "pages: " + std::to_string(m_Pages) + ", ";
    if (m_Pages == 0)
    {
      throw FileError(m_File.name, "damaged: a TIFF without a page; expected at least one");
    }
    if (m_Pages > 1 && m_Reduced > 0)
    {
      throw FileError(m_File.name,
                      pages + "of which " + std::to_string(m_Reduced) +
                        " are said to be thumbnails or masks (NewSubfileType); expected frames alone");
    }
    // ImageJ writes a stack above 4 GiB as one page and says in words how many follow
    if (!m_Images.empty() && std::strtoull(m_Images.c_str() + 7, nullptr, 10) != m_Pages)
    {
      throw FileError(m_File.name, pages + "but ImageJ's description of it says " + m_Images);
    }
    if (m_Planes > m_Pages)
    {
      throw FileError(m_File.name,
                      pages + "but MetaMorph's description of it says " + std::to_string(m_Planes) + " planes");
    }
  }

  FileBytes &                       m_Bytes;
  FrameFile &                       m_File;
  const BeforeInflating &           m_BeforeInflating;
  TiffBytes                         m_Tiff;
  TiffStrips                        m_Strips;
  std::unordered_set<std::uint64_t> m_Seen{};
  std::vector<std::uint64_t>        m_Directories{}; // of the pages
  TiffPage                          m_First{};
  std::string                       m_Images{};
  std::uint64_t                     m_Planes{ 0 };
  std::uint64_t                     m_Pages{ 0 };
  std::uint64_t                     m_Reduced{ 0 };
};
} // namespace

bool
IsHeadOfTiff(const std::string & head, const std::string & /*name*/)
{
  return TiffBytes::IsTiff(reinterpret_cast<const unsigned char *>(head.data()), head.size());
}

void
InspectTiff(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
{
  TiffInspection(bytes, file, beforeInflating).Run();
}

} // namespace sensornoise
