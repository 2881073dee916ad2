// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "files/FileBytes.h"
#include "files/FrameReader.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace sensornoise
{
namespace
{
constexpr std::size_t   SerHeaderBytes = 178;
constexpr std::uint64_t SerTimeBytes = 8;

struct SerHeader
{
  std::uint64_t color{ 0 };
  std::uint64_t isLittleEndian{ 0 };
  std::uint64_t width{ 0 };
  std::uint64_t height{ 0 };
  std::uint64_t depth{ 0 }; // [bit]
  std::uint64_t frames{ 0 };
  std::string   instrument{};
};

SerHeader
ReadSerHeader(FileBytes & bytes)
{
  std::array<unsigned char, SerHeaderBytes> head{};
  bytes.Read(0, head.data(), head.size());
  const auto number = [&head](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
    {
      value = (value << 8) | head[at + i];
    }
    return value;
  };
  SerHeader header;
  header.color = number(18);
  header.isLittleEndian = number(22);
  header.width = number(26);
  header.height = number(30);
  header.depth = number(34);
  header.frames = number(38);
  const std::string instrument(head.begin() + 82, head.begin() + 122);
  header.instrument = PrintableText(instrument.substr(0, instrument.find('\0')));
  return header;
}

/** Returns the Bayer pattern; "" for grey pixels and other mosaics. Throws FileError unless a pixel is one raw value.
 */
std::string
BayerPatternOfSer(const FrameFile & file, std::uint64_t color)
{
  static const std::array<const char *, 4> patterns{ { "RGGB", "GRBG", "GBRG", "BGGR" } };
  if (color >= 8 && color < 8 + patterns.size())
  {
    return patterns.at(color - 8);
  }
  if (color == 100 || color == 101)
  {
    throw FileError(file.name,
                    "colours of three values a pixel (ColorID " + std::to_string(color) +
                      "), which are computed from others; expected the sensor's own, grey or a mosaic");
  }
  if (color != 0 && (color < 16 || color > 19)) // 16 to 19: mosaics of cyan, magenta and yellow
  {
    throw FileError(file.name, "damaged: ColorID is " + std::to_string(color) + "; expected 0, 8 to 11 or 16 to 19");
  }
  return "";
}

/** Reads the first frame, at most 2^20 pixels of it, in both byte orders. */
ByteOrders
ReadFirstFrame(FileBytes & bytes, const SerHeader & header)
{
  constexpr std::size_t most = std::size_t{ 1 } << 20;
  const auto            pixels = static_cast<std::size_t>(std::min<std::uint64_t>(header.width * header.height, most));
  std::vector<unsigned char> held(2 * pixels);
  bytes.Read(SerHeaderBytes, held.data(), held.size());
  return CompareByteOrders(held.data(), pixels, false);
}

/** Returns whether the highest byte is first; InspectSer() has the rule. */
bool
IsBigEndian(const SerHeader & header, const ByteOrders & frame)
{
  const bool           isBig = header.isLittleEndian != 0;
  const BytesInOrder & said = isBig ? frame.big : frame.little;
  const BytesInOrder & other = isBig ? frame.little : frame.big;
  return said.IsSwapped(other) ? !isBig : isBig;
}
} // namespace

bool
IsHeadOfSer(const std::string & head, const std::string & /*name*/)
{
  return head.rfind("LUCAM-RECORDER", 0) == 0;
}

void
InspectSer(FileBytes & bytes, FrameFile & file, const BeforeInflating & /*beforeInflating*/)
{
  SerHeader header = ReadSerHeader(bytes);
  file.camera.bayerPattern = BayerPatternOfSer(file, header.color);
  file.camera.camera = header.instrument;
  if (header.depth < 1 || header.depth > 16)
  {
    throw FileError(file.name,
                    "damaged: PixelDepthPerPlane is " + std::to_string(header.depth) + " bits; expected 1 to 16");
  }
  if (header.isLittleEndian > 1)
  {
    throw FileError(file.name,
                    "damaged: LittleEndian is " + std::to_string(header.isLittleEndian) + "; expected 0 or 1");
  }
  FramePlaces places;
  places.path = file.name;
  places.offset = SerHeaderBytes;
  places.sample.pixel = header.depth <= 8 ? FramePixel::UnsignedChar : FramePixel::UnsignedShort;
  file.pixel = places.sample.pixel;
  SetFrameSizes(file, { header.width, header.height });
  const std::uint64_t whole = (bytes.Size() - SerHeaderBytes) / file.bytes;
  if (header.frames == 0 && whole > 0)
  {
    // Programs write the number of frames when they close the file.
    header.frames = whole;
    places.endBytes = (bytes.Size() - SerHeaderBytes) % file.bytes;
    file.warning = "says 0 frames, but holds " + std::to_string(whole) + " and " + std::to_string(places.endBytes) +
                   " bytes more: the recording was not closed. All whole frames are read";
  }
  SetFrameSizes(file, { header.width, header.height, header.frames });
  SetFramePlaces(file, places, bytes.Size(), header.frames, SerTimeBytes);
  if (header.depth <= 8)
  {
    file.camera.bitDepth = static_cast<unsigned int>(header.depth);
    return;
  }
  const ByteOrders frame = ReadFirstFrame(bytes, header);
  places.sample.isBigEndian = IsBigEndian(header, frame);
  SetFramePlaces(file, places, bytes.Size(), header.frames, SerTimeBytes);
  // programs write 16 for any sensor, and some shift the digital numbers up
  const unsigned int largest = (places.sample.isBigEndian ? frame.big : frame.little).largest;
  file.camera.bitDepth = header.depth < 16 && (largest >> header.depth) == 0 ? static_cast<unsigned>(header.depth) : 0;
}

} // namespace sensornoise
