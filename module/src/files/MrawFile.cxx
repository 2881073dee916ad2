// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/MrawFile.h"

#include "files/DataFile.h"
#include "sensornoise/FrameFile.h"
#include "files/FrameFormats.h"
#include "files/FrameSizes.h"
#include "files/PackedFrames.h"
#include "files/PhotronHeader.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <locale>
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

std::string
LowerCaseText(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool
IsMraw(const std::string & name)
{
  return HasEnding(LowerCaseText(name), { ".mraw" });
}

/** The other file of the recording. Throws FileError where there is none. */
std::string
CompanionOf(const std::string & name)
{
  const std::initializer_list<const char *> headers{ ".cihx", ".CIHX", ".cih", ".CIH" };
  const std::initializer_list<const char *> pixels{ ".mraw", ".MRAW" };
  for (const char * const ending : IsMraw(name) ? headers : pixels)
  {
    const fs::path  path = fs::path(name).replace_extension(ending);
    std::error_code ignored;
    if (fs::exists(path, ignored))
    {
      return path.string();
    }
  }
  const fs::path expected = fs::path(name).replace_extension(IsMraw(name) ? ".cihx" : ".mraw");
  throw FileError(name,
                  std::string(IsMraw(name) ? "has no header" : "has no pixels") + " beside it; expected the file " +
                    expected.string() + (IsMraw(name) ? ", or one that ends in .cih" : ""));
}

/** What the header says, by either of the names that a field has. */
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

/** Of nanoseconds, or of "1/5000"; NaN for what could be anything else. */
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
  std::istringstream stream(text.substr(2));
  double             number = 0.0;
  stream.imbue(std::locale::classic());
  return (stream >> number) && stream.eof() && number > 0.0 ? 1.0 / number : unknown;
}

SampleFormat
FormatOfMraw(const FrameFile & file, const PhotronFields & fields)
{
  const std::string   kind = LowerCaseText(fields.Text("imageFileInfo/fileFormat", "File Format"));
  const std::string   color = LowerCaseText(fields.Text("imageDataInfo/colorInfo/type", "Color Type"));
  const std::uint64_t bits = fields.Number("imageDataInfo/colorInfo/bit", "Color Bit");
  if (!kind.empty() && kind != "mraw")
  {
    throw FileError(file.name, "its header is of a recording in the format " + kind + "; expected mraw");
  }
  if (color == "color" || color == "rgb" || bits > 16)
  {
    throw FileError(file.name,
                    "colours of " + std::to_string(bits) +
                      " bits a pixel, which are made of others; expected the sensor's own values");
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
  const std::string side = LowerCaseText(fields.Text("imageDataInfo/effectiveBit/side", "EffectiveBit Side"));
  // codes that were moved up have all bits of what holds them
  const bool isLower = side == "lower" && depth && *depth >= 1 && *depth <= format.bits;
  camera.bitDepth = isLower ? static_cast<unsigned>(*depth) : format.bits;
}
} // namespace

bool
IsHeadOfMraw(const std::string & /*head*/, const std::string & name)
{
  return HasEnding(LowerCaseText(name), { ".mraw", ".cihx", ".cih" });
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
