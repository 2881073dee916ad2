// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/Compression.h"

#include "sensornoise/FrameFile.h"

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
constexpr std::size_t MaximumStrings = 5119; // size of libtiff's table

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
  /** Writes the decoded bytes to \a out, at most \a capacity of them; null: nowhere. */
  LzwStrings(unsigned char * out, std::uint64_t capacity)
    : m_Out(out)
    , m_Capacity(capacity)
  {}

  std::uint64_t
  Bytes() const
  {
    return m_Bytes;
  }

  /** Defines \a code as the last string followed by the first byte of the next string. */
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
    const std::uint64_t space = m_Out == nullptr ? 0 : m_Capacity - std::min(m_Capacity, m_Bytes);
    m_Last = m_Bytes;
    m_Bytes += length;
    if (code < ClearCode && space > 0)
    {
      m_Out[m_Last] = static_cast<unsigned char>(code);
      return;
    }
    // byte by byte, because the string may contain bytes that this loop copies
    for (std::uint64_t i = 0; i < std::min(length, space); ++i)
    {
      m_Out[m_Last + i] = m_Out[m_Starts[code] + i];
    }
  }

private:
  unsigned char *            m_Out;
  std::uint64_t              m_Capacity;
  std::uint64_t              m_Bytes{ 0 };
  std::uint64_t              m_Last{ 0 }; // beginning of the last string
  std::vector<std::uint32_t> m_Lengths = std::vector<std::uint32_t>(MaximumStrings);
  std::vector<std::uint64_t> m_Starts = std::vector<std::uint64_t>(MaximumStrings);
};
} // namespace

LzwResult
DecodeLzw(FileBytes &     bytes,
          std::uint64_t   offset,
          std::uint64_t   count,
          std::uint64_t   expected,
          std::uint64_t   whole,
          unsigned char * out)
{
  LzwResult   found;
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

namespace
{
/** The markers of a JPEG, in the order in which they must come. */
class JpegMarkers
{
public:
  JpegMarkers(const std::string & piece, FileBytes & bytes, std::uint64_t offset, std::uint64_t count)
    : m_Piece(piece)
    , m_Reader(bytes, offset, offset + count)
  {}

  std::uint64_t
  Samples()
  {
    if (Byte() != 0xFF || Byte() != 0xD8)
    {
      Refuse("damaged: does not begin as a JPEG");
    }
    int marker = 0;
    while ((marker = NextMarker()) != 0xDA)
    {
      ReadSegment(marker);
    }
    if (m_Samples == 0)
    {
      Refuse("damaged: its JPEG has pixels without a size");
    }
    SkipSegment(Word());
    RequireEnd();
    return m_Samples;
  }

private:
  int
  Byte()
  {
    const int byte = m_Reader.Next();
    if (byte < 0)
    {
      Refuse("truncated: its JPEG has no end");
    }
    return byte;
  }

  unsigned
  Word()
  {
    const auto high = static_cast<unsigned>(Byte());
    return 256U * high + static_cast<unsigned>(Byte());
  }

  int
  NextMarker()
  {
    if (Byte() != 0xFF)
    {
      Refuse("damaged: its JPEG has no marker where one must be");
    }
    int marker = 0xFF;
    while (marker == 0xFF)
    {
      marker = Byte();
    }
    return marker;
  }

  void
  SkipSegment(unsigned length)
  {
    if (length < 2)
    {
      Refuse("damaged: its JPEG has a segment of " + std::to_string(length) + " bytes; expected at least 2");
    }
    for (unsigned i = 2; i < length; ++i)
    {
      Byte();
    }
  }

  void
  ReadSegment(int marker)
  {
    if (marker == 0xD9 || marker == 0xD8 || marker == 0)
    {
      Refuse("damaged: its JPEG ends before its pixels");
    }
    const unsigned length = Word();
    const bool     isFrame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (!isFrame)
    {
      SkipSegment(length);
      return;
    }
    if (marker != 0xC3)
    {
      Refuse("compressed with loss, as JPEG; expected digital numbers as the sensor gave them");
    }
    if (m_Samples != 0 || length < 8)
    {
      Refuse("damaged: its JPEG has a size twice, or none; expected one");
    }
    Byte(); // bits of a sample
    const std::uint64_t height = Word();
    const std::uint64_t width = Word();
    const auto          components = static_cast<std::uint64_t>(Byte());
    m_Samples = height * width * components;
    SkipSegment(length - 6);
  }

  /** Requires that the next marker behind the scan, apart from restarts, is the end of the image. */
  void
  RequireEnd()
  {
    for (;;)
    {
      if (Byte() != 0xFF)
      {
        continue;
      }
      int next = Byte();
      while (next == 0xFF)
      {
        next = Byte();
      }
      if (next == 0xD9)
      {
        return;
      }
      if (next != 0 && (next < 0xD0 || next > 0xD7))
      {
        Refuse("damaged: the pixels of its JPEG are followed by marker " + std::to_string(next) + "; expected its end");
      }
    }
  }

  [[noreturn]] void
  Refuse(const std::string & what) const
  {
    throw FileError(m_Piece, what);
  }

  const std::string & m_Piece;
  ByteReader          m_Reader;
  std::uint64_t       m_Samples{ 0 };
};
} // namespace

std::uint64_t
SamplesOfLosslessJpeg(const std::string & piece, FileBytes & bytes, std::uint64_t offset, std::uint64_t count)
{
  return JpegMarkers(piece, bytes, offset, count).Samples();
}

} // namespace sensornoise
