// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"

#include "files/FileBytes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
std::string
SmallEndFirst(std::uint64_t number, std::size_t bytes)
{
  return BytesOfNumber(number, bytes, false);
}

/** Returns an entry of TIFF 6.0 with one value of type LONG, or of type SHORT in the lower half of the value field. */
std::string
TiffTag(unsigned int tag, unsigned int type, std::uint64_t value)
{
  return SmallEndFirst(tag, 2) + SmallEndFirst(type, 2) + SmallEndFirst(1, 4) + SmallEndFirst(value, 4);
}

/** A TIFF file with one strip, of little endian. */
std::string
FloatTiff(const std::vector<double> & values, std::size_t width, std::size_t height)
{
  constexpr unsigned int shortOfTiff = 3;
  constexpr unsigned int longType = 4;
  constexpr std::size_t  entries = 10;
  constexpr std::size_t  directory = 8;
  constexpr std::size_t  pixels = directory + 2 + entries * 12 + 4;
  std::string            file = std::string("II*\0", 4) + SmallEndFirst(directory, 4) + SmallEndFirst(entries, 2);
  file += TiffTag(256, longType, width) + TiffTag(257, longType, height);           // ImageWidth, ImageLength
  file += TiffTag(258, shortOfTiff, 32) + TiffTag(259, shortOfTiff, 1);             // BitsPerSample, no compression
  file += TiffTag(262, shortOfTiff, 1) + TiffTag(273, longType, pixels);            // black is 0, StripOffsets
  file += TiffTag(277, shortOfTiff, 1) + TiffTag(278, longType, height);            // SamplesPerPixel, RowsPerStrip
  file += TiffTag(279, longType, values.size() * 4) + TiffTag(339, shortOfTiff, 3); // StripByteCounts, IEEE numbers
  file += SmallEndFirst(0, 4);
  for (const double value : values)
  {
    file += BytesOfReal(static_cast<float>(value), false);
  }
  return file;
}

/** Returns a matrix of a MAT file of level 4, which all versions of MATLAB load: MathWorks, MAT-File Format, "Level 4
 * MAT-File Format". The numbers are of single precision, column by column. */
std::string
MatMatrix(const std::string & name, const std::vector<double> & values, std::size_t width, std::size_t height)
{
  constexpr std::uint64_t singlePrecision = 10; // little endian, single precision, a full matrix
  std::string bytes = SmallEndFirst(singlePrecision, 4) + SmallEndFirst(height, 4) + SmallEndFirst(width, 4);
  bytes += SmallEndFirst(0, 4) + SmallEndFirst(name.size() + 1, 4) + name + '\0'; // no imaginary part
  for (std::size_t x = 0; x < width; ++x)
  {
    for (std::size_t y = 0; y < height; ++y)
    {
      bytes += BytesOfReal(static_cast<float>(values[y * width + x]), false);
    }
  }
  return bytes;
}

std::vector<double>
SquaresOf(const std::vector<double> & values, double factor)
{
  std::vector<double> squares;
  squares.reserve(values.size());
  for (const double value : values)
  {
    squares.push_back(factor * value * (factor * value));
  }
  return squares;
}

/** Returns the exposure as PYME writes it into the names of maps, "10ms"; "ms" if it is not known. */
std::string
ExposureInName(const CameraNoise & noise)
{
  constexpr double toMilliseconds = 1000.0;
  constexpr double most = 1e9; // [ms]
  const double     exposure = noise.exposureSeconds.value_or(-1.0) * toMilliseconds;
  return exposure >= 0.0 && exposure < most ? std::to_string(std::llround(exposure)) + "ms" : "ms";
}
} // namespace

NoiseExport
ExportMaps(const CameraNoise & noise)
{
  const NoiseMaps & maps = noise.maps;
  const std::size_t pixels = maps.width * maps.height;
  if (pixels == 0 || maps.offsetDn.size() != pixels || maps.readNoiseDn.size() != pixels)
  {
    throw ExportError("the report " + noise.name +
                      " has no maps of the offset and the read noise of its pixels. Estimate with dark frames (--dark) "
                      "and --maps, and give the folder (--maps).");
  }
  const auto tiff = [&maps](const std::vector<double> & values) { return FloatTiff(values, maps.width, maps.height); };
  const auto matrix = [&maps](const char * name, const std::vector<double> & values) {
    return MatMatrix(name, values, maps.width, maps.height);
  };
  const std::vector<double> variances = SquaresOf(maps.readNoiseDn, 1.0);
  NoiseExport               made;
  made.files = { { "SERIAL_off.tiff", tiff(maps.offsetDn) }, { "SERIAL_var.tiff", tiff(variances) } };
  made.note = "navigate: replace SERIAL by the serial number of the camera.";
  if (noise.channels.size() != 1 || !noise.channels.front().gain.value)
  {
    made.note += " There are no files for PYME and SMAP, which need one gain of all pixels.";
    return made;
  }
  const double              electronsPerDn = 1.0 / GainOf(noise, noise.channels.front());
  const std::string         exposure = ExposureInName(noise);
  const std::vector<double> gains(pixels, electronsPerDn);
  made.files.push_back({ "dark_" + exposure + ".tif", tiff(maps.offsetDn) });
  made.files.push_back({ "variance_" + exposure + ".tif", tiff(SquaresOf(maps.readNoiseDn, electronsPerDn)) });
  made.files.push_back(
    { "smap_camera.mat", matrix("offsetmap", maps.offsetDn) + matrix("varmap", variances) + matrix("gainmap", gains) });
  made.note +=
    exposure == "ms" ? " PYME: the exposure is not known; insert it into both names, for instance dark_10ms.tif." : "";
  made.note += " PYME stores x along the columns of its files: swap x and y of maps of frames of other programs.";
  return made;
}

} // namespace sensornoise
