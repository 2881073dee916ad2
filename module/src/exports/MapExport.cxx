// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/MapExport.h"

#include "exports/ExportInput.h"
#include "files/ByteOrder.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
std::string
TiffNumber(std::uint64_t number, std::size_t bytes)
{
  return BytesOfNumber(number, bytes, false);
}

/** An entry of TIFF 6.0 with one value of type LONG, or of SHORT, which takes its lower half. */
std::string
TiffTag(unsigned int tag, unsigned int type, std::uint64_t value)
{
  return TiffNumber(tag, 2) + TiffNumber(type, 2) + TiffNumber(1, 4) + TiffNumber(value, 4);
}

/** A TIFF file with one strip, of little endian. */
std::string
FloatTiff(const std::vector<double> & values, std::size_t width, std::size_t height)
{
  constexpr unsigned int shortType = 3;
  constexpr unsigned int longType = 4;
  constexpr std::size_t  entries = 10;
  constexpr std::size_t  directory = 8;
  constexpr std::size_t  pixels = directory + 2 + entries * 12 + 4;
  std::string            file = std::string("II*\0", 4) + TiffNumber(directory, 4) + TiffNumber(entries, 2);
  file += TiffTag(256, longType, width) + TiffTag(257, longType, height);         // ImageWidth, ImageLength
  file += TiffTag(258, shortType, 32) + TiffTag(259, shortType, 1);               // BitsPerSample, no compression
  file += TiffTag(262, shortType, 1) + TiffTag(273, longType, pixels);            // black is 0, StripOffsets
  file += TiffTag(277, shortType, 1) + TiffTag(278, longType, height);            // SamplesPerPixel, RowsPerStrip
  file += TiffTag(279, longType, values.size() * 4) + TiffTag(339, shortType, 3); // StripByteCounts, IEEE numbers
  file += TiffNumber(0, 4);
  for (const double value : values)
  {
    file += BytesOfReal(static_cast<float>(value), false);
  }
  return file;
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
  NoiseExport made;
  const auto  add = [&](const char * name, const std::vector<double> & values) {
    made.files.push_back({ name, FloatTiff(values, maps.width, maps.height) });
  };
  add("offset.tif", maps.offsetDn);
  add("variance.tif", SquaresOf(maps.readNoiseDn, 1.0));
  made.note = "offset.tif is in DN and variance.tif in DN^2.";
  if (noise.channels.size() == 1 && noise.channels.front().gain.value)
  {
    add("variance_electrons.tif", SquaresOf(maps.readNoiseDn, 1.0 / GainOf(noise, noise.channels.front())));
    made.note += " variance_electrons.tif is in squared electrons.";
  }
  return made;
}

} // namespace sensornoise
