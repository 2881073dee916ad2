// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "base/Text.h"
#include "files/FrameReader.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

namespace sensornoise
{
namespace
{
namespace fs = std::filesystem;

constexpr std::size_t MaximumHeader = std::size_t{ 4 } << 20;
constexpr std::size_t MaximumDepth = 64;

/** Returns \a text without spaces, tabs and line ends around it. */
std::string
Trimmed(const std::string & text)
{
  const char * const blanks = " \t\r\n";
  const std::size_t  first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/** Adds a field. A field that occurs with different values, as elements of a list do, gets a value that is no number.
 */
void
AddField(std::map<std::string, std::string> & fields, const std::string & name, const std::string & value)
{
  const auto added = fields.emplace(name, value);
  if (!added.second && added.first->second != value)
  {
    added.first->second = "two values";
  }
}

/** Parses elements of XML, as far as headers of Photron cameras have them. */
class PhotronElements
{
public:
  PhotronElements(const std::string & file, const std::string & text)
    : m_File(file)
    , m_Text(text)
  {}

  std::map<std::string, std::string>
  Read()
  {
    m_At = m_Text.find("<cih>");
    if (m_At == std::string::npos)
    {
      Refuse("has no element <cih>");
    }
    m_At += 5;
    while (!m_IsDone)
    {
      const std::size_t tag = m_Text.find('<', m_At);
      const std::size_t end = tag == std::string::npos ? tag : EndOfTag(tag);
      if (end == std::string::npos)
      {
        Refuse("ends within its elements");
      }
      m_Content += m_Text.substr(m_At, tag - m_At);
      m_At = end + 1;
      ReadTag(m_Text.substr(tag + 1, end - tag - 1));
    }
    return m_Fields;
  }

private:
  [[noreturn]] void
  Refuse(const std::string & what) const
  {
    throw FileError(m_File, "damaged: " + what + "; expected a header of a Photron camera, <cih> to </cih>");
  }

  std::size_t
  EndOfTag(std::size_t tag) const
  {
    if (m_Text.compare(tag, 4, "<!--") == 0)
    {
      const std::size_t end = m_Text.find("-->", tag + 4);
      return end == std::string::npos ? end : end + 2;
    }
    return m_Text.find('>', tag);
  }

  void
  ReadTag(const std::string & tag)
  {
    if (tag.empty() || tag[0] == '!' || tag[0] == '?')
    {
      return; // comments and declarations
    }
    if (tag[0] == '/')
    {
      Close(Trimmed(tag.substr(1)));
      return;
    }
    const std::string name = tag.substr(0, tag.find_first_of(" \t\r\n/"));
    if (name.empty() || m_Path.size() == MaximumDepth)
    {
      Refuse("its elements have no names, or lie " + std::to_string(MaximumDepth) + " deep");
    }
    m_Path.push_back(name);
    m_Content.clear();
    m_IsLeaf = true;
    if (tag.back() == '/')
    {
      Close(name);
    }
  }

  void
  Close(const std::string & name)
  {
    if (m_Path.empty() && name == "cih")
    {
      m_IsDone = true;
      return;
    }
    if (m_Path.empty() || m_Path.back() != name)
    {
      Refuse("</" + name + "> where </" + (m_Path.empty() ? "cih" : m_Path.back()) + "> has to be");
    }
    if (m_IsLeaf)
    {
      std::string path;
      for (const std::string & part : m_Path)
      {
        path += (path.empty() ? "" : "/") + part;
      }
      AddField(m_Fields, path, Trimmed(m_Content));
    }
    m_Path.pop_back();
    m_Content.clear();
    m_IsLeaf = false;
  }

  const std::string &                m_File;
  const std::string &                m_Text;
  std::size_t                        m_At{ 0 };
  std::vector<std::string>           m_Path{};
  std::string                        m_Content{};
  bool                               m_IsLeaf{ false };
  bool                               m_IsDone{ false };
  std::map<std::string, std::string> m_Fields{};
};

/** Returns the fields of lines "Name : value". Other lines are skipped. */
std::map<std::string, std::string>
ReadLines(const std::string & text)
{
  std::map<std::string, std::string> fields;
  std::istringstream                 lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t separator = line.find(':');
    if (Trimmed(line).empty() || separator == std::string::npos)
    {
      continue;
    }
    AddField(fields, Trimmed(line.substr(0, separator)), Trimmed(line.substr(separator + 1)));
  }
  return fields;
}

/** Returns the fields of the header with their text. The fields of a .cihx file are named by the path of their elements
 * below <cih>, "frameInfo/totalFrame"; the bytes outside of <cih> are skipped. The fields of an older .cih file are
 * named "Total Frame". A field that occurs with different texts has the text "two values". Messages begin with \a file.
 * Throws FileError for elements that are not closed, and for more than 4 MiB. */
std::map<std::string, std::string>
ReadPhotronHeader(const std::string & file, FileBytes & bytes)
{
  if (bytes.Size() > MaximumHeader)
  {
    throw FileError(file,
                    "its header has " + std::to_string(bytes.Size()) + " bytes; expected at most " +
                      std::to_string(MaximumHeader));
  }
  std::string text(static_cast<std::size_t>(bytes.Size()), '\0');
  bytes.Read(0, text.data(), text.size());
  // XML begins with its declaration, which other bytes may precede
  const bool isXml = text.find("<?xml") != std::string::npos || text.find("<cih>") != std::string::npos;
  return isXml ? PhotronElements(file, text).Read() : ReadLines(text);
}

bool
IsMraw(const std::string & name)
{
  return HasEnding(name, { ".mraw" });
}

/** Returns the file beside \a name that has this ending in place of its own, with capitals or without; empty: there is
 * none. */
std::string
FileBeside(const std::string & name, const std::string & ending)
{
  const fs::path  path = fs::path(name).replace_extension(ending);
  std::error_code ignored;
  if (fs::exists(path, ignored))
  {
    return path.string();
  }
  std::string    found;
  const fs::path folder = path.parent_path();
  for (const fs::directory_entry & entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored))
  {
    const fs::path other = folder / entry.path().filename();
    if (other.stem() == path.stem() && LowerCase(other.extension().string()) == ending)
    {
      found = found.empty() ? other.string() : std::min(found, other.string());
    }
  }
  return found;
}

/** Returns the path of the other file of the recording. Throws FileError if there is none. */
std::string
CompanionOf(const std::string & name)
{
  const std::initializer_list<const char *> headers{ ".cihx", ".cih" };
  const std::initializer_list<const char *> pixels{ ".mraw" };
  for (const char * const ending : IsMraw(name) ? headers : pixels)
  {
    std::string other = FileBeside(name, ending);
    if (!other.empty())
    {
      return other;
    }
  }
  const fs::path expected = fs::path(name).replace_extension(IsMraw(name) ? ".cihx" : ".mraw");
  throw FileError(name,
                  std::string(IsMraw(name) ? "has no header" : "has no pixels") + " beside it; expected the file " +
                    expected.string() + (IsMraw(name) ? ", or one that ends in .cih" : ""));
}

/** Fields of the header, by path in a .cihx file or by name in a .cih file. */
class PhotronFields
{
public:
  PhotronFields(const std::string & file, std::map<std::string, std::string> fields)
    : m_File(file)
    , m_Fields(std::move(fields))
  {}

  std::string
  Text(const char * path, const char * name) const
  {
    const auto byPath = m_Fields.find(path);
    const auto byName = m_Fields.find(name);
    return byPath != m_Fields.end() ? byPath->second : byName != m_Fields.end() ? byName->second : "";
  }

  std::uint64_t
  Number(const char * path, const char * name) const
  {
    const std::optional<std::uint64_t> number = WholeNumber(Text(path, name));
    if (!number)
    {
      throw FileError(m_File,
                      "its header says \"" + Text(path, name).substr(0, 100) + "\" for " + path + " (" + name +
                        "); expected a whole number");
    }
    return *number;
  }

private:
  const std::string &                m_File;
  std::map<std::string, std::string> m_Fields;
};

/** Returns the exposure time [s], from nanoseconds or from "1/5000"; NaN for other texts. */
double
ExposureOf(const PhotronFields & fields)
{
  constexpr double                   unknown = std::numeric_limits<double>::quiet_NaN();
  const std::optional<std::uint64_t> nanoseconds = WholeNumber(fields.Text("recordInfo/shutterSpeedNsec", ""));
  if (nanoseconds && *nanoseconds > 0)
  {
    return 1e-9 * static_cast<double>(*nanoseconds);
  }
  const std::string text = fields.Text("recordInfo/shutterSpeed", "Shutter Speed(s)");
  if (text.rfind("1/", 0) != 0)
  {
    return unknown;
  }
  const std::optional<double> number = FiniteNumber(text.substr(2));
  return number && *number > 0.0 ? 1.0 / *number : unknown;
}

SampleFormat
FormatOfMraw(const FrameFile & file, const PhotronFields & fields)
{
  const std::string   kind = LowerCase(fields.Text("imageFileInfo/fileFormat", "File Format"));
  const std::string   color = LowerCase(fields.Text("imageDataInfo/colorInfo/type", "Color Type"));
  const std::uint64_t bits = fields.Number("imageDataInfo/colorInfo/bit", "Color Bit");
  if (!kind.empty() && kind != "mraw")
  {
    throw FileError(file.name, "its header is of a recording in the format " + kind + "; expected mraw");
  }
  if (color == "color" || color == "rgb" || bits > 16)
  {
    throw FileError(file.name,
                    "colours of " + std::to_string(bits) +
                      " bits a pixel, which are computed from others; expected the sensor's own values");
  }
  if (bits != 8 && bits != 10 && bits != 12 && bits != 16)
  {
    throw FileError(file.name, "its header says " + std::to_string(bits) + " bits a pixel; expected 8, 10, 12 or 16");
  }
  SampleFormat format;
  format.bits = static_cast<unsigned>(bits);
  format.pixel = bits == 8 ? FramePixel::UnsignedChar : FramePixel::UnsignedShort;
  format.packing = bits == 10 || bits == 12 ? SamplePacking::HighestFirst : SamplePacking::Whole;
  return format;
}

void
ReadCamera(const PhotronFields & fields, const SampleFormat & format, CameraSettings & camera)
{
  camera.camera = PrintableText(fields.Text("deviceInfo/deviceName", "Camera Type"));
  camera.exposureSeconds = ExposureOf(fields);
  const std::optional<std::uint64_t> depth =
    WholeNumber(fields.Text("imageDataInfo/effectiveBit/depth", "EffectiveBit Depth"));
  const std::string side = LowerCase(fields.Text("imageDataInfo/effectiveBit/side", "EffectiveBit Side"));
  // digital numbers that are shifted up use all bits of their format
  const bool isLower = side == "lower" && depth && *depth >= 1 && *depth <= format.bits;
  camera.bitDepth = isLower ? static_cast<unsigned>(*depth) : format.bits;
}
} // namespace

bool
IsHeadOfMraw(const std::string & /*head*/, const std::string & name)
{
  return HasEnding(name, { ".mraw", ".cihx", ".cih" });
}

void
InspectMraw(FileBytes & bytes, FrameFile & file, const BeforeInflating & /*beforeInflating*/)
{
  const std::string other = CompanionOf(file.name);
  AddDataFile(file.name, other, file.identities);
  FileBytes           otherBytes(file.name, other);
  FileBytes &         header = IsMraw(file.name) ? otherBytes : bytes;
  FileBytes &         pixels = IsMraw(file.name) ? bytes : otherBytes;
  const PhotronFields fields(file.name, ReadPhotronHeader(file.name, header));
  FramePlaces         places;
  places.path = IsMraw(file.name) ? file.name : other;
  places.sample = FormatOfMraw(file, fields);
  file.pixel = places.sample.pixel;
  const std::uint64_t frames = fields.Number("frameInfo/totalFrame", "Total Frame");
  SetFrameSizes(file,
                { fields.Number("imageDataInfo/resolution/width", "Image Width"),
                  fields.Number("imageDataInfo/resolution/height", "Image Height"),
                  frames });
  SetFramePlaces(file, places, pixels.Size(), frames);
  ReadCamera(fields, places.sample, file.camera);
}

std::vector<std::string>
DataFilesOfMraw(FileBytes & /*bytes*/, const std::string & name)
{
  return { CompanionOf(name) };
}

} // namespace sensornoise
