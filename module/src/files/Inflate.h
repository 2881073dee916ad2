// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_Inflate_h
#define sensornoise_files_Inflate_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace sensornoise
{

class FileBytes;

/** What stands around compressed bytes, and holds their checksum. */
enum class InflateContainer
{
  Zlib,
  Gzip,
  ZlibOrGzip
};

/** Inflates a stream whose bytes come in pieces, and tells whether it gives exactly the bytes that are expected, a
 * clean end and the right checksum. Keeps nothing of them but 64 KiB. */
class Inflater
{
public:
  using Sink = std::function<void(const unsigned char * bytes, std::size_t count)>;

  /** What it inflates goes to \a sink, where there is one. */
  Inflater(InflateContainer container, std::uint64_t expectedBytes, Sink sink = {});
  ~Inflater();
  Inflater(const Inflater &) = delete;
  Inflater &
  operator=(const Inflater &) = delete;

  /** Inflates the next compressed bytes into the sink. Returns WantsMore(). */
  bool
  Add(const unsigned char * bytes, std::size_t count);

  /** Hands over the next compressed bytes, which must stay where they are until Take() has returned 0. */
  void
  Offer(const unsigned char * bytes, std::size_t count);

  /** Inflates up to \a count bytes into \a out. Returns their number; 0: all compressed bytes are used up, or
   * WantsMore() is false. */
  std::size_t
  Take(unsigned char * out, std::size_t count);

  /** Returns whether the stream goes on: not after its end, an error, or more bytes than expected. */
  bool
  WantsMore() const
  {
    return !m_Ended && m_Error.empty() && m_Found <= m_Expected;
  }

  /** Whether the stream has ended, with a right checksum and the expected number of bytes. */
  bool
  IsWhole() const;

  /** Compressed bytes that belonged to the stream. */
  std::uint64_t
  UsedBytes() const
  {
    return m_Used;
  }

  /** What came, in words: "280 bytes and then an error (incorrect data check)". */
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

/** Adds the bytes [offset, offset + count) of the file. */
void
InflateFrom(FileBytes & bytes, std::uint64_t offset, std::uint64_t count, Inflater & inflater);

} // namespace sensornoise

#endif
