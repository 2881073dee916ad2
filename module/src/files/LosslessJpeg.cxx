// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/LosslessJpeg.h"

#include "sensornoise/FrameFile.h"

#include <string>

namespace sensornoise
{
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
      Refuse("compressed with loss, as JPEG; expected codes as the sensor gave them");
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

  /** Of the scan: the next marker that is no restart is the end of the image. */
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
