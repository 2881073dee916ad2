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

} // namespace sensornoise
