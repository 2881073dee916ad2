// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_Compression_h
#define sensornoise_files_Compression_h

#include "files/FileBytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

/** \file
 * Decompression of the bytes of a file: of zlib and gzip, of LZW, and of lossless JPEG. */

namespace sensornoise
{

class FileBytes;

/** Format around the compressed bytes, which has their checksum. */
enum class InflateContainer
{
  Zlib,
  Gzip,
  ZlibOrGzip
};

/** Inflates a stream whose bytes come in pieces. Checks that it has exactly the expected bytes, a regular end and the
 * right checksum. Keeps at most 64 KiB of the bytes. */
class Inflater
{
public:
  using Sink = std::function<void(const unsigned char * bytes, std::size_t count)>;

  /** \a expectedBytes: size of the inflated bytes. Add() gives these to \a sink, if there is one. Throws std::bad_alloc
   * if zlib cannot be set up. */
  Inflater(InflateContainer container, std::uint64_t expectedBytes, Sink sink = {});
  ~Inflater();
  Inflater(const Inflater &) = delete;
  Inflater &
  operator=(const Inflater &) = delete;

  /** Inflates the next compressed bytes and gives the result to the sink. Returns WantsMore(). */
  bool
  Add(const unsigned char * bytes, std::size_t count);

  /** Sets the next compressed bytes, less than 4 GiB. They must stay valid until Take() returns 0. */
  void
  Offer(const unsigned char * bytes, std::size_t count);

  /** Inflates up to \a count bytes into \a out. Returns their number. 0 means that all compressed bytes are used, or
   * that WantsMore() is false. */
  std::size_t
  Take(unsigned char * out, std::size_t count);

  /** Returns whether the stream continues. It does not after its end, an error, or more bytes than expected. */
  bool
  WantsMore() const
  {
    return !m_Ended && m_Error.empty() && m_Found <= m_Expected;
  }

  /** Returns whether the stream has ended with the right checksum and the expected number of bytes. */
  bool
  IsWhole() const;

  /** Returns the number of compressed bytes of the stream so far. */
  std::uint64_t
  UsedBytes() const
  {
    return m_Used;
  }

  /** Returns the inflated bytes in words, for example "280 bytes and then an error (incorrect data check)". */
  std::string
  ReceivedBytes() const;

private:
  struct Stream;

  Sink                             m_Sink;
  std::uint64_t                    m_Expected;
  std::uint64_t                    m_Found{ 0 };
  std::uint64_t                    m_Used{ 0 };
  bool                             m_Ended{ false };
  std::string                      m_Error;
  std::unique_ptr<Stream>          m_Stream;
  std::array<unsigned char, 65536> m_Out{};
};

/** Adds the bytes [offset, offset + count) of a file to \a inflater, until it wants no more or the file ends. */
void
InflateFrom(FileBytes & bytes, std::uint64_t offset, std::uint64_t count, Inflater & inflater);

/** Number of decoded bytes of a strip that is compressed by LZW. LZW has no checksum, so that wrong bytes are not
 * detected. */
struct LzwResult
{
  std::uint64_t bytes{ 0 };
  std::string   error{}; // empty: all codes have a meaning
};

/** Decodes the LZW codes in the bytes [offset, offset + count) until they give \a expected bytes, or \a whole bytes if
 * a writer has filled up the strip, or until the codes end. The first \a expected bytes go to \a out unless it is null.
 */
LzwResult
DecodeLzw(FileBytes &     bytes,
          std::uint64_t   offset,
          std::uint64_t   count,
          std::uint64_t   expected,
          std::uint64_t   whole,
          unsigned char * out = nullptr);

/** Returns the number of samples that the lossless JPEG (ITU-T T.81, Annex H: SOF3) in these bytes declares. Throws
 * FileError, whose sentence begins with \a piece, where the bytes are no JPEG or a JPEG that loses something, or where
 * its only scan does not go on to the end of the image within these bytes. */
std::uint64_t
SamplesOfLosslessJpeg(const std::string & piece, FileBytes & bytes, std::uint64_t offset, std::uint64_t count);

} // namespace sensornoise

#endif
