// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TextHeader.h"

#include "files/FileBytes.h"
#include "files/FrameReader.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <utility>

namespace sensornoise
{
std::string
InDataFile(const std::string & file, const DataPlace & place)
{
  return file == place.path ? "" : " in its data file " + place.path;
}

void
RequireNothingLeft(const std::string & file, const DataPlace & place, std::uint64_t left)
{
  if (left > 0)
  {
    throw FileError(file,
                    std::to_string(left) + " bytes" + InDataFile(file, place) +
                      " are left over after its pixels; expected none");
  }
}

std::string
PathOfDataFile(const std::string & file, const std::string & name)
{
  return (std::filesystem::path(file).parent_path() / name).string();
}

void
AddDataFile(const std::string & file, const std::string & path, std::vector<FileIdentity> & identities)
{
  const FileIdentity identity = IdentityOfDataFile(file, path);
  if (AreSameFile(identity, identities.front()))
  {
    throw FileError(file, "its data file " + path + " is the file itself; expected another one");
  }
  for (const FileIdentity & other : identities)
  {
    if (AreSameFile(identity, other))
    {
      throw FileError(file, "its data file " + path + " comes twice in its list; expected each once");
    }
  }
  identities.push_back(identity);
}

std::uint64_t
RequireExactly(const std::string & file, const DataPlace & place, std::uint64_t expected, std::uint64_t frameBytes)
{
  const std::uint64_t size = FileBytes(file, place.path).Size();
  const std::uint64_t found = size > place.offset ? size - place.offset : 0;
  if (found < expected)
  {
    throw FileError(file,
                    "truncated: " + std::to_string(found) + " bytes of pixels" + InDataFile(file, place) +
                      ", expected " + std::to_string(expected));
  }
  if (!place.fromEnd)
  {
    RequireNothingLeft(file, place, found - expected);
    return place.offset;
  }
  if (found - expected >= frameBytes)
  {
    throw FileError(file,
                    std::to_string(found - expected) + " bytes" + InDataFile(file, place) +
                      " before its pixels, enough for another frame; expected the number of bytes to skip, not -1");
  }
  return size - expected;
}

namespace
{
constexpr std::size_t CompressedBlockBytes = 65536;

/** Place of one compressed stream in a file. */
struct CompressedPlace
{
  DataPlace        place{};
  InflateContainer container{ InflateContainer::Gzip };
  std::uint64_t    compressedBytes{ 0 }; // [bytes]; 0: up to the end of the file
  std::uint64_t    bytes{ 0 };           // inflated size [bytes]
};

/** Inflates a compressed stream progressively and checks it. Uses about 128 KiB of memory. Errors are FileError. */
class InflatedBytes
{
public:
  /** Throws if the file has fewer compressed bytes than the header declares. */
  InflatedBytes(const std::string & file, const CompressedPlace & from);

  /** Inflates the next \a count bytes into \a out, or drops them if it is null. Throws if the stream has fewer bytes.
   */
  void
  Read(void * out, std::uint64_t count);

  /** Throws unless the stream ends here with the right checksum, and the file ends with the stream. */
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
  std::uint64_t              m_Next;  // offset of the next compressed byte
  std::uint64_t              m_End;   // offset behind the compressed bytes
  std::vector<unsigned char> m_In;
  Inflater                   m_Inflater;
};

InflatedBytes::InflatedBytes(const std::string & file, const CompressedPlace & from)
  : m_File(file)
  , m_From(from)
  , m_Bytes(file, from.place.path)
  , m_Found(m_Bytes.Size() - std::min(m_Bytes.Size(), from.place.offset))
  , m_Next(from.place.offset)
  , m_End(m_Next + (from.compressedBytes == 0 ? m_Found : from.compressedBytes))
  , m_In(CompressedBlockBytes)
  , m_Inflater(from.container, from.bytes)
{
  if (m_Found < m_From.compressedBytes)
  {
    throw FileError(m_File,
                    "truncated: " + std::to_string(m_Found) + " bytes of compressed pixels" +
                      InDataFile(m_File, m_From.place) + ", expected " + std::to_string(m_From.compressedBytes));
  }
}

std::size_t
InflatedBytes::ReadSome(unsigned char * out, std::size_t count)
{
  std::size_t done = 0;
  while (done < count && m_Inflater.WantsMore())
  {
    const std::size_t made = m_Inflater.Take(out + done, count - done);
    done += made;
    if (made > 0)
    {
      continue;
    }
    const std::size_t got = m_Bytes.ReadSome(
      m_Next, m_In.data(), static_cast<std::size_t>(std::min<std::uint64_t>(m_End - m_Next, m_In.size())));
    if (got == 0)
    {
      break;
    }
    m_Next += got;
    m_Inflater.Offer(m_In.data(), got);
  }
  return done;
}

void
InflatedBytes::Read(void * out, std::uint64_t count)
{
  std::vector<unsigned char> dropped(out == nullptr ? CompressedBlockBytes : 0);
  for (std::uint64_t done = 0; done < count;)
  {
    auto * const      to = out == nullptr ? dropped.data() : static_cast<unsigned char *>(out) + done;
    const std::size_t space = out == nullptr ? dropped.size() : static_cast<std::size_t>(count - done);
    const std::size_t now = static_cast<std::size_t>(std::min<std::uint64_t>(count - done, space));
    if (ReadSome(to, now) < now)
    {
      Refuse();
    }
    done += now;
  }
}

void
InflatedBytes::RequireEnd()
{
  unsigned char more = 0;
  if (ReadSome(&more, 1) > 0 || !m_Inflater.IsWhole())
  {
    Refuse();
  }
  RequireNothingLeft(m_File, m_From.place, m_Found - m_Inflater.UsedBytes());
}

void
InflatedBytes::Refuse() const
{
  throw FileError(m_File,
                  "damaged: its compressed pixels" + InDataFile(m_File, m_From.place) + " give " +
                    m_Inflater.ReceivedBytes() + ", expected " + std::to_string(m_From.bytes) +
                    " bytes and the end of the stream");
}

/** Throws FileError unless the stream has exactly from.bytes bytes, and the file ends with the stream. */
void
RequireInflates(const std::string & file, const CompressedPlace & from)
{
  InflatedBytes inflated(file, from);
  inflated.Read(nullptr, from.bytes);
  inflated.RequireEnd();
}

/** Reads frames of one compressed stream. A frame behind the last read continues the stream; an earlier frame restarts
 * it. */
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
  mutable std::unique_ptr<InflatedBytes> m_Stream;        // null: at the beginning
  mutable std::uint64_t                  m_Position{ 0 }; // inflated bytes that were read
};

void
InflatedFrames::Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  const std::size_t                 pixels = file.width * file.height;
  const std::size_t                 size = SizeOf(m_Sample.pixel, m_Sample.stored);
  const std::uint64_t               begin = std::uint64_t{ first } * pixels * size;
  const std::uint64_t               end = begin + std::uint64_t{ count } * pixels * size;
  std::unique_ptr<InflatedBytes>    stream = std::move(m_Stream); // after an error the next call restarts the stream
  if (!stream || m_Position > begin)
  {
    stream = std::make_unique<InflatedBytes>(file.name, m_From);
    m_Position = 0;
  }
  stream->Read(nullptr, begin - m_Position);
  stream->Read(buffer, end - begin);
  ToOwnByteOrder(m_Sample.isBigEndian, size, count * pixels, buffer);
  ConvertStored(m_Sample.stored, count * pixels, buffer);
  if (end == m_From.bytes)
  {
    stream->RequireEnd(); // the stream and its file are then closed
    return;
  }
  m_Stream = std::move(stream);
  m_Position = end;
}

/** Reads frames of several files, one frame in each. */
class JoinedFrames : public FrameReader
{
public:
  explicit JoinedFrames(std::vector<std::unique_ptr<const FrameReader>> parts)
    : m_Parts(std::move(parts))
  {}

  void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const override
  {
    const std::size_t frameBytes = file.width * file.height * SizeOf(file.pixel);
    for (std::size_t i = 0; i < count; ++i)
    {
      m_Parts.at(first + i)->Read(file, 0, 1, static_cast<char *>(buffer) + i * frameBytes);
    }
  }

private:
  std::vector<std::unique_ptr<const FrameReader>> m_Parts;
};

/** Checks the \a bytes of pixels at a place. Returns the reader of their frames. Throws FileError. */
std::unique_ptr<const FrameReader>
ReaderOfPlace(const FrameFile & file, const DataPlace & place, const DataCoding & coding, std::uint64_t bytes)
{
  if (coding.compression)
  {
    const CompressedPlace from{ place, *coding.compression, coding.compressedBytes, bytes };
    RequireInflates(file.name, from);
    return std::make_unique<InflatedFrames>(from, coding.sample);
  }
  FramePlaces places;
  places.path = place.path;
  places.frameBytes = StoredBytesOf(file) / file.frames;
  places.offset = RequireExactly(file.name, place, bytes, places.frameBytes);
  places.sample = coding.sample;
  return std::make_unique<PackedFrames>(places);
}
} // namespace

void
SetDataFrames(FrameFile &                    file,
              const std::vector<DataPlace> & places,
              const DataCoding &             coding,
              const BeforeInflating &        beforeInflating)
{
  if (coding.compression && beforeInflating)
  {
    beforeInflating(file);
  }
  const std::uint64_t                             bytes = StoredBytesOf(file) / places.size();
  std::vector<std::unique_ptr<const FrameReader>> readers;
  for (const DataPlace & place : places)
  {
    if (!place.attached)
    {
      AddDataFile(file.name, place.path, file.identities);
    }
    readers.push_back(ReaderOfPlace(file, place, coding, bytes));
  }
  if (readers.size() == 1)
  {
    file.reader = std::move(readers.front());
  }
  else
  {
    file.reader = std::make_shared<JoinedFrames>(std::move(readers));
  }
}

} // namespace sensornoise
