// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "files/FrameReader.h"
#include "files/RawCameraFile.h"
#include "files/TiffDirectory.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <memory>

namespace sensornoise
{
namespace
{
bool
IsTiffHead(const std::string & head)
{
  return TiffBytes::IsTiff(reinterpret_cast<const unsigned char *>(head.data()), head.size());
}

/** Returns the kind of a raw file that begins as a TIFF, from the ending of its name; "" for other endings. */
std::string
KindByName(const std::string & name)
{
  const std::size_t point = name.rfind('.');
  std::string       ending = point == std::string::npos ? "" : name.substr(point + 1);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::toupper(c); });
  for (const char * const known : { "3FR",
                                    "ARW",
                                    "CR2",
                                    "DCR",
                                    "DNG",
                                    "ERF",
                                    "FFF",
                                    "IIQ",
                                    "KDC",
                                    "MEF",
                                    "MOS",
                                    "NEF",
                                    "NRW",
                                    "PEF",
                                    "RWL",
                                    "SR2",
                                    "SRF",
                                    "SRW" })
  {
    if (ending == known)
    {
      return ending;
    }
  }
  return "";
}

/** Returns the kind of a raw file that begins as a TIFF; "" for other TIFF files. */
std::string
KindOfTiff(const std::string & head, const std::string & name)
{
  if (head.compare(std::min<std::size_t>(8, head.size()), 2, "CR") == 0)
  {
    return "CR2";
  }
  std::string byName = KindByName(name);
  try
  {
    FileBytes bytes(name);
    switch (RawTiffKindOf(name, bytes))
    {
      case RawTiffKind::Dng:
        return "DNG";
      case RawTiffKind::Mosaic:
        return byName.empty() ? "a TIFF of a mosaic" : byName;
      default:
        return byName;
    }
  }
  catch (const std::exception &)
  {
    return byName; // damaged: its reader reports this
  }
}

/** Returns the kind of the raw file of a camera; "" for other files. */
std::string
KindOf(const std::string & head, const std::string & name)
{
  struct Signature
  {
    std::size_t  at;
    const char * bytes;
    const char * kind;
  };
  static constexpr Signature signatures[] = { { 4, "ftypcrx ", "CR3" }, { 0, "FUJIFILMCCD-RAW", "RAF" },
                                              { 0, "IIRO", "ORF" },     { 0, "IIRS", "ORF" },
                                              { 0, "MMOR", "ORF" },     { 0, "IIU", "RW2" },
                                              { 1, "MRM", "MRW" },      { 6, "HEAPCCDR", "CRW" },
                                              { 0, "FOVb", "X3F" } };
  for (const Signature & signature : signatures)
  {
    if (head.compare(std::min(signature.at, head.size()), std::string(signature.bytes).size(), signature.bytes) == 0)
    {
      return signature.kind;
    }
  }
  return IsTiffHead(head) ? KindOfTiff(head, name) : "";
}

#ifdef SENSORNOISE_LIBRAW
/** Decodes the file again for each reading. */
class RawCameraReader : public FrameReader
{
public:
  void
  Read(const FrameFile & file, std::size_t /*first*/, std::size_t count, void * buffer) const override
  {
    if (count == 0)
    {
      return;
    }
    LibRawFrame frame(file.name);
    if (frame.Width() != file.width || frame.Height() != file.height)
    {
      throw FileError(file.name, "has changed since it was opened: its size differs");
    }
    frame.Decode();
    frame.CopyTo(static_cast<unsigned short *>(buffer));
  }
};
#endif
} // namespace

bool
IsHeadOfRawCamera(const std::string & head, const std::string & name)
{
  return !KindOf(head, name).empty();
}

bool
ReadsRawCameraFiles()
{
#ifdef SENSORNOISE_LIBRAW
  return true;
#else
  return false;
#endif
}

void
InspectRawCamera(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
{
#ifdef SENSORNOISE_LIBRAW
  LibRawFrame frame(file.name);
  file.pixel = FramePixel::UnsignedShort;
  SetFrameSizes(file, { frame.Width(), frame.Height() });
  RequireWholeRawTiff(file.name, bytes, frame.RawWidth(), frame.RawHeight());
  if (beforeInflating)
  {
    beforeInflating(file);
  }
  frame.Decode();
  file.camera = frame.Camera();
  file.reader = std::make_shared<RawCameraReader>();
#else
  static_cast<void>(beforeInflating);
  std::string head(16, '\0');
  head.resize(bytes.ReadSome(0, head.data(), head.size()));
  throw FileError(
    file.name,
    "a raw file of a camera (" + KindOf(head, file.name) +
      "), for which this build has no LibRaw; expected its digital numbers as TIFF (LibRaw's unprocessed_raw -T), "
      "a build with SensorNoise_USE_LibRaw, or in Python pip install itk-sensornoise[raw]");
#endif
}

} // namespace sensornoise
