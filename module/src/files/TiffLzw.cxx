// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffLzw.h"

#include <algorithm>
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

/** The strings that codes stand for. Each is a part of what came before, so that it is known by its place there. */
class LzwStrings
{
public:
  /** What comes goes to \a out, up to \a capacity bytes; null: nowhere. */
  LzwStrings(unsigned char * out, std::uint64_t capacity)
    : m_Out(out)
    , m_Capacity(capacity)
  {}

  std::uint64_t
  Bytes() const
  {
    return m_Bytes;
  }

  /** \a code stands for the string that came last, and the first byte of that which comes next. */
  void
  Define(std::size_t code)
  {
    m_Lengths[code] = static_cast<std::uint32_t>(m_Bytes - m_Last) + 1;
    m_Starts[code] = m_Last;
  }

  /** The string of \a code comes. */
  void
  Add(std::size_t code)
  {
    const std::uint64_t length = code < ClearCode ? 1 : m_Lengths[code];
    const std::uint64_t room = m_Out == nullptr ? 0 : m_Capacity - std::min(m_Capacity, m_Bytes);
    m_Last = m_Bytes;
    m_Bytes += length;
    if (code < ClearCode && room > 0)
    {
      m_Out[m_Last] = static_cast<unsigned char>(code);
      return;
    }
    // byte by byte: a string may begin with those that are just copied
    for (std::uint64_t i = 0; i < std::min(length, room); ++i)
    {
      m_Out[m_Last + i] = m_Out[m_Starts[code] + i];
    }
  }

private:
  unsigned char *            m_Out;
  std::uint64_t              m_Capacity;
  std::uint64_t              m_Bytes{ 0 };
  std::uint64_t              m_Last{ 0 }; // where the string that came last begins
  std::vector<std::uint32_t> m_Lengths = std::vector<std::uint32_t>(MaximumStrings);
  std::vector<std::uint64_t> m_Starts = std::vector<std::uint64_t>(MaximumStrings);
};
} // namespace

LzwLength
LengthOfLzw(FileBytes &     bytes,
            std::uint64_t   offset,
            std::uint64_t   count,
            std::uint64_t   expected,
            std::uint64_t   whole,
            unsigned char * out)
{
  LzwLength   found;
  LzwCodes    codes(bytes, offset, count);
  LzwStrings  strings(out, expected);
  std::size_t next = FirstString;
  unsigned    bits = MinimumBits;
  int         previous = -1;
  bool        isCleared = false;
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
      strings.Define(next++);
      if (next == (std::size_t{ 1 } << bits) - 1 && bits < MaximumBits)
      {
        ++bits;
      }
    }
    strings.Add(static_cast<std::size_t>(code));
    found.bytes = strings.Bytes();
    previous = code;
  }
  return found;
}

} // namespace sensornoise
