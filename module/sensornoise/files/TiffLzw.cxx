// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/files/TiffLzw.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{
namespace
{
constexpr unsigned    ClearCode = 256;
constexpr unsigned    EndCode = 257;
constexpr unsigned    FirstString = 258;
constexpr unsigned    MinimumBits = 9;
constexpr unsigned    MaximumBits = 12;
constexpr std::size_t MaximumStrings = 5119; // of libtiff's table

/** Codes of a growing number of bits, the highest first. */
class LzwCodes
{
public:
  LzwCodes(FileBytes & bytes, std::uint64_t offset, std::uint64_t count)
    : m_Reader(bytes, offset, offset + count)
  {}

  /** The next one, or -1 at the end. */
  int
  Next(unsigned bits)
  {
    while (m_Held < bits)
    {
      const int byte = m_Reader.Next();
      if (byte < 0)
      {
        return -1;
      }
      m_Bits = (m_Bits << 8) | static_cast<unsigned>(byte);
      m_Held += 8;
    }
    m_Held -= bits;
    return static_cast<int>((m_Bits >> m_Held) & ((1U << bits) - 1));
  }

private:
  ByteReader    m_Reader;
  std::uint32_t m_Bits{ 0 };
  unsigned      m_Held{ 0 };
};
} // namespace

LzwLength
LengthOfLzw(FileBytes & bytes, std::uint64_t offset, std::uint64_t count, std::uint64_t expected, std::uint64_t whole)
{
  LzwLength                  found;
  LzwCodes                   codes(bytes, offset, count);
  std::vector<std::uint32_t> lengths(MaximumStrings, 1); // of the strings that codes stand for
  std::size_t                next = FirstString;
  unsigned                   bits = MinimumBits;
  int                        previous = -1;
  bool                       isCleared = false;
  while (found.bytes != expected && found.bytes < whole)
  {
    const int code = codes.Next(bits);
    if (code < 0 || code == static_cast<int>(EndCode))
    {
      return found;
    }
    if (code == static_cast<int>(ClearCode))
    {
      next = FirstString;
      bits = MinimumBits;
      previous = -1;
      isCleared = true;
      continue;
    }
    const bool isKnown = previous < 0 ? code < static_cast<int>(ClearCode) : static_cast<std::size_t>(code) <= next;
    if (!isCleared || !isKnown || next >= MaximumStrings)
    {
      found.error = "a code without a meaning after " + std::to_string(found.bytes) + " bytes";
      return found;
    }
    if (previous >= 0)
    {
      lengths[next++] = lengths[static_cast<std::size_t>(previous)] + 1;
      if (next == (std::size_t{ 1 } << bits) - 1 && bits < MaximumBits)
      {
        ++bits;
      }
    }
    found.bytes += lengths[static_cast<std::size_t>(code)];
    previous = code;
  }
  return found;
}

} // namespace sensornoise
