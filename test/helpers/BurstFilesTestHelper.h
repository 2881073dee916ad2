// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_BurstFilesTestHelper_h
#define sensornoise_test_BurstFilesTestHelper_h

#include "helpers/CompressedBytesTestHelper.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/** \file
 * Recordings of cameras, made byte by byte. */

namespace sensornoise::test
{

using GreyValues = std::vector<unsigned>;

inline std::string
BytesOfGreyValues(const GreyValues & greyValues, std::size_t bytes, bool isBigEndian = false)
{
  std::string text;
  for (const unsigned greyValue : greyValues)
  {
    AppendNumber(text, greyValue, bytes, isBigEndian);
  }
  return text;
}

/** Returns a stream of bits, of each grey value and of each byte the highest first, or the lowest. */
inline std::string
BitStream(const GreyValues & greyValues, unsigned bits, bool isHighestFirst)
{
  std::string text((greyValues.size() * bits + 7) / 8, '\0');
  std::size_t at = 0;
  for (const unsigned greyValue : greyValues)
  {
    for (unsigned i = 0; i < bits; ++i, ++at)
    {
      const unsigned bit = (greyValue >> (isHighestFirst ? bits - 1 - i : i)) & 1U;
      const unsigned place = static_cast<unsigned>(at % 8);
      text[at / 8] =
        static_cast<char>(static_cast<unsigned char>(text[at / 8]) | (bit << (isHighestFirst ? 7 - place : place)));
    }
  }
  return text;
}

/** Returns the grey values as Mono10Packed or Mono12Packed of GigE Vision. */
inline std::string
GigEPacked(const GreyValues & greyValues, unsigned bits)
{
  std::string    text;
  const unsigned low = (1U << (bits - 8)) - 1;
  for (std::size_t i = 0; i + 1 < greyValues.size(); i += 2)
  {
    text += static_cast<char>(greyValues[i] >> (bits - 8));
    text += static_cast<char>((greyValues[i] & low) | ((greyValues[i + 1] & low) << 4));
    text += static_cast<char>(greyValues[i + 1] >> (bits - 8));
  }
  return text;
}

/** Returns the grey values as RAW10 (4 in 5 bytes), RAW12 (2 in 3) or RAW14 (4 in 7) of MIPI CSI-2. */
inline std::string
MipiPacked(const GreyValues & greyValues, unsigned bits)
{
  const std::size_t group = bits == 12 ? 2 : 4;
  std::string       text;
  for (std::size_t first = 0; first + group <= greyValues.size(); first += group)
  {
    GreyValues low;
    for (std::size_t i = first; i < first + group; ++i)
    {
      text += static_cast<char>(greyValues[i] >> (bits - 8));
      low.push_back(greyValues[i] & ((1U << (bits - 8)) - 1));
    }
    text += BitStream(low, bits - 8, false);
  }
  return text;
}

/** A SER file. A test may change each of its members. */
struct SerOf
{
  unsigned    color{ 0 };
  unsigned    isLittleEndian{ 0 }; // as programs write it: 0 for lowest byte first
  unsigned    width{ 7 };
  unsigned    height{ 5 };
  unsigned    depth{ 12 };
  unsigned    frames{ 4 };
  std::string instrument{ "A camera" };
  std::string pixels{};
  std::string trailer{};

  std::string
  Bytes() const
  {
    std::string text = "LUCAM-RECORDER";
    for (const unsigned number : { 0U, color, isLittleEndian, width, height, depth, frames })
    {
      AppendNumber(text, number, 4, false);
    }
    const auto name = [](std::string words) {
      words.resize(40, ' ');
      return words;
    };
    text += name("") + name(instrument) + name("");
    return text + std::string(16, '\0') + pixels + trailer;
  }
};

/** The header of a Photron camera's recording. */
struct CihxOf
{
  unsigned    width{ 8 };
  unsigned    height{ 5 };
  unsigned    frames{ 4 };
  unsigned    bits{ 12 };
  unsigned    depth{ 12 };
  std::string side{ "Lower" };
  std::string more{}; // elements at its end

  std::string
  Bytes() const
  {
    const auto number = [](unsigned n) { return std::to_string(n); };
    return std::string("\1\2<junk", 7) +
           "<?xml version=\"1.0\"?>\r\n<cih>\r\n  <!-- <a> -->\r\n<fileInfo><date>1</date></fileInfo>" +
           "<deviceInfo><deviceName>FASTCAM Mini</deviceName></deviceInfo>\r\n" +
           "<recordInfo><recordRate>1000</recordRate><shutterSpeed>5000</shutterSpeed>" +
           "<shutterSpeedNsec>200000</shutterSpeedNsec></recordInfo>" + "<frameInfo><totalFrame>" + number(frames) +
           "</totalFrame><startFrame/></frameInfo>" +
           "<imageFileInfo><fileFormat>MRaw</fileFormat></imageFileInfo><imageDataInfo><resolution><width>" +
           number(width) + "</width><height> " + number(height) +
           " </height></resolution><colorInfo a=\"1\"><type>Mono</type><bit>" + number(bits) +
           "</bit></colorInfo><effectiveBit><depth>" + number(depth) + "</depth><side>" + side +
           "</side></effectiveBit></imageDataInfo>" + more + "</cih>\r\n\xFF<";
  }
};

} // namespace sensornoise::test

#endif
