// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameFile.h"

#include "files/FileBytes.h"
#include "files/FileIdentity.h"
#include "files/FrameFormats.h"

#include <algorithm>
#include <array>

namespace sensornoise
{
namespace
{
/** What a file that cannot be checked is, where its beginning tells. */
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
  // what was inspected is what these identities stand for
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

} // namespace sensornoise
