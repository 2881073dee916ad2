// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FileBytes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <ios>
#include <system_error>

#if defined(__unix__) || defined(__APPLE__)
#  include <sys/stat.h>
#endif

namespace sensornoise
{

namespace
{
namespace fs = std::filesystem;

void
RequireRegularFile(const std::string & name)
{
  std::error_code       error;
  const fs::file_status status = fs::status(name, error);
  switch (status.type())
  {
    case fs::file_type::regular:
      return;
    case fs::file_type::not_found:
      throw FileError(name, "does not exist; expected an image file");
    case fs::file_type::directory:
      throw FileError(name, "is a folder; expected an image file");
    case fs::file_type::fifo:
    case fs::file_type::socket:
    case fs::file_type::block:
    case fs::file_type::character:
      throw FileError(name, "is a pipe, a socket or a device; expected an image file");
    default:
      throw FileError(name, "cannot be looked up (" + error.message() + "); expected an image file");
  }
}
} // namespace

bool
operator==(const FileIdentity & a, const FileIdentity & b)
{
  return AreSameFile(a, b) && a.size == b.size && a.modified == b.modified && a.statusChange == b.statusChange;
}

#if defined(__unix__) || defined(__APPLE__)

bool
AreSameFile(const FileIdentity & a, const FileIdentity & b)
{
  return a.device == b.device && a.inode == b.inode;
}

FileIdentity
IdentityOf(const std::string & name)
{
  RequireRegularFile(name);
  struct stat found = {};
  if (stat(name.c_str(), &found) != 0)
  {
    throw FileError(name, "does not exist; expected an image file");
  }
#  if defined(__APPLE__)
  const timespec modified = found.st_mtimespec;
  const timespec changed = found.st_ctimespec;
#  else
  const timespec modified = found.st_mtim;
  const timespec changed = found.st_ctim;
#  endif
  const auto nanoseconds = [](const timespec & time) {
    return std::int64_t{ time.tv_sec } * 1000000000 + time.tv_nsec;
  };
  return { name,
           static_cast<std::uint64_t>(found.st_dev),
           static_cast<std::uint64_t>(found.st_ino),
           static_cast<std::uint64_t>(found.st_size),
           nanoseconds(modified),
           nanoseconds(changed) };
}

#else

bool
AreSameFile(const FileIdentity & a, const FileIdentity & b)
{
  std::error_code error;
  return fs::equivalent(a.name, b.name, error);
}

FileIdentity
IdentityOf(const std::string & name)
{
  RequireRegularFile(name);
  using std::chrono::duration_cast;
  using std::chrono::nanoseconds;
  const auto modified = fs::last_write_time(name).time_since_epoch();
  return { name, 0, 0, fs::file_size(name), duration_cast<nanoseconds>(modified).count(), 0 };
}

#endif

FileIdentity
IdentityOfDataFile(const std::string & file, const std::string & dataFile)
{
  try
  {
    return IdentityOf(dataFile);
  }
  catch (const FileError & error)
  {
    throw FileError(file, "its data file " + std::string(error.what()));
  }
}

namespace
{
/** Returns the beginning of a message about a data file; "" for the file itself. */
std::string
PlaceOf(const std::string & file, const std::string & path)
{
  return file == path ? "" : "its data file " + path + " ";
}
} // namespace

FileBytes::FileBytes(const std::string & file, const std::string & path)
  : m_File(file)
  , m_Path(path)
  , m_Size((file == path ? IdentityOf(path) : IdentityOfDataFile(file, path)).size)
  , m_Stream(path, std::ios::binary)
{
  if (!m_Stream)
  {
    throw FileError(file, PlaceOf(file, path) + "cannot be opened; expected a file that may be read");
  }
}

std::size_t
FileBytes::ReadSome(std::uint64_t offset, void * buffer, std::size_t count)
{
  if (offset >= m_Size)
  {
    return 0;
  }
  if (offset != m_Position)
  {
    m_Stream.seekg(static_cast<std::streamoff>(offset));
  }
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count, m_Size - offset));
  m_Stream.read(static_cast<char *>(buffer), static_cast<std::streamsize>(wanted));
  if (static_cast<std::size_t>(m_Stream.gcount()) != wanted)
  {
    throw FileError(m_File,
                    PlaceOf(m_File, m_Path) + "cannot be read from byte " + std::to_string(offset) + " on; expected " +
                      std::to_string(wanted) + " bytes there");
  }
  m_Position = offset + wanted;
  return wanted;
}

void
FileBytes::Read(std::uint64_t offset, void * buffer, std::size_t count)
{
  if (!Holds(offset, count))
  {
    throw FileError(m_File,
                    "truncated: " + PlaceOf(m_File, m_Path) + "ends after " + std::to_string(m_Size) +
                      " bytes, expected " + std::to_string(count) + " bytes from byte " + std::to_string(offset) +
                      " on");
  }
  ReadSome(offset, buffer, count);
}

bool
ByteReader::Fill()
{
  const std::uint64_t left = m_End - std::min(m_End, m_Offset);
  m_Held = m_Bytes.ReadSome(m_Offset, m_Buffer, static_cast<std::size_t>(std::min<std::uint64_t>(left, BufferBytes)));
  m_Used = 0;
  m_Offset += m_Held;
  return m_Held > 0;
}

namespace
{
/** Returns whether a range from `offset` follows a range up to `end`. Writers pad strips of pixels to words of four
 * bytes: a gap of up to 3 bytes is too small for a table. Between tables no gap is allowed, as a strip of one byte may
 * be there. */
bool
Follows(std::uint64_t end, std::uint64_t offset, bool areTables)
{
  return offset >= end && offset - end <= (areTables ? 0 : 3);
}
} // namespace

void
ByteRanges::Join(std::vector<Range> & ranges, bool mayOverlap)
{
  std::sort(ranges.begin(), ranges.end());
  std::size_t last = 0;
  for (std::size_t i = 1; i < ranges.size(); ++i)
  {
    if (Follows(ranges[last].second, ranges[i].first, mayOverlap) ||
        (mayOverlap && ranges[i].first < ranges[last].second))
    {
      ranges[last].second = std::max(ranges[last].second, ranges[i].second);
    }
    else
    {
      ranges[++last] = ranges[i];
    }
  }
  ranges.resize(std::min(ranges.size(), last + 1));
}

bool
ByteRanges::Add(std::vector<Range> & ranges, std::uint64_t offset, std::uint64_t count, bool mayOverlap)
{
  if (count == 0)
  {
    return true;
  }
  if (!ranges.empty() && Follows(ranges.back().second, offset, mayOverlap))
  {
    ranges.back().second = offset + count;
    return true;
  }
  if (ranges.size() == MaximumRanges)
  {
    Join(ranges, mayOverlap);
    if (ranges.size() > MaximumRanges / 2)
    {
      return false; // the ranges would soon have to be joined again
    }
  }
  ranges.emplace_back(offset, offset + count);
  return true;
}

std::optional<std::uint64_t>
ByteRanges::FirstConflict()
{
  Join(m_Pixels, false);
  Join(m_Tables, true);
  std::size_t   table = 0;
  std::uint64_t tablesEnd = 0; // end of the tables that begin at or before the pixels
  for (std::size_t i = 0; i < m_Pixels.size(); ++i)
  {
    const Range & pixels = m_Pixels[i];
    if (i > 0 && pixels.first < m_Pixels[i - 1].second)
    {
      return pixels.first;
    }
    for (; table < m_Tables.size() && m_Tables[table].first <= pixels.first; ++table)
    {
      tablesEnd = std::max(tablesEnd, m_Tables[table].second);
    }
    if (tablesEnd > pixels.first)
    {
      return pixels.first;
    }
    if (table < m_Tables.size() && m_Tables[table].first < pixels.second)
    {
      return m_Tables[table].first;
    }
  }
  return std::nullopt;
}

std::vector<ByteRanges::Range>
ByteRanges::Gaps(std::uint64_t size)
{
  Join(m_Pixels, false);
  Join(m_Tables, true);
  std::vector<Range> gaps;
  std::uint64_t      end = 0;
  const auto         add = [&gaps, &end](std::uint64_t next) {
    if (next > end)
    {
      gaps.emplace_back(end, next);
    }
  };
  for (std::size_t i = 0, k = 0; i < m_Pixels.size() || k < m_Tables.size();)
  {
    const bool    isTable = i == m_Pixels.size() || (k < m_Tables.size() && m_Tables[k] < m_Pixels[i]);
    const Range & range = isTable ? m_Tables[k++] : m_Pixels[i++];
    add(range.first);
    end = std::max(end, range.second);
  }
  add(size);
  return gaps;
}

ByteOrders
CompareByteOrders(const unsigned char * bytes, std::size_t pixels, bool isSigned)
{
  const auto levelOf = [isSigned](unsigned int pixel) {
    constexpr double range = 65536.0;
    return isSigned && pixel >= 32768U ? static_cast<double>(pixel) - range : static_cast<double>(pixel);
  };
  const auto add = [&levelOf](BytesInOrder & order, unsigned int pixel, unsigned int other) {
    order.roughness += std::abs(levelOf(pixel) - levelOf(other));
    order.largest = std::max(order.largest, pixel);
    order.usesLowByte = order.usesLowByte || (pixel & 255U) != 0;
  };
  ByteOrders orders;
  for (std::size_t i = 2; i < pixels; ++i)
  {
    const unsigned char * const pixel = bytes + 2 * i;
    const unsigned char * const other = pixel - 4;
    add(orders.little, pixel[0] + 256U * pixel[1], other[0] + 256U * other[1]);
    add(orders.big, pixel[1] + 256U * pixel[0], other[1] + 256U * other[0]);
  }
  return orders;
}

} // namespace sensornoise
