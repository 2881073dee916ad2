// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_CompressedBytesTestHelper_h
#define sensornoise_test_CompressedBytesTestHelper_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

/** \file
 * Compressed bytes made without the library that is tested against them. */

namespace sensornoise::test
{

inline void
AppendNumber(std::string & bytes, std::uint64_t number, std::size_t width, bool isBigEndian)
{
  for (std::size_t i = 0; i < width; ++i)
  {
    const std::size_t shift = 8 * (isBigEndian ? width - 1 - i : i);
    bytes += static_cast<char>((number >> shift) & 255);
  }
}

inline std::uint32_t
Crc32(const std::string & bytes)
{
  std::uint32_t sum = 0xFFFFFFFF;
  for (const char c : bytes)
  {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
    {
      sum = (sum >> 1) ^ ((sum & 1) != 0 ? 0xEDB88320 : 0);
    }
  }
  return ~sum;
}

inline std::uint32_t
Adler32(const std::string & bytes)
{
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char c : bytes)
  {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return (b << 16) | a;
}

/** Returns one block of fixed Huffman codes, each of a single byte. */
inline std::string
Deflated(const std::string & bytes)
{
  std::string out;
  unsigned    held = 0;
  unsigned    bits = 0;
  const auto  add = [&](unsigned value, unsigned count) {
    held |= value << bits;
    for (bits += count; bits >= 8; bits -= 8, held >>= 8)
    {
      out += static_cast<char>(held & 255);
    }
  };
  const auto addCode = [&add](unsigned code, unsigned count) {
    for (unsigned i = count; i-- > 0;)
    {
      add((code >> i) & 1, 1);
    }
  };
  add(1, 1); // the last block
  add(1, 2); // fixed codes
  for (const char c : bytes)
  {
    const unsigned byte = static_cast<unsigned char>(c);
    byte < 144 ? addCode(0x30 + byte, 8) : addCode(0x190 + byte - 144, 9);
  }
  addCode(0, 7); // the end
  add(0, 7);
  return out;
}

inline std::string
ZlibStream(const std::string & bytes)
{
  std::string stream = std::string("\x78\x01") + Deflated(bytes);
  AppendNumber(stream, Adler32(bytes), 4, true);
  return stream;
}

inline std::string
GzipStream(const std::string & bytes)
{
  std::string stream = std::string("\x1F\x8B\x08\0\0\0\0\0\0\xFF", 10) + Deflated(bytes);
  AppendNumber(stream, Crc32(bytes), 4, false);
  AppendNumber(stream, bytes.size(), 4, false);
  return stream;
}

/** Codes of a growing number of bits, as TIFF packs them. */
class LzwWriter
{
public:
  void
  Add(unsigned code, unsigned bits)
  {
    m_Held = (m_Held << bits) | code;
    for (m_Bits += bits; m_Bits >= 8; m_Bits -= 8)
    {
      m_Bytes += static_cast<char>((m_Held >> (m_Bits - 8)) & 255);
    }
  }

  std::string
  Bytes() const
  {
    return m_Bits == 0 ? m_Bytes : m_Bytes + static_cast<char>((m_Held << (8 - m_Bits)) & 255);
  }

private:
  std::string   m_Bytes{};
  std::uint64_t m_Held{ 0 };
  unsigned      m_Bits{ 0 };
};

/** Compresses by the pseudo-code of TIFF 6.0, section 13. */
inline std::string
LzwStream(const std::string & bytes)
{
  LzwWriter                       writer;
  std::map<std::string, unsigned> codes;
  unsigned                        bits = 9;
  const auto                      clear = [&] {
    writer.Add(256, bits);
    codes.clear();
    for (unsigned byte = 0; byte < 256; ++byte)
    {
      codes[std::string(1, static_cast<char>(byte))] = byte;
    }
    bits = 9;
  };
  clear();
  std::string text;
  unsigned    next = 258;
  for (const char c : bytes)
  {
    if (codes.count(text + c) != 0)
    {
      text += c;
      continue;
    }
    writer.Add(codes[text], bits);
    codes[text + c] = next;
    text = c;
    bits += next == 511 || next == 1023 || next == 2047 ? 1 : 0;
    if (next++ == 4094)
    {
      clear();
      next = 258;
    }
  }
  writer.Add(codes[text], bits);
  writer.Add(257, bits);
  return writer.Bytes();
}

/** Runs where there are any, else bytes one by one. */
inline std::string
PackedBits(const std::string & row)
{
  std::string out;
  for (std::size_t i = 0; i < row.size();)
  {
    std::size_t end = i + 1;
    while (end < row.size() && row[end] == row[i] && end - i < 128)
    {
      ++end;
    }
    out += static_cast<char>(end - i > 1 ? 257 - (end - i) : 0);
    out += row[i];
    i = end;
  }
  return out;
}

} // namespace sensornoise::test

#endif
