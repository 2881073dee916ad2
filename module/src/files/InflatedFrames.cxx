// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/InflatedFrames.h"

#include "sensornoise/FrameFile.h"
#include "files/StoredNumber.h"

#include <algorithm>

namespace sensornoise
{
namespace
{
constexpr std::size_t CompressedBlockBytes = 65536;
} // namespace

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
    const std::size_t room = out == nullptr ? dropped.size() : static_cast<std::size_t>(count - done);
    const std::size_t now = static_cast<std::size_t>(std::min<std::uint64_t>(count - done, room));
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

void
RequireInflates(const std::string & file, const CompressedPlace & from)
{
  InflatedBytes inflated(file, from);
  inflated.Read(nullptr, from.bytes);
  inflated.RequireEnd();
}

void
InflatedFrames::Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  const std::size_t                 pixels = file.width * file.height;
  const std::size_t                 size = SizeOf(m_Sample.pixel, m_Sample.stored);
  const std::uint64_t               begin = std::uint64_t{ first } * pixels * size;
  const std::uint64_t               end = begin + std::uint64_t{ count } * pixels * size;
  std::unique_ptr<InflatedBytes>    stream = std::move(m_Stream); // after an error the next reading begins anew
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
    stream->RequireEnd(); // and the file is closed
    return;
  }
  m_Stream = std::move(stream);
  m_Position = end;
}

} // namespace sensornoise
