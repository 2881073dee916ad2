// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/Compression.h"

#include "files/FileBytes.h"
#include "files/Zlib.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace sensornoise
{

struct Inflater::Stream
{
  z_stream zlib{};
};

Inflater::Inflater(InflateContainer container, std::uint64_t expectedBytes, Sink sink)
  : m_Sink(std::move(sink))
  , m_Expected(expectedBytes)
  , m_Stream(std::make_unique<Stream>())
{
  const int windowBits = container == InflateContainer::Zlib   ? 15
                         : container == InflateContainer::Gzip ? 15 + 16
                                                               : 15 + 32;
  if (inflateInit2(&m_Stream->zlib, windowBits) != Z_OK)
  {
    throw std::bad_alloc();
  }
}

Inflater::~Inflater()
{
  inflateEnd(&m_Stream->zlib);
}

void
Inflater::Offer(const unsigned char * bytes, std::size_t count)
{
  m_Stream->zlib.next_in = const_cast<unsigned char *>(bytes);
  m_Stream->zlib.avail_in = static_cast<uInt>(count);
}

std::size_t
Inflater::Take(unsigned char * out, std::size_t count)
{
  if (!WantsMore())
  {
    return 0;
  }
  z_stream & zlib = m_Stream->zlib;
  const uInt before = zlib.avail_in;
  const auto space = static_cast<uInt>(std::min<std::size_t>(count, std::numeric_limits<uInt>::max()));
  zlib.next_out = out;
  zlib.avail_out = space;
  const int         status = inflate(&zlib, Z_NO_FLUSH);
  const std::size_t made = space - zlib.avail_out;
  m_Used += before - zlib.avail_in;
  m_Found += made;
  m_Ended = status == Z_STREAM_END;
  if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR)
  {
    m_Error = zlib.msg != nullptr ? zlib.msg : status == Z_NEED_DICT ? "a preset dictionary" : "not a stream";
  }
  return made;
}

bool
Inflater::Add(const unsigned char * bytes, std::size_t count)
{
  Offer(bytes, count);
  std::size_t made = m_Out.size();
  while (WantsMore() && made == m_Out.size()) // an output that is not full means that all input is used
  {
    made = Take(m_Out.data(), m_Out.size());
    if (m_Sink && m_Found <= m_Expected)
    {
      m_Sink(m_Out.data(), made);
    }
  }
  return WantsMore();
}

bool
Inflater::IsWhole() const
{
  return m_Ended && m_Found == m_Expected;
}

std::string
Inflater::ReceivedBytes() const
{
  if (m_Found > m_Expected)
  {
    return "more than " + std::to_string(m_Expected) + " bytes";
  }
  const std::string found = std::to_string(m_Found) + " bytes";
  return m_Ended ? found : found + " and then an error (" + (m_Error.empty() ? "no end of the stream" : m_Error) + ")";
}

void
InflateFrom(FileBytes & bytes, std::uint64_t offset, std::uint64_t count, Inflater & inflater)
{
  std::vector<unsigned char> in(static_cast<std::size_t>(std::min<std::uint64_t>(count, 65536)));
  for (std::uint64_t done = 0; done < count;)
  {
    const std::size_t got = bytes.ReadSome(
      offset + done, in.data(), static_cast<std::size_t>(std::min<std::uint64_t>(count - done, in.size())));
    if (got == 0 || !inflater.Add(in.data(), got))
    {
      return;
    }
    done += got;
  }
}

} // namespace sensornoise
