// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzedPng_h
#define FuzzedPng_h

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

extern "C" std::size_t
LLVMFuzzerMutate(std::uint8_t * data, std::size_t size, std::size_t maximumSize);

/** Chunk of a PNG. */
struct FuzzedPngChunk
{
  std::string type{};
  std::string data{};
};

/** Returns the chunks behind the signature, as far as they are whole. Checksums are not looked at. */
inline std::vector<FuzzedPngChunk>
ChunksOfPng(const std::string & png)
{
  const auto byte = [&png](std::size_t i) { return std::size_t{ static_cast<unsigned char>(png[i]) }; };
  std::vector<FuzzedPngChunk> chunks;
  for (std::size_t at = 8; at + 12 <= png.size();)
  {
    const std::size_t length = (byte(at) << 24) | (byte(at + 1) << 16) | (byte(at + 2) << 8) | byte(at + 3);
    if (length > png.size() - at - 12)
    {
      break;
    }
    chunks.push_back({ png.substr(at + 4, 4), png.substr(at + 8, length) });
    at += length + 12;
  }
  return chunks;
}

/** Returns the file of these chunks, with the checksums that belong to them. */
inline std::string
PngOfChunks(const std::vector<FuzzedPngChunk> & chunks)
{
  const auto number = [](std::size_t value) {
    std::string bytes;
    for (const unsigned shift : { 24U, 16U, 8U, 0U })
    {
      bytes += static_cast<char>(value >> shift);
    }
    return bytes;
  };
  std::string png = "\x89PNG\r\n\x1A\n";
  for (const FuzzedPngChunk & chunk : chunks)
  {
    const std::string checked = chunk.type + chunk.data;
    png += number(chunk.data.size()) + checked +
           number(crc32(0, reinterpret_cast<const unsigned char *>(checked.data()), static_cast<uInt>(checked.size())));
  }
  return png;
}

/** Returns the text as libFuzzer changes it, at most \a growth bytes longer. */
inline std::string
Mutated(std::string text, std::size_t growth)
{
  const std::size_t size = text.size();
  text.resize(size + growth);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t *>(text.data()), size, text.size()));
  return text;
}

/** Returns the stream of zlib with its bytes changed before the compression; the stream itself where it is none. */
inline std::string
MutatedStream(const std::string & stream, std::size_t growth)
{
  constexpr uLongf mostBytes = 1 << 16;
  std::string      bytes(mostBytes, '\0');
  uLongf           count = mostBytes;
  if (uncompress(reinterpret_cast<unsigned char *>(bytes.data()),
                 &count,
                 reinterpret_cast<const unsigned char *>(stream.data()),
                 static_cast<uLong>(stream.size())) != Z_OK)
  {
    return stream;
  }
  bytes = Mutated(bytes.substr(0, count), growth);
  uLongf      packedBytes = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(packedBytes, '\0');
  compress(reinterpret_cast<unsigned char *>(packed.data()),
           &packedBytes,
           reinterpret_cast<const unsigned char *>(bytes.data()),
           static_cast<uLong>(bytes.size()));
  return packed.substr(0, packedBytes);
}

/** Changes a PNG for libFuzzer. One change of four ignores the format. The others put the checksums right: of chunks
 * in the changed file, of a changed chunk, and of changed rows, compressed again. Without them, no changed file would
 * be read beyond its first checksum. */
inline std::size_t
MutatePng(std::uint8_t * data, std::size_t size, std::size_t maximumSize, unsigned seed)
{
  constexpr std::size_t       growth = 64; // [bytes] of a chunk
  std::vector<FuzzedPngChunk> chunks = ChunksOfPng(std::string(reinterpret_cast<const char *>(data), size));
  if (seed % 4 == 0 || chunks.empty())
  {
    return LLVMFuzzerMutate(data, size, maximumSize);
  }
  FuzzedPngChunk & chosen = chunks[seed / 4 % chunks.size()];
  if (seed % 4 == 1)
  {
    size = LLVMFuzzerMutate(data, size, maximumSize);
    chunks = ChunksOfPng(std::string(reinterpret_cast<const char *>(data), size));
  }
  else if (seed % 4 == 2)
  {
    chosen.data = Mutated(chosen.data, growth);
  }
  else
  {
    for (FuzzedPngChunk & chunk : chunks)
    {
      chunk.data = chunk.type == "IDAT" ? MutatedStream(chunk.data, growth) : chunk.data;
    }
  }
  const std::string png = PngOfChunks(chunks);
  if (png.size() > maximumSize)
  {
    return size;
  }
  png.copy(reinterpret_cast<char *>(data), png.size());
  return png.size();
}

#endif
