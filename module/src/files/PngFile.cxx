// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/PngFile.h"

#include "sensornoise/FrameFile.h"
#include "files/FrameSizes.h"
#include "files/Inflate.h"
#include "files/PngChunks.h"
#include "files/PngRows.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace sensornoise
{
namespace
{
// libpng's own limits, beyond which it ends the reading, and ITK 5.2 with it the program.
constexpr std::uint64_t MaximumPngSide = 1000000;
constexpr std::uint64_t MaximumPngChunk = 8000000;

/** What is read from a PNG on the way through its chunks. */
class PngInspection
{
public:
  PngInspection(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
    : m_Bytes(bytes)
    , m_Chunks(file.name, bytes)
    , m_File(file)
    , m_BeforeInflating(beforeInflating)
  {}

  void
  Run()
  {
    for (bool ended = false; !ended;)
    {
      const PngChunk chunk = m_Chunks.Next();
      CheckChunk(chunk);
      ReadChunk(chunk);
      ended = chunk.type == "IEND";
    }
    RequirePixels();
  }

private:
  [[noreturn]] void
  Refuse(const std::string & what) const
  {
    throw FileError(m_File.name, what);
  }

  /** Throws unless the chunk is at its place. */
  void
  CheckChunk(const PngChunk & chunk)
  {
    const bool isCritical = chunk.type[0] >= 'A' && chunk.type[0] <= 'Z';
    if ((chunk.type == "IHDR") == m_HasHeader)
    {
      Refuse(m_HasHeader ? "damaged: two IHDR chunks; expected one"
                         : "damaged: begins with the chunk " + chunk.type + "; expected IHDR first");
    }
    const std::uint64_t limit = chunk.type == "IDAT" ? MaximumPixelChunk() : MaximumPngChunk;
    if (chunk.length > limit)
    {
      Refuse("its chunk " + chunk.type + " has " + std::to_string(chunk.length) + " bytes; expected at most " +
             std::to_string(limit));
    }
    if (chunk.type == "IHDR")
    {
      ReadHeader(chunk);
    }
    else if (chunk.type == "tRNS")
    {
      Refuse("a transparent grey value (tRNS): " + SeveralComponents(2));
    }
    else if (chunk.type == "sBIT")
    {
      ReadSignificantBits(chunk);
    }
    else if (chunk.type == "IEND" ? chunk.length != 0 : isCritical && chunk.type != "IDAT")
    {
      Refuse("its chunk " + chunk.type + " of " + std::to_string(chunk.length) +
             " bytes has no place in a grey PNG; expected IHDR, IDAT and IEND");
    }
    if (chunk.type == "IDAT" && m_PixelsEnded)
    {
      Refuse("damaged: IDAT chunks apart from each other; expected one after the other");
    }
    m_PixelsEnded = m_PixelsEnded || (m_Inflater && chunk.type != "IDAT");
  }

  /** As libpng reckons it. */
  std::uint64_t
  MaximumPixelChunk() const
  {
    const std::uint64_t row = m_File.width * SizeOf(m_File.pixel) + 7;
    const std::uint64_t all = m_File.height * row;
    return std::max(MaximumPngChunk, all + 6 + 5 * (all / std::min<std::uint64_t>(row, 32566) + 1));
  }

  void
  ReadHeader(const PngChunk & chunk)
  {
    std::array<unsigned char, 13> header{};
    if (chunk.length != header.size())
    {
      Refuse("damaged: an IHDR chunk of " + std::to_string(chunk.length) + " bytes; expected 13");
    }
    m_Bytes.Read(chunk.data, header.data(), header.size());
    m_HasHeader = true;
    const unsigned      depth = header[8];
    const unsigned      colour = header[9];
    const std::uint64_t width = PngNumber(header.data());
    const std::uint64_t height = PngNumber(header.data() + 4);
    m_Chunks.Read(chunk); // before the header is believed
    if (colour != 0)
    {
      const std::uint64_t components = colour == 4 ? 2 : colour == 6 ? 4 : 3;
      Refuse(colour == 3 ? "a palette of colours: " + SeveralComponents(components)
             : colour == 2 || colour == 4 || colour == 6
               ? SeveralComponents(components)
               : "damaged: the colour type " + std::to_string(colour) + "; expected 0 (grey)");
    }
    if (depth != 8 && depth != 16)
    {
      Refuse(std::to_string(depth) + " bits a pixel, which ITK stretches to 8; expected 8 or 16");
    }
    if (header[10] != 0 || header[11] != 0 || header[12] > 1)
    {
      Refuse("damaged: compression " + std::to_string(header[10]) + ", filters " + std::to_string(header[11]) +
             ", interlacing " + std::to_string(header[12]) + "; expected 0, 0, and 0 or 1");
    }
    if (width > MaximumPngSide || height > MaximumPngSide)
    {
      Refuse(std::to_string(width) + " x " + std::to_string(height) + " pixels; expected at most " +
             std::to_string(MaximumPngSide) + " along each side, libpng's limit");
    }
    m_Interlaced = header[12] == 1;
    m_File.pixel = depth == 8 ? FramePixel::UnsignedChar : FramePixel::UnsignedShort;
    SetFrameSizes(m_File, { width, height });
    if (m_BeforeInflating)
    {
      m_BeforeInflating(m_File);
    }
  }

  void
  ReadSignificantBits(const PngChunk & chunk)
  {
    unsigned char  bits = 0;
    const unsigned depth = static_cast<unsigned>(8 * SizeOf(m_File.pixel));
    if (chunk.length == 1)
    {
      m_Bytes.Read(chunk.data, &bits, 1);
    }
    if (m_Inflater || m_HasSignificantBits || bits == 0 || bits > depth)
    {
      Refuse("damaged: an sBIT chunk of " + std::to_string(chunk.length) + " bytes that says " + std::to_string(bits) +
             " bits, or at a wrong place; expected one before the pixels, of 1 to " + std::to_string(depth) + " bits");
    }
    m_HasSignificantBits = true;
    m_File.significantBits = bits < depth ? bits : 0;
  }

  void
  ReadChunk(const PngChunk & chunk)
  {
    if (chunk.type != "IDAT")
    {
      m_Chunks.Read(chunk);
      return;
    }
    if (!m_Inflater)
    {
      m_Rows = std::make_unique<PngRows>(
        m_File.width, m_File.height, SizeOf(m_File.pixel), m_Interlaced, m_File.significantBits);
      m_Inflater = std::make_unique<Inflater>(
        InflateContainer::Zlib, m_Rows->Bytes(), [this](const unsigned char * bytes, std::size_t count) {
          m_Rows->Add(bytes, count);
        });
    }
    m_Chunks.Read(chunk, [this](const unsigned char * bytes, std::size_t count) { m_Inflater->Add(bytes, count); });
    m_PixelBytes += chunk.length;
  }

  void
  RequirePixels() const
  {
    if (!m_Inflater)
    {
      Refuse("damaged: no IDAT chunk; expected the pixels in one or several");
    }
    if (!m_Inflater->IsWhole() || m_Inflater->UsedBytes() != m_PixelBytes)
    {
      Refuse("damaged: its compressed pixels give " + m_Inflater->ReceivedBytes() + " after " +
             std::to_string(m_Inflater->UsedBytes()) + " of " + std::to_string(m_PixelBytes) + " bytes, expected " +
             std::to_string(m_Rows->Bytes()) + " bytes and the end of the stream with the last");
    }
    if (!m_Rows->Error().empty())
    {
      Refuse("damaged: " + m_Rows->Error());
    }
    if (m_Rows->HasLowerBits())
    {
      Refuse("its sBIT chunk says that " + std::to_string(m_File.significantBits) + " of " +
             std::to_string(8 * SizeOf(m_File.pixel)) +
             " bits are significant, but the others are not 0, and ITK would drop them; expected a file without that "
             "chunk");
    }
  }

  FileBytes &               m_Bytes;
  PngChunks                 m_Chunks;
  FrameFile &               m_File;
  const BeforeInflating &   m_BeforeInflating;
  bool                      m_HasHeader{ false };
  bool                      m_Interlaced{ false };
  bool                      m_HasSignificantBits{ false };
  bool                      m_PixelsEnded{ false };
  std::uint64_t             m_PixelBytes{ 0 };
  std::unique_ptr<PngRows>  m_Rows;
  std::unique_ptr<Inflater> m_Inflater;
};
} // namespace

bool
IsHeadOfPng(const std::string & head, const std::string & /*name*/)
{
  return head.rfind("\x89PNG\r\n\x1A\n", 0) == 0;
}

void
InspectPng(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
{
  PngInspection(bytes, file, beforeInflating).Run();
}

} // namespace sensornoise
