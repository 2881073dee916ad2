// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/files/FrameFile.h"

#include "sensornoise/files/FileBytes.h"
#include "sensornoise/files/FileError.h"
#include "sensornoise/files/MetaImageFile.h"
#include "sensornoise/files/NrrdFile.h"
#include "sensornoise/files/PngFile.h"
#include "sensornoise/files/TiffDirectory.h"
#include "sensornoise/files/TiffFile.h"

#include <algorithm>
#include <array>

namespace sensornoise
{
namespace
{
bool
EndsWith(const std::string & text, const std::string & end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

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
  if (EndsWith(name, ".mha") || EndsWith(name, ".mhd"))
  {
    return "no MetaImage, or damaged at its start";
  }
  return "no image in a format that can be checked, or damaged at its start";
}

void
InspectByContents(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
{
  std::array<unsigned char, 512> buffer{};
  const std::size_t              count = bytes.ReadSome(0, buffer.data(), buffer.size());
  const std::string              head(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(count));
  if (head.rfind("\x89PNG\r\n\x1A\n", 0) == 0)
  {
    InspectPng(bytes, file, beforeInflating);
  }
  else if (TiffBytes::IsTiff(buffer.data(), count))
  {
    InspectTiff(bytes, file, beforeInflating);
  }
  else if (head.rfind("NRRD", 0) == 0)
  {
    // ITK looks at the name, too
    if (!EndsWith(file.name, ".nrrd") && !EndsWith(file.name, ".nhdr"))
    {
      throw FileError(file.name, "begins as a NRRD file; expected its name to end with .nrrd or .nhdr");
    }
    InspectNrrd(bytes, file, beforeInflating);
  }
  else if ((EndsWith(file.name, ".mha") || EndsWith(file.name, ".mhd")) &&
           head.find_first_of("=:") != std::string::npos)
  {
    InspectMetaImage(bytes, file, beforeInflating);
  }
  else
  {
    throw FileError(file.name, OtherFormat(head, file.name) + "; expected TIFF, PNG, MetaImage or NRRD");
  }
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
