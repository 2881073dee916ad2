// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "base/Text.h"
#include "files/Compression.h"
#include "files/FrameReader.h"
#include "files/PngChunks.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace sensornoise
{
namespace
{
/** Reads a PNG chunk by chunk and checks it. */
class PngInspection
{
public:
  /** The pixels are written to \a pixels, which has space for \a capacity bytes. With null, they are only checked. */
  PngInspection(FileBytes &             bytes,
                FrameFile &             file,
                const BeforeInflating & beforeInflating,
                unsigned char *         pixels = nullptr,
                std::uint64_t           capacity = 0)
    : m_Bytes(bytes)
    , m_Chunks(file.name, bytes)
    , m_File(file)
    , m_BeforeInflating(beforeInflating)
    , m_Pixels(pixels)
    , m_Capacity(capacity)
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

  /** Throws FileError unless the chunk is allowed at its place. */
  void
  CheckChunk(const PngChunk & chunk)
  {
    const bool isCritical = chunk.type[0] >= 'A' && chunk.type[0] <= 'Z';
    if ((chunk.type == "IHDR") == m_HasHeader)
    {
      Refuse(m_HasHeader ? "damaged: two IHDR chunks; expected one"
                         : "damaged: begins with the chunk " + chunk.type + "; expected IHDR first");
    }
    if (chunk.type == "IHDR")
    {
      ReadHeader(chunk);
    }
    else if (chunk.type == "tRNS")
    {
      Refuse("a transparent grey value (tRNS): " + SeveralComponents(2));
    }
    else if (chunk.type == "sCAL" && !m_Inflater)
    {
      ReadScale(chunk);
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
    m_Chunks.Read(chunk); // checks the checksum before the header is used
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
      Refuse(std::to_string(depth) + " bits a pixel; expected 8 or 16");
    }
    if (header[10] != 0 || header[11] != 0 || header[12] > 1)
    {
      Refuse("damaged: compression " + std::to_string(header[10]) + ", filters " + std::to_string(header[11]) +
             ", interlacing " + std::to_string(header[12]) + "; expected 0, 0, and 0 or 1");
    }
    m_Interlaced = header[12] == 1;
    m_File.pixel = depth == 8 ? FramePixel::UnsignedChar : FramePixel::UnsignedShort;
    SetFrameSizes(m_File, { width, height });
    if (m_BeforeInflating)
    {
      m_BeforeInflating(m_File);
    }
  }

  /** Sets the spacing from the size of a pixel: a unit, and width and height as text. The chunk is a hint, so that a
   * size which cannot be read is no error. */
  void
  ReadScale(const PngChunk & chunk)
  {
    constexpr std::uint64_t longest = 256;
    std::string             text(static_cast<std::size_t>(std::min(chunk.length, longest)), ' ');
    m_Bytes.Read(chunk.data, text.data(), text.size());
    const std::size_t           end = text.find('\0');
    const bool                  isPair = end != std::string::npos && end > 1;
    const std::optional<double> width = isPair ? FiniteNumber(text.substr(1, end - 1)) : std::nullopt;
    const std::optional<double> height = isPair ? FiniteNumber(text.substr(end + 1)) : std::nullopt;
    if (width && height && *width > 0.0 && *height > 0.0)
    {
      m_File.geometry.spacing = { { *width, *height, 1.0 } };
    }
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
      if (m_Pixels != nullptr && m_File.bytes != m_Capacity)
      {
        Refuse("has changed since it was opened: its pixels have " + std::to_string(m_File.bytes) +
               " bytes; expected " + std::to_string(m_Capacity));
      }
      m_Rows = std::make_unique<PngRows>(m_File.width, m_File.height, SizeOf(m_File.pixel), m_Interlaced, m_Pixels);
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
  }

  FileBytes &               m_Bytes;
  PngChunks                 m_Chunks;
  FrameFile &               m_File;
  const BeforeInflating &   m_BeforeInflating;
  unsigned char *           m_Pixels;
  std::uint64_t             m_Capacity; // space in m_Pixels [bytes]
  bool                      m_HasHeader{ false };
  bool                      m_Interlaced{ false };
  bool                      m_PixelsEnded{ false };
  std::uint64_t             m_PixelBytes{ 0 };
  std::unique_ptr<PngRows>  m_Rows;
  std::unique_ptr<Inflater> m_Inflater;
};

/** Reads the frame of a PNG by a second inspection, which writes the pixels. */
class PngFrame : public FrameReader
{
public:
  void
  Read(const FrameFile & file, std::size_t /*first*/, std::size_t count, void * buffer) const override
  {
    if (count == 0)
    {
      return;
    }
    FileBytes bytes(file.name);
    FrameFile found;
    found.name = file.name;
    PngInspection(bytes, found, m_Before, static_cast<unsigned char *>(buffer), file.bytes).Run();
    ToOwnByteOrder(true, SizeOf(file.pixel), file.width * file.height, buffer);
  }

private:
  BeforeInflating m_Before{};
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
  file.reader = std::make_shared<PngFrame>();
}

} // namespace sensornoise
