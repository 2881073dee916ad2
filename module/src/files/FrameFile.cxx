// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameFile.h"

#include "base/Text.h"
#include "files/FileBytes.h"
#include "files/FrameFormats.h"
#include "files/FrameReader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace sensornoise
{

FileError::FileError(const std::string & file, const std::string & what)
  : std::runtime_error(OneLine(file + ": " + what))
{}

namespace
{
/** Returns words for a file in no supported format: the name of its format, if its first bytes identify it. */
std::string
OtherFormat(const std::string & head, const std::string & name)
{
  struct Signature
  {
    std::size_t  at;
    const char * bytes;
    const char * format;
  };
  static constexpr std::array<Signature, 9> signatures{ { { 0, "\xFF\xD8\xFF", "a JPEG file" },
                                                          { 0, "BM", "a BMP file" },
                                                          { 128, "DICM", "a DICOM file" },
                                                          { 0, "# vtk DataFile", "a VTK file" },
                                                          { 0, "\x89HDF", "a HDF5 file" },
                                                          { 344, "n+1", "a NIfTI file" },
                                                          { 344, "ni1", "a NIfTI file" },
                                                          { 0, "GIF8", "a GIF file" },
                                                          { 0, "\x1F\x8B", "a file of gzip" } } };
  for (const Signature & signature : signatures)
  {
    if (head.compare(std::min(signature.at, head.size()), std::string(signature.bytes).size(), signature.bytes) == 0)
    {
      return std::string(signature.format) + ", which cannot be checked";
    }
  }
  if (HasEnding(name, { ".mha", ".mhd" }))
  {
    return "no MetaImage, or damaged at its start";
  }
  return "no image in a format that can be checked, or damaged at its start (frames without a header need a layout, "
         "WIDTHxHEIGHT:TYPE)";
}

void
InspectByContents(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
{
  const std::string head = HeadOf(bytes);
  file.format = FindFrameFormat(head, file.name);
  if (file.format == nullptr)
  {
    throw FileError(file.name, OtherFormat(head, file.name) + "; expected " + NamesOfFrameFormats());
  }
  file.format->inspect(bytes, file, beforeInflating);
}
} // namespace

FrameFile
InspectFrameFile(const std::string & name, const BeforeInflating & beforeInflating)
{
  FrameFile file;
  file.name = name;
  file.identities.push_back(IdentityOf(name));
  if (file.identities.front().size == 0)
  {
    throw FileError(name, "has 0 bytes; expected an image file");
  }
  FileBytes bytes(name);
  InspectByContents(bytes, file, beforeInflating);
  // the file must not have changed during the inspection
  RequireUnchanged(file);
  return file;
}

void
RequireUnchanged(const FrameFile & file)
{
  for (const FileIdentity & expected : file.identities)
  {
    const FileIdentity found = IdentityOf(expected.name);
    if (found != expected)
    {
      const std::string place = expected.name == file.name ? "" : "its data file " + expected.name + " ";
      throw FileError(file.name,
                      place + "has changed since it was opened; found " +
                        (AreSameFile(found, expected) ? "" : "another file of that name with ") +
                        std::to_string(found.size) + " bytes, expected the " + std::to_string(expected.size) +
                        " bytes of then");
    }
  }
}

namespace
{
/** Reads every `step`-th frame of another reader. */
class EveryFrame : public FrameReader
{
public:
  EveryFrame(std::shared_ptr<const FrameReader> reader, std::size_t first, std::size_t step)
    : m_Reader(std::move(reader))
    , m_First(first)
    , m_Step(step)
  {}

  void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const override
  {
    const std::size_t frameBytes = file.width * file.height * SizeOf(file.pixel);
    for (std::size_t i = 0; i < count; ++i)
    {
      m_Reader->Read(file, m_First + (first + i) * m_Step, 1, static_cast<char *>(buffer) + i * frameBytes);
    }
  }

private:
  std::shared_ptr<const FrameReader> m_Reader;
  std::size_t                        m_First;
  std::size_t                        m_Step;
};

/** Returns the axes in words, for example "3 channels, 5 planes and 20 times". */
std::string
DescribeAxes(const std::vector<FrameAxis> & axes)
{
  std::string text;
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    const char * const names = axes[i].kind == FrameAxis::Kind::Channel ? " channels"
                               : axes[i].kind == FrameAxis::Kind::Plane ? " planes"
                                                                        : " times";
    text += (i == 0 ? "" : i + 1 == axes.size() ? " and " : ", ") + std::to_string(axes[i].size) + names;
  }
  return text;
}

/** Returns the chosen position on an axis. Throws FileError if none is chosen, or if the axis lacks it. */
std::size_t
PlaceOnAxis(const FrameFile & file, const FrameAxis & axis, const std::optional<std::size_t> & chosen)
{
  const std::string option = axis.kind == FrameAxis::Kind::Channel ? "--channel" : "--plane";
  const std::string range = option + " 0 to " + std::to_string(axis.size - 1);
  if (!chosen)
  {
    throw FileError(file.name,
                    "has " + DescribeAxes(file.axes) + "; expected frames that differ in time alone: choose " + range);
  }
  if (*chosen >= axis.size)
  {
    throw FileError(file.name,
                    "has " + DescribeAxes(file.axes) + ", but " + option + " is " + std::to_string(*chosen) +
                      "; expected " + range);
  }
  return *chosen;
}

bool
HasAxis(const FrameFile & file, FrameAxis::Kind kind)
{
  for (const FrameAxis & axis : file.axes)
  {
    if (axis.kind == kind)
    {
      return true;
    }
  }
  return false;
}
} // namespace

void
ChooseFrames(FrameFile & file, const FrameChoice & choice)
{
  if (choice.all)
  {
    return;
  }
  const bool lacksChannels = choice.channel && *choice.channel > 0 && !HasAxis(file, FrameAxis::Kind::Channel);
  const bool lacksPlanes = choice.plane && *choice.plane > 0 && !HasAxis(file, FrameAxis::Kind::Plane);
  if (lacksChannels || lacksPlanes)
  {
    const std::string option =
      lacksChannels ? "--channel " + std::to_string(*choice.channel) : "--plane " + std::to_string(*choice.plane);
    throw FileError(file.name,
                    "says of no axis of its frames that it is of " +
                      std::string(lacksChannels ? "channels" : "planes") + ", but " + option +
                      " was given; leave it out");
  }
  if (file.axes.empty() || file.reader == nullptr)
  {
    return;
  }
  std::size_t first = 0;
  std::size_t stride = 1; // frames between neighbours on the axis
  std::size_t step = 1;   // frames between successive times
  std::size_t times = 1;
  for (const FrameAxis & axis : file.axes)
  {
    if (axis.kind == FrameAxis::Kind::Time)
    {
      step = stride;
      times = axis.size;
    }
    else
    {
      const bool isChannel = axis.kind == FrameAxis::Kind::Channel;
      first += stride * PlaceOnAxis(file, axis, isChannel ? choice.channel : choice.plane);
    }
    stride *= axis.size;
  }
  SetFrameSizes(file, { file.width, file.height, times });
  file.reader = std::make_shared<EveryFrame>(file.reader, first, step);
}

const std::vector<FrameFormat> &
FrameFormats()
{
  static const std::vector<FrameFormat> formats{
    // before TIFF, because most raw files begin as a TIFF does
    { "camera raw", false, IsHeadOfRawCamera, InspectRawCamera },
    { "TIFF", false, IsHeadOfTiff, InspectTiff },
    { "PNG", true, IsHeadOfPng, InspectPng },
    { "MetaImage", true, IsHeadOfMetaImage, InspectMetaImage, DataFilesOfMetaImage },
    { "NRRD", true, IsHeadOfNrrd, InspectNrrd, DataFilesOfNrrd },
    { "SER", false, IsHeadOfSer, InspectSer },
    { "MRAW", false, IsHeadOfMraw, InspectMraw, DataFilesOfMraw },
    { "FITS", false, IsHeadOfFits, InspectFits },
    { "NPY", false, IsHeadOfNpy, InspectNpy },
    { "PGM", false, IsHeadOfPnm, InspectPnm },
  };
  return formats;
}

std::string
HeadOf(FileBytes & bytes)
{
  constexpr std::size_t mostBytes = 512;
  std::string           head(mostBytes, '\0');
  head.resize(bytes.ReadSome(0, head.data(), head.size()));
  return head;
}

const FrameFormat *
FindFrameFormat(const std::string & head, const std::string & name)
{
  const auto & formats = FrameFormats();
  const auto   found = std::find_if(
    formats.begin(), formats.end(), [&](const FrameFormat & format) { return format.isItsHead(head, name); });
  return found == formats.end() ? nullptr : &*found;
}

std::vector<std::string>
DataFilesOf(const std::string & name)
{
  try
  {
    FileBytes                 bytes(name);
    const FrameFormat * const format = FindFrameFormat(HeadOf(bytes), name);
    return format == nullptr || format->dataFiles == nullptr ? std::vector<std::string>()
                                                             : format->dataFiles(bytes, name);
  }
  catch (const FileError &)
  {
    return {};
  }
}

bool
HasEnding(const std::string & name, std::initializer_list<const char *> endings)
{
  const std::string lower = LowerCase(name);
  return std::any_of(endings.begin(), endings.end(), [&lower](const std::string & ending) {
    return lower.size() >= ending.size() && lower.compare(lower.size() - ending.size(), ending.size(), ending) == 0;
  });
}

std::string
NamesOfFrameFormats()
{
  const auto & formats = FrameFormats();
  std::string  names = formats.front().name;
  for (std::size_t k = 1; k < formats.size(); ++k)
  {
    names += std::string(k + 1 < formats.size() ? ", " : " or ") + formats[k].name;
  }
  return names;
}

} // namespace sensornoise
