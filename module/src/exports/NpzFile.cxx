// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/NpzFile.h"

#include "files/ByteOrder.h"
#include "files/Zlib.h"

#include <cstdint>
#include <string>
#include <vector>

// ZIP: PKWARE's APPNOTE.TXT, 4.3.7 local header, 4.3.12 central directory, 4.3.16 its end. NPY: NumPy's format 1.0.
namespace sensornoise
{
namespace
{
std::string
LittleEndian(std::uint64_t number, std::size_t bytes)
{
  return BytesOfNumber(number, bytes, false);
}

std::string
NpyBytes(const NpzArray & array)
{
  constexpr std::size_t alignment = 64; // of the values in the file
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
  constexpr unsigned version = 20;               // 2.0
  constexpr unsigned firstDay = (1U << 5U) + 1U; // 1980-01-01: equal models make equal files
  const auto *       bytes = reinterpret_cast<const Bytef *>(content.data());
  const auto         sum = crc32(crc32(0, nullptr, 0), bytes, static_cast<uInt>(content.size()));
  return LittleEndian(version, 2) + LittleEndian(0, 4) + LittleEndian(0, 2) + LittleEndian(firstDay, 2) +
         LittleEndian(sum, 4) + LittleEndian(content.size(), 4) + LittleEndian(content.size(), 4) +
         LittleEndian(name.size(), 2) + LittleEndian(0, 2);
}
} // namespace

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

} // namespace sensornoise
