// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"

#include "base/Text.h"
#include "files/FileBytes.h"
#include "files/Zlib.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
// ZIP: PKWARE's APPNOTE.TXT, 4.3.7 local header, 4.3.12 central directory, 4.3.16 its end. NPY: NumPy's format 1.0.

/** An array of double for a NumPy archive; the last index runs fastest. */
struct NpzArray
{
  std::string              name;
  std::vector<std::size_t> shape; ///< empty: one number
  std::vector<double>      values;
};

std::string
LittleEndian(std::uint64_t number, std::size_t bytes)
{
  return BytesOfNumber(number, bytes, false);
}

std::string
NpyBytes(const NpzArray & array)
{
  constexpr std::size_t alignment = 64; // alignment of the values in the file [bytes]
  std::string           shape;
  for (const std::size_t size : array.shape)
  {
    shape += std::to_string(size) + ", ";
  }
  std::string       header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + shape + "), }";
  const std::string magic("\x93NUMPY\x01\x00", 8);
  const std::size_t used = magic.size() + 2 + header.size() + 1;
  header += std::string((alignment - used % alignment) % alignment, ' ') + '\n';
  std::string bytes = magic + LittleEndian(header.size(), 2) + header;
  for (const double value : array.values)
  {
    bytes += BytesOfReal(value, false);
  }
  return bytes;
}

/** The fields that the local header and the central directory have in common. */
std::string
MemberHead(const std::string & name, const std::string & content)
{
  constexpr unsigned version = 20;               // version 2.0 of ZIP
  constexpr unsigned firstDay = (1U << 5U) + 1U; // 1980-01-01: equal models make equal files
  const auto *       bytes = reinterpret_cast<const Bytef *>(content.data());
  const auto         sum = crc32(crc32(0, nullptr, 0), bytes, static_cast<uInt>(content.size()));
  return LittleEndian(version, 2) + LittleEndian(0, 4) + LittleEndian(0, 2) + LittleEndian(firstDay, 2) +
         LittleEndian(sum, 4) + LittleEndian(content.size(), 4) + LittleEndian(content.size(), 4) +
         LittleEndian(name.size(), 2) + LittleEndian(0, 2);
}

/** The bytes of a NumPy archive (.npz): a ZIP file whose members are not compressed, NPY files of version 1.0. */
std::string
NpzFile(const std::vector<NpzArray> & arrays)
{
  std::string file;
  std::string directory;
  for (const NpzArray & array : arrays)
  {
    const std::string name = array.name + ".npy";
    const std::string content = NpyBytes(array);
    const std::string head = MemberHead(name, content);
    directory +=
      "PK\x01\x02" + LittleEndian(20, 2) + head + std::string(10, '\0') + LittleEndian(file.size(), 4) + name;
    file += "PK\x03\x04" + head + name + content;
  }
  const std::string count = LittleEndian(arrays.size(), 2);
  return file + directory + "PK\x05\x06" + LittleEndian(0, 4) + count + count + LittleEndian(directory.size(), 4) +
         LittleEndian(file.size(), 4) + LittleEndian(0, 2);
}

/** CAREamics' floor of the variance, over the variance at the darkest level [1]: low enough never to matter. */
constexpr double floorOfVariance = 1e-6;
/** Returns an entry of TIFF 6.0 with one value of type LONG, or of type SHORT in the lower half of the value field. */
std::string
TiffTag(unsigned int tag, unsigned int type, std::uint64_t value)
{
  return LittleEndian(tag, 2) + LittleEndian(type, 2) + LittleEndian(1, 4) + LittleEndian(value, 4);
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
  std::string            file = std::string("II*\0", 4) + LittleEndian(directory, 4) + LittleEndian(entries, 2);
  file += TiffTag(256, longType, width) + TiffTag(257, longType, height);           // ImageWidth, ImageLength
  file += TiffTag(258, shortOfTiff, 32) + TiffTag(259, shortOfTiff, 1);             // BitsPerSample, no compression
  file += TiffTag(262, shortOfTiff, 1) + TiffTag(273, longType, pixels);            // black is 0, StripOffsets
  file += TiffTag(277, shortOfTiff, 1) + TiffTag(278, longType, height);            // SamplesPerPixel, RowsPerStrip
  file += TiffTag(279, longType, values.size() * 4) + TiffTag(339, shortOfTiff, 3); // StripByteCounts, IEEE numbers
  file += LittleEndian(0, 4);
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
  std::string             bytes = LittleEndian(singlePrecision, 4) + LittleEndian(height, 4) + LittleEndian(width, 4);
  bytes += LittleEndian(0, 4) + LittleEndian(name.size() + 1, 4) + name + '\0'; // no imaginary part
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

bool
IsMosaic(const CameraNoise & noise)
{
  return std::any_of(
    noise.channels.begin(), noise.channels.end(), [](const ChannelNoise & each) { return each.channel != "mono"; });
}

/** Throws ExportError unless the maps are of the pixels of the report: of its size, or of twice its size where its
 * channels are the planes of a mosaic, and with the offset of each channel among the offsets of the pixels. */
void
RequireMapsOfReport(const CameraNoise & noise)
{
  const NoiseMaps & maps = noise.maps;
  const char *      advice = "expected the maps of the same estimate. Estimate again, with --dark, --json and --maps.";
  const std::size_t planes = IsMosaic(noise) ? 2 : 1;
  const auto        size = [planes](std::size_t width, std::size_t height) {
    return std::to_string(planes * width) + " x " + std::to_string(planes * height) + " pixels";
  };
  if (noise.width != 0 && noise.height != 0 &&
      (maps.width / planes != noise.width || maps.height / planes != noise.height))
  {
    throw ExportError("the maps have " + std::to_string(maps.width) + " x " + std::to_string(maps.height) +
                      " pixels, and the frames of the report " + noise.name + " have " +
                      size(noise.width, noise.height) + "; " + advice);
  }
  const auto [lowest, highest] = std::minmax_element(maps.offsetDn.begin(), maps.offsetDn.end());
  for (const ChannelNoise & channel : noise.channels)
  {
    constexpr double mostErrors = 4.0; // standard errors of an offset that still agrees
    const double     tolerance = mostErrors * channel.offset.standardError.value_or(0.0);
    if (channel.offset.value &&
        (*channel.offset.value < *lowest - tolerance || *channel.offset.value > *highest + tolerance))
    {
      throw ExportError("the map of the offset has " + Text(*lowest) + " to " + Text(*highest) +
                        " DN, and the report " + noise.name + " has an offset of " + Text(*channel.offset.value) +
                        " DN; " + advice);
    }
  }
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
ExportCareamics(const CameraNoise & noise)
{
  const ChannelNoise & channel = OnlyChannel(noise, "careamics");
  const NoiseModel     model = ModelOf(noise, channel);
  if (!channel.lowestDn)
  {
    throw ExportError("the report " + noise.name +
                      " has no measured levels (scatter), between which CAREamics' model is defined. Use the report as "
                      "it was written.");
  }
  const double low = std::max(0.0, *channel.lowestDn);
  const double high = noise.whiteLevelDn.value_or(channel.clipHighDn.value_or(*channel.highestDn));
  const double lowest = model.VarianceAt(low);
  if (!(lowest > 0.0) || !(high > low))
  {
    throw ExportError("the report " + noise.name + " has a variance of " + WithSigns(Text(lowest) + " DN^2") +
                      " at its darkest level " + Text(low) + " DN, and " + Text(high) +
                      " DN as its brightest level; expected a variance above 0 and a brighter level");
  }
  const double rise = model.varianceSlopeDn * (high - low);
  return OneFile("careamics_noise_model.npz",
                 NpzFile({ { "trained_weight", { 3, 2 }, { 0.0, 0.0, std::log(lowest), std::log(rise), 0.0, 0.0 } },
                           { "min_signal", { 1 }, { low } },
                           { "max_signal", { 1 }, { high } },
                           { "min_sigma", {}, { floorOfVariance * lowest } } }),
                 "The levels are DN as in the frames: CAREamics must not normalise the images.");
}

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
  RequireMapsOfReport(noise);
  const auto tiff = [&maps](const std::vector<double> & values) { return FloatTiff(values, maps.width, maps.height); };
  const auto matrix = [&maps](const char * name, const std::vector<double> & values) {
    return MatMatrix(name, values, maps.width, maps.height);
  };
  const std::vector<double> variances = SquaresOf(maps.readNoiseDn, 1.0);
  NoiseExport               made;
  made.files = { { "SERIAL_off.tiff", tiff(maps.offsetDn) }, { "SERIAL_var.tiff", tiff(variances) } };
  made.note = "navigate: replace SERIAL by the serial number of the camera.";
  if (noise.channels.size() != 1 || IsMosaic(noise) || !noise.channels.front().gain.value)
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
