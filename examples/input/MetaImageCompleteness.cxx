/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "input/FormatCompleteness.h"
#include "input/TextHeader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <zlib.h>

namespace sensornoise::tools
{
namespace fs = std::filesystem;

namespace
{

/** Throws InputError unless the compressed bytes inflate to `expected` bytes and a clean end; nothing is kept.
 * MetaIO would read what is damaged as if it were whole. */
void
RequireInflates(const std::string & file,
                const fs::path &    dataFile,
                std::uint64_t       offset,
                std::uint64_t       compressed,
                std::uint64_t       expected)
{
  using Block = std::array<unsigned char, 65536>;
  const auto    in = std::make_unique<Block>();
  const auto    out = std::make_unique<Block>();
  std::ifstream stream(dataFile, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(offset));
  z_stream      zlib{};
  std::uint64_t found = 0;
  int           status = inflateInit2(&zlib, 15 + 32); // zlib or gzip, as MetaIO
  while (status == Z_OK && found <= expected)
  {
    if (zlib.avail_in == 0)
    {
      stream.read(reinterpret_cast<char *>(in->data()),
                  static_cast<std::streamsize>(std::min<std::uint64_t>(compressed, in->size())));
      compressed -= static_cast<std::uint64_t>(stream.gcount());
      zlib.next_in = in->data();
      zlib.avail_in = static_cast<uInt>(stream.gcount());
    }
    zlib.next_out = out->data();
    zlib.avail_out = static_cast<uInt>(out->size());
    status = inflate(&zlib, Z_NO_FLUSH);
    found += out->size() - zlib.avail_out;
  }
  inflateEnd(&zlib);
  if (status == Z_STREAM_END && found == expected)
  {
    return;
  }
  std::string what = std::to_string(found) + " bytes";
  if (found > expected)
  {
    what = "more than " + std::to_string(expected) + " bytes";
  }
  else if (status != Z_STREAM_END)
  {
    what += std::string(" and then an error (") + (zlib.msg != nullptr ? zlib.msg : "no end of the stream") + ")";
  }
  const std::string place = fs::path(file) == dataFile ? "" : " in its data file " + dataFile.string();
  Refuse(file,
         "damaged: its compressed pixels" + place + " give " + what + ", expected " + std::to_string(expected) +
           " bytes and the end of the stream");
}

bool
IsList(const std::string & dataFile)
{
  return dataFile.rfind("LIST", 0) == 0;
}

/** The bytes that a MetaImage with compressed pixels has for them. */
std::uint64_t
CompressedBytes(const std::string & file, const TextHeader & header, const std::string & dataFile, int headerSize)
{
  if (headerSize < 0 || IsList(dataFile))
  {
    Refuse(file, "compressed with a HeaderSize of -1 or in a list of data files; expected neither");
  }
  const std::uint64_t bytes = std::strtoull(header.Field("CompressedDataSize").c_str(), nullptr, 10);
  if (bytes == 0)
  {
    Refuse(file, "compressed without a CompressedDataSize in the header; without it nobody can tell if it is whole");
  }
  return bytes;
}

/** Throws InputError unless there is a data file with its share of `expected` bytes for each frame. */
void
CheckList(const std::string &      file,
          const TextHeader &       header,
          const std::string &      dataFile,
          const itk::MetaImageIO & io,
          std::uint64_t            skipped,
          std::uint64_t            expected)
{
  const std::uint64_t frames = io.GetNumberOfDimensions() == 3 ? io.GetDimensions(2) : 0;
  const std::string   dimension = Trimmed(dataFile.substr(4));
  if (frames == 0 || !(dimension.empty() || dimension == "2"))
  {
    Refuse(file, "ElementDataFile is " + dataFile + "; expected a list with one file for each frame of a 3-D image");
  }
  if (header.lines.size() < frames)
  {
    Refuse(file,
           "truncated: " + std::to_string(header.lines.size()) + " whole lines in its list of data files, expected " +
             std::to_string(frames));
  }
  for (std::uint64_t frame = 0; frame < frames; ++frame)
  {
    RequireBytes(file, fs::path(file).parent_path() / header.lines[frame], skipped, expected / frames);
  }
}

} // namespace

void
CheckMetaImage(const std::string & file, itk::MetaImageIO & io)
{
  const TextHeader    header = ReadTextHeader(file, "=:", "ElementDataFile");
  const std::string   dataFile = header.Field("ElementDataFile");
  const std::uint64_t bytes = io.GetImageSizeInBytes();
  const int           headerSize = io.GetMetaImagePointer()->HeaderSize();
  const std::uint64_t skipped = headerSize > 0 ? static_cast<std::uint64_t>(headerSize) : 0;

  if (!io.GetMetaImagePointer()->BinaryData())
  {
    Refuse(file, "BinaryData is False, and pixels written as text cannot be checked; expected binary pixels");
  }
  if (dataFile.find('%') != std::string::npos)
  {
    Refuse(file, "ElementDataFile is the pattern " + dataFile + "; expected LOCAL, LIST or the name of one file");
  }
  const bool          compressed = io.GetMetaImagePointer()->CompressedData();
  const std::uint64_t expected = compressed ? CompressedBytes(file, header, dataFile, headerSize) : bytes;
  if (IsList(dataFile))
  {
    CheckList(file, header, dataFile, io, skipped, expected);
    return;
  }
  const bool          local = dataFile == "LOCAL" || dataFile == "Local" || dataFile == "local";
  const fs::path      path = local ? fs::path(file) : fs::path(file).parent_path() / dataFile;
  const std::uint64_t offset = local && skipped == 0 ? header.end : skipped;
  RequireBytes(file, path, offset, expected);
  if (compressed)
  {
    RequireInflates(file, path, offset, expected, bytes);
  }
}

} // namespace sensornoise::tools
