// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_PngChunks_h
#define sensornoise_files_PngChunks_h

#include "files/FileBytes.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sensornoise
{

/** A chunk of a PNG file. */
struct PngChunk
{
  std::string   type{};
  std::uint64_t data{ 0 };   // where its data begins
  std::uint64_t length{ 0 }; // of its data
};

/** Reads the chunks of a PNG file, one after the other. */
class PngChunks
{
public:
  using Sink = std::function<void(const unsigned char * bytes, std::size_t count)>;

  PngChunks(const std::string & file, FileBytes & bytes);

  /** The head of the next chunk. Throws FileError where the file ends before the chunk does. */
  PngChunk
  Next();

  /** Reads the data of a chunk, which goes to \a sink, where there is one. Throws FileError if its checksum is wrong.
   */
  void
  Read(const PngChunk & chunk, const Sink & sink = {});

private:
  std::string                m_File;
  FileBytes &                m_Bytes;
  std::uint64_t              m_Offset{ 8 }; // of the next chunk
  std::vector<unsigned char> m_Buffer;
};

/** A number of four bytes, the highest first, as PNG has them. */
std::uint32_t
PngNumber(const unsigned char * bytes);

} // namespace sensornoise

#endif
