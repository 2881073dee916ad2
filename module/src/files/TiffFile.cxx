// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "files/FrameReader.h"
#include "files/TiffDirectory.h"
#include "files/TiffPage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>

namespace sensornoise
{
namespace
{
/** Returns the number of planes of a MetaMorph file, which lists only one of them as a page; 0: no number is given. */
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
}

/** State of reading a TIFF along its chain of pages. */
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
    std::copy(m_First.spacing.begin(), m_First.spacing.end(), m_File.geometry.spacing.begin());
    const std::uint64_t images = ImagesOfImageJ(m_Description).value_or(m_Frames);
    if (m_Frames == 1 && images > 1)
    {
      ReadDescribedFrames(images);
    }
    RequireAllPages();
    m_Strips.RequireAllBytes(m_File.name);
    if (!m_File.reader)
    {
      m_File.reader = std::make_shared<TiffFrames>(std::move(m_Directories));
    }
    SetAxes();
  }

private:
  void
  CheckOffset(const std::string & page, std::uint64_t offset)
  {
    if (!m_Seen.insert(offset).second)
    {
      throw FileError(page,
                      "damaged: its directory is also the directory of an earlier page, so that the pages have no end");
    }
    if (m_Pages > 0 && !m_Bytes.Holds(offset, 2))
    {
      throw FileError(m_File.name,
                      "truncated: " + std::to_string(m_Pages) +
                        " of its pages can be read, but the file says that more follow");
    }
  }

  /** Reads a page that is no thumbnail. Returns where the next page's directory is. */
  std::uint64_t
  ReadPage(const std::string & page, std::uint64_t offset)
  {
    const TiffDirectory directory = m_Tiff.ReadDirectory(page, offset);
    m_Strips.AddDirectory(page, directory);
    if (m_Frames > 0 && IsThumbnail(page, m_Tiff, directory, m_First.width, m_First.height))
    {
      return directory.next;
    }
    m_Directories.push_back(offset);
    const TiffPage found = ReadTiffPage(page, m_Tiff, directory);
    if (m_Frames++ == 0)
    {
      m_First = found;
      m_File.pixel = found.pixel;
      m_File.stored = found.stored;
      m_Description = DescriptionOf(m_Tiff, directory);
      m_Planes = PlanesOfMetaMorph(directory);
    }
    RequireSamePage(page, found, m_First);
    SetFrameSizes(m_File, { m_First.width, m_First.height, m_Frames });
    if (found.compression != TiffCompression::None && m_BeforeInflating)
    {
      m_BeforeInflating(m_File);
    }
    m_Strips.CheckPage(page, found);
    m_Reduced += found.isReduced ? 1 : 0;
    WarnOfOrientation(found);
    return directory.next;
  }

  /** The pixels are read as they are stored: a row of the file is a row of the sensor, and a mosaic stays in its phase.
   */
  void
  WarnOfOrientation(const TiffPage & found)
  {
    if (found.orientation != 1 && m_File.warning.empty())
    {
      m_File.warning = "its Orientation is " + std::to_string(found.orientation) +
                       ", so that viewers turn or mirror the frame. It is measured as it is stored, row by row: give "
                       "regions, masks and the Bayer pattern of the stored frame";
    }
  }

  /** ImageJ writes a stack above 4 GiB as one page and says in words how many images follow it, one after the other. */
  void
  ReadDescribedFrames(std::uint64_t images)
  {
    TiffBytes::Numbers offsets(m_Tiff, m_First.chunks.offsets);
    FramePlaces        places;
    places.path = m_File.name;
    places.offset = offsets.Next();
    places.sample.pixel = m_First.pixel;
    places.sample.stored = m_First.stored;
    places.sample.isBigEndian = m_Tiff.IsBigEndian();
    const std::uint64_t                frame = StoredBytesOf(m_File);
    const std::optional<std::uint64_t> all = CheckedProduct(frame, images);
    const bool                         isOneRun =
      m_First.compression == TiffCompression::None && !m_First.chunks.isTiled && m_First.chunks.Count() == 1;
    const bool isThere = isOneRun && all && m_Bytes.Holds(places.offset, *all);
    if (!isThere || m_Bytes.Size() - places.offset - *all >= frame) // programs may leave some words at the end
    {
      throw FileError(m_File.name,
                      "pages: 1, but ImageJ's description of it says images=" + std::to_string(images) +
                        ", which need " + (all ? std::to_string(*all) : "too many") + " bytes from byte " +
                        std::to_string(places.offset) + " on, without compression, and the file has " +
                        std::to_string(m_Bytes.Size()) + "; expected all of them" + RawLayoutOf(places));
    }
    m_Strips.AddPixels(m_File.name, places.offset + frame, *all - frame);
    SetFramePlaces(m_File, places, places.offset + *all, images);
    m_Described = images;
  }

  /** Returns the layout (--raw) that reads the whole frames from an offset on. */
  std::string
  RawLayoutOf(const FramePlaces & places) const
  {
    const bool isInteger = m_First.pixel != FramePixel::Float &&
                           (m_First.pixel != FramePixel::Double || m_First.stored != StoredNumber::SameAsPixel);
    const bool        isSigned = m_First.pixel == FramePixel::Short || m_First.stored == StoredNumber::Int;
    const std::size_t bytes = SizeOf(m_First.pixel, m_First.stored);
    const std::string type = (isInteger ? (isSigned ? "int" : "uint") : "float") + std::to_string(8 * bytes) +
                             (bytes == 1                  ? ""
                              : places.sample.isBigEndian ? "be"
                                                          : "le");
    const std::uint64_t rest = (m_Bytes.Size() - places.offset) % std::max<std::uint64_t>(1, StoredBytesOf(m_File));
    return m_First.compression != TiffCompression::None || m_First.chunks.isTiled
             ? ""
             : ", or what is there: --raw " + std::to_string(m_First.width) + "x" + std::to_string(m_First.height) +
                 ":" + type + ":" + std::to_string(places.offset) + (rest == 0 ? "" : ":0:0:" + std::to_string(rest));
  }

  /** Sets the axes beside time in which the pages differ. */
  void
  SetAxes()
  {
    std::vector<FrameAxis> axes = AxesOfDescription(m_File.name, m_Description);
    if (axes.empty() || m_File.frames == 1)
    {
      return;
    }
    std::optional<std::uint64_t> planes = 1;
    for (const FrameAxis & axis : axes)
    {
      planes = planes ? CheckedProduct(*planes, axis.size) : planes;
    }
    if (planes != m_File.frames)
    {
      throw FileError(m_File.name,
                      "pages: " + std::to_string(m_File.frames) + ", but its description has axes for " +
                        (planes ? std::to_string(*planes) : "more") +
                        " of several channels, planes or times; expected as many pages");
    }
    m_File.axes = std::move(axes);
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
    if (m_Frames > 1 && m_Reduced > 0)
    {
      throw FileError(m_File.name,
                      pages + std::to_string(m_Reduced) +
                        " of them marked as thumbnails or masks (NewSubfileType); expected frames alone");
    }
    const std::optional<std::uint64_t> images = ImagesOfImageJ(m_Description);
    if (images && *images != m_Frames && *images != m_Described)
    {
      throw FileError(m_File.name,
                      pages + "but ImageJ's description of it says images=" + std::to_string(*images) +
                        "; expected as many pages");
    }
    if (m_Planes > m_Frames)
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
  std::vector<std::uint64_t>        m_Directories{}; // offsets of the directories of the pages [bytes]
  TiffPage                          m_First{};
  std::string                       m_Description{};  // description of the first page
  std::uint64_t                     m_Described{ 0 }; // frames that are no pages
  std::uint64_t                     m_Planes{ 0 };
  std::uint64_t                     m_Pages{ 0 };  // number of pages in the chain of directories
  std::uint64_t                     m_Frames{ 0 }; // pages that are no thumbnails
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
