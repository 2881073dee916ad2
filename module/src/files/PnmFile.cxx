// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "files/FrameReader.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

namespace sensornoise
{
namespace
{
/** Header of an image. */
struct PgmHeader
{
  std::uint64_t width{ 0 };
  std::uint64_t height{ 0 };
  std::uint64_t maximum{ 0 };
  std::uint64_t bytes{ 0 }; // size of the header [bytes]

  bool
  operator==(const PgmHeader & other) const
  {
    return std::tie(width, height, maximum, bytes) == std::tie(other.width, other.height, other.maximum, other.bytes);
  }
};

bool
IsBlankOfPgm(int byte)
{
  return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

/** Reads a header: P5, then three numbers, each behind spaces or comments; one space ends the header. */
class PgmReader
{
public:
  PgmReader(const std::string & file, FileBytes & bytes, std::uint64_t offset)
    : m_File(file)
    , m_Reader(bytes, offset, bytes.Size())
    , m_Begin(offset)
  {}

  PgmHeader
  Read()
  {
    const int letter = m_Reader.Next();
    const int kind = m_Reader.Next();
    if (letter != 'P' || kind != '5')
    {
      throw FileError(m_File,
                      "damaged: at byte " + std::to_string(m_Begin) +
                        " is no header of an image; expected P5 there, or the end of the file");
    }
    PgmHeader header;
    m_Byte = m_Reader.Next();
    header.width = Number("width");
    header.height = Number("height");
    header.maximum = Number("largest value");
    header.bytes = m_Reader.Offset() - m_Begin; // includes the one space behind the last number
    if (header.maximum < 1 || header.maximum > 65535)
    {
      throw FileError(m_File,
                      "damaged: its largest value is " + std::to_string(header.maximum) + "; expected 1 to 65535");
    }
    return header;
  }

private:
  std::uint64_t
  Number(const char * name)
  {
    constexpr std::uint64_t most = std::uint64_t{ 1 } << 40;
    bool                    isComment = false;
    bool                    hasBlank = false;
    for (; isComment || IsBlankOfPgm(m_Byte) || m_Byte == '#'; m_Byte = m_Reader.Next())
    {
      RequireLength();
      hasBlank = true;
      isComment = (isComment || m_Byte == '#') && m_Byte != '\n' && m_Byte != '\r' && m_Byte >= 0;
      if (m_Byte < 0)
      {
        break;
      }
    }
    std::uint64_t number = 0;
    std::size_t   digits = 0;
    for (; m_Byte >= '0' && m_Byte <= '9' && number < most; m_Byte = m_Reader.Next(), ++digits)
    {
      number = 10 * number + static_cast<std::uint64_t>(m_Byte - '0');
    }
    if (!hasBlank || digits == 0 || !IsBlankOfPgm(m_Byte))
    {
      throw FileError(m_File,
                      "damaged: the " + std::string(name) + " in the header at byte " + std::to_string(m_Begin) +
                        " is no number; expected P5, width, height and largest value");
    }
    return number;
  }

  void
  RequireLength()
  {
    constexpr std::uint64_t longest = 65536; // [bytes], with comments
    if (m_Reader.Offset() - m_Begin > longest)
    {
      throw FileError(m_File, "damaged: a header of more than " + std::to_string(longest) + " bytes; expected less");
    }
  }

  const std::string & m_File;
  ByteReader          m_Reader;
  std::uint64_t       m_Begin;
  int                 m_Byte{ -1 };
};

/** Throws FileError for the other formats of Netpbm. */
void
RequirePgm(const std::string & file, FileBytes & bytes)
{
  std::array<char, 2> head{};
  bytes.Read(0, head.data(), head.size());
  switch (head[1])
  {
    case '5':
      return;
    case '3':
    case '6':
      throw FileError(file, SeveralComponents(3));
    case '2':
      throw FileError(file, "a PGM file of text (P2); expected binary grey values (P5): pamtopnm FILE > OTHER.pgm");
    default:
      throw FileError(file, std::string("a file of Netpbm (P") + head[1] + ") without grey values; expected PGM (P5)");
  }
}

/** Returns n if the largest value is 2^n - 1, else 0. */
unsigned
BitsOfMaximum(std::uint64_t maximum)
{
  unsigned bits = 0;
  while ((maximum >> bits) != 0)
  {
    ++bits;
  }
  return maximum + 1 == std::uint64_t{ 1 } << bits ? bits : 0;
}
} // namespace

bool
IsHeadOfPnm(const std::string & head, const std::string & /*name*/)
{
  return head.size() > 2 && head[0] == 'P' && head[1] >= '1' && head[1] <= '7' &&
         (IsBlankOfPgm(static_cast<unsigned char>(head[2])) || head[2] == '#');
}

void
InspectPnm(FileBytes & bytes, FrameFile & file, const BeforeInflating & /*beforeInflating*/)
{
  RequirePgm(file.name, bytes);
  const PgmHeader header = PgmReader(file.name, bytes, 0).Read();
  FramePlaces     places;
  places.path = file.name;
  places.offset = header.bytes;
  places.sample.pixel = header.maximum < 256 ? FramePixel::UnsignedChar : FramePixel::UnsignedShort;
  places.sample.isBigEndian = true;
  places.sample.bits = static_cast<unsigned>(8 * SizeOf(places.sample.pixel));
  places.gapBytes = header.bytes;
  file.pixel = places.sample.pixel;
  SetFrameSizes(file, { header.width, header.height });
  const std::uint64_t step = header.bytes + file.bytes;
  std::uint64_t       frames = 1;
  for (; frames * step < bytes.Size(); ++frames)
  {
    if (!(PgmReader(file.name, bytes, frames * step).Read() == header))
    {
      throw FileError(
        file.name,
        "the header of image " + std::to_string(frames) +
          " differs from the header of the first; expected the same size, largest value and length of all headers");
    }
  }
  SetFramePlaces(file, places, bytes.Size(), frames);
  const unsigned bits = BitsOfMaximum(header.maximum);
  file.camera.bitDepth = bits == 16 ? 0 : bits; // programs write 65535 for sensors of any bit depth
}

} // namespace sensornoise
