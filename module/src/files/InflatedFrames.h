// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_InflatedFrames_h
#define sensornoise_files_InflatedFrames_h

#include "files/DataFile.h"
#include "files/FileBytes.h"
#include "files/FrameReader.h"
#include "files/Inflate.h"
#include "files/SamplePacking.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** One compressed stream at its place in a file. */
struct CompressedPlace
{
  DataPlace        place{};
  InflateContainer container{ InflateContainer::Gzip };
  std::uint64_t    compressedBytes{ 0 }; // 0: all up to the end of the file
  std::uint64_t    bytes{ 0 };           // that it gives
};

/** Inflates such a stream progressively and checks it on the way. Holds 128 KiB. Errors are FileError. */
class InflatedBytes
{
public:
  /** Throws if there are fewer compressed bytes than the header says. */
  InflatedBytes(const std::string & file, const CompressedPlace & from);

  /** Inflates the next \a count bytes into \a out; null: drops them. Throws if the stream does not give so many. */
  void
  Read(void * out, std::uint64_t count);

  /** Throws unless the stream ends here, with the right checksum, and the file with it. */
  void
  RequireEnd();

private:
  std::size_t
  ReadSome(unsigned char * out, std::size_t count);
  [[noreturn]] void
  Refuse() const;

  std::string                m_File;
  CompressedPlace            m_From;
  FileBytes                  m_Bytes;
  std::uint64_t              m_Found; // compressed bytes from the place to the end of the file
  std::uint64_t              m_Next;  // offset of the compressed byte that comes next
  std::uint64_t              m_End;   // offset behind the compressed bytes
  std::vector<unsigned char> m_In;
  Inflater                   m_Inflater;
};

/** Throws FileError unless the stream gives exactly its bytes, and the file ends with it. */
void
RequireInflates(const std::string & file, const CompressedPlace & from);

/** Reads frames of one compressed stream. A frame behind those that were read last continues the stream; one before
 * begins it anew. */
class InflatedFrames : public FrameReader
{
public:
  InflatedFrames(CompressedPlace from, const SampleFormat & sample)
    : m_From(std::move(from))
    , m_Sample(sample)
  {}

  void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const override;

  bool
  IsSequential() const override
  {
    return true;
  }

private:
  CompressedPlace                        m_From;
  SampleFormat                           m_Sample;
  mutable std::mutex                     m_Mutex;
  mutable std::unique_ptr<InflatedBytes> m_Stream;        // null: at its beginning
  mutable std::uint64_t                  m_Position{ 0 }; // inflated bytes that were read
};

} // namespace sensornoise

#endif
