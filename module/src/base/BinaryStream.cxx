// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/BinaryStream.h"

#include "base/BytesFingerprint.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <istream>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

void
WriteCount(std::ostream & out, std::uint64_t count)
{
  WriteNumbers(out, &count, 1);
}

std::uint64_t
ReadCount(std::istream & in)
{
  std::uint64_t count = 0;
  ReadNumbers(in, &count, 1);
  return count;
}

void
RequireCount(const char * what, std::uint64_t found, std::uint64_t expected)
{
  if (found != expected)
  {
    throw std::runtime_error("the sums of a stream do not fit: found " + std::to_string(found) + " " + what +
                             ", expected " + std::to_string(expected));
  }
}

void
RequireSameStart(std::uint64_t found, std::uint64_t expected)
{
  if (found != expected)
  {
    throw std::runtime_error(
      "sums cannot be merged: they have other settings, another mask or other sums of the passes "
      "before; start all processes with the same settings");
  }
}

void
WriteSumsHeader(std::ostream & out, const std::string & name, std::uint64_t pixels, std::uint64_t frames)
{
  std::array<char, 32> word{};
  std::copy_n(name.begin(), std::min(name.size(), word.size()), word.begin());
  WriteNumbers(out, word.data(), word.size());
  WriteNumbers(out, &SumsVersion, 1);
  WriteCount(out, pixels);
  WriteCount(out, frames);
}

std::uint64_t
ReadSumsHeader(std::istream & in, const std::string & name, std::uint64_t pixels)
{
  std::array<char, 32> word{};
  ReadNumbers(in, word.data(), word.size());
  std::string found(word.data(), std::find(word.begin(), word.end(), '\0'));
  if (found != name)
  {
    std::replace_if(found.begin(), found.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    throw std::runtime_error("a stream holds other sums: found \"" + found + "\", expected \"" + name + "\"");
  }
  std::uint32_t version = 0;
  ReadNumbers(in, &version, 1);
  if (version != SumsVersion)
  {
    throw std::runtime_error("a stream holds another version of \"" + name + "\": found " + std::to_string(version) +
                             ", expected " + std::to_string(SumsVersion));
  }
  RequireCount("pixels", ReadCount(in), pixels);
  return ReadCount(in);
}

namespace
{
/** Mark of a seal, and the number of bytes of the mark and of the version. */
constexpr char        SealMark[] = "SensorNoise sums";
constexpr std::size_t SealMarkBytes = 16;
constexpr std::size_t SealVersionBytes = 32;

/** Returns "5 of module 1.2.3": the version of the sums and the version of the module. */
std::string
NameOfVersions(std::uint32_t ofSums, const std::string & ofModule)
{
  return std::to_string(ofSums) + " of module " + ofModule;
}
} // namespace

std::vector<unsigned char>
SealSums(const unsigned char * bytes, std::size_t size, const std::string & version)
{
  std::ostringstream out;
  out.write(SealMark, SealMarkBytes);
  std::array<char, SealVersionBytes> word{};
  std::copy_n(version.begin(), std::min(version.size(), word.size()), word.begin());
  WriteNumbers(out, word.data(), word.size());
  WriteCount(out, SumsVersion);
  WriteCount(out, size);
  const BytesFingerprint fingerprint = FingerprintOfBytes(bytes, size);
  WriteNumbers(out, fingerprint.data(), fingerprint.size());
  const std::string seal = out.str();
  return { seal.begin(), seal.end() };
}

UnsealedSums
UnsealSums(const unsigned char * bytes, std::size_t size, const std::string & version)
{
  if (size < SumsSealBytes || std::memcmp(bytes, SealMark, SealMarkBytes) != 0)
  {
    throw std::runtime_error(std::to_string(size) +
                             " bytes were given that do not begin as sums do; expected all that to_bytes() or "
                             "GetSums() returned, of version " +
                             NameOfVersions(SumsVersion, version));
  }
  std::istringstream                 in(std::string(bytes + SealMarkBytes, bytes + SumsSealBytes));
  std::array<char, SealVersionBytes> word{};
  ReadNumbers(in, word.data(), word.size());
  std::string         found(word.data(), std::find(word.begin(), word.end(), '\0'));
  const std::uint64_t ofSums = ReadCount(in);
  if (ofSums != SumsVersion || found != version)
  {
    std::replace_if(found.begin(), found.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    throw std::runtime_error("the sums are of version " + NameOfVersions(static_cast<std::uint32_t>(ofSums), found) +
                             ", expected version " + NameOfVersions(SumsVersion, version) +
                             ": all processes need the same one");
  }
  const std::uint64_t expected = ReadCount(in);
  const UnsealedSums  sums{ bytes + SumsSealBytes, size - SumsSealBytes };
  if (sums.size != expected)
  {
    throw std::runtime_error("the sums are " + std::string(sums.size < expected ? "incomplete" : "too long") +
                             ": found " + std::to_string(sums.size) + " bytes, expected " + std::to_string(expected));
  }
  BytesFingerprint fingerprint{};
  ReadNumbers(in, fingerprint.data(), fingerprint.size());
  if (fingerprint != FingerprintOfBytes(sums.bytes, sums.size))
  {
    throw std::runtime_error("the sums are damaged: the checksum of their " + std::to_string(sums.size) +
                             " bytes differs from the checksum that was written with them; hand them over again");
  }
  return sums;
}

namespace
{
constexpr std::size_t BytesOfCounts = 2 * sizeof(std::uint64_t);

bool
IsZero(const unsigned char * block)
{
  std::uint64_t any = 0;
  for (std::size_t i = 0; i < ZeroRunWriter::BlockBytes; i += sizeof(any))
  {
    std::uint64_t word = 0;
    std::memcpy(&word, block + i, sizeof(word));
    any |= word;
  }
  return any == 0;
}
} // namespace

void
ZeroRunWriter::EndRun()
{
  if (m_Packed.empty())
  {
    return;
  }
  const std::uint64_t counts[2] = { m_Zeros, m_Kept };
  std::memcpy(m_Packed.data() + m_Place, counts, BytesOfCounts);
}

void
ZeroRunWriter::TakeBlock(const unsigned char * block)
{
  const bool isZero = IsZero(block);
  if (m_Packed.empty() || (isZero && m_Kept > 0))
  {
    this->EndRun();
    m_Place = m_Packed.size();
    m_Packed.resize(m_Place + BytesOfCounts);
    m_Zeros = 0;
    m_Kept = 0;
  }
  if (isZero)
  {
    ++m_Zeros;
    return;
  }
  ++m_Kept;
  m_Packed.insert(m_Packed.end(), block, block + BlockBytes);
}

std::streamsize
ZeroRunWriter::xsputn(const char * bytes, std::streamsize count)
{
  const auto * from = reinterpret_cast<const unsigned char *>(bytes);
  auto         left = static_cast<std::size_t>(count);
  while (left > 0)
  {
    if (m_InBlock == 0 && left >= BlockBytes)
    {
      this->TakeBlock(from);
      from += BlockBytes;
      left -= BlockBytes;
      continue;
    }
    const std::size_t part = std::min(left, BlockBytes - m_InBlock);
    std::copy_n(from, part, m_Block.data() + m_InBlock);
    from += part;
    left -= part;
    m_InBlock += part;
    if (m_InBlock == BlockBytes)
    {
      this->TakeBlock(m_Block.data());
      m_InBlock = 0;
    }
  }
  return count;
}

ZeroRunWriter::int_type
ZeroRunWriter::overflow(int_type character)
{
  const char byte = traits_type::to_char_type(character);
  this->xsputn(&byte, 1);
  return traits_type::not_eof(character);
}

std::vector<unsigned char>
ZeroRunWriter::Take()
{
  if (m_InBlock > 0)
  {
    std::fill(m_Block.begin() + static_cast<std::ptrdiff_t>(m_InBlock), m_Block.end(), static_cast<unsigned char>(0));
    m_InBlock = 0;
    this->TakeBlock(m_Block.data());
  }
  this->EndRun();
  return std::exchange(m_Packed, {});
}

ZeroRunReader::ZeroRunReader(const unsigned char * packed, std::size_t bytes)
  : m_Packed(packed)
  , m_End(packed + bytes)
{}

bool
ZeroRunReader::FindRun()
{
  while (m_Zeros == 0 && m_Kept == 0)
  {
    if (static_cast<std::size_t>(m_End - m_Packed) < BytesOfCounts)
    {
      return false;
    }
    std::uint64_t counts[2] = { 0, 0 };
    std::memcpy(counts, m_Packed, BytesOfCounts);
    m_Packed += BytesOfCounts;
    m_Zeros = std::min(counts[0], std::numeric_limits<std::uint64_t>::max() / ZeroRunWriter::BlockBytes) *
              ZeroRunWriter::BlockBytes;
    const auto left = static_cast<std::uint64_t>(m_End - m_Packed);
    m_Kept = std::min(counts[1], left / ZeroRunWriter::BlockBytes) * ZeroRunWriter::BlockBytes;
  }
  return true;
}

std::streamsize
ZeroRunReader::xsgetn(char * bytes, std::streamsize count)
{
  auto left = static_cast<std::uint64_t>(count);
  while (left > 0 && this->FindRun())
  {
    const std::uint64_t zeros = std::min(left, m_Zeros);
    std::fill_n(bytes, zeros, '\0');
    bytes += zeros;
    left -= zeros;
    m_Zeros -= zeros;
    if (m_Zeros == 0)
    {
      const std::uint64_t kept = std::min(left, m_Kept);
      std::memcpy(bytes, m_Packed, kept);
      m_Packed += kept;
      bytes += kept;
      left -= kept;
      m_Kept -= kept;
    }
  }
  return count - static_cast<std::streamsize>(left);
}

ZeroRunReader::int_type
ZeroRunReader::underflow()
{
  if (!this->FindRun())
  {
    return traits_type::eof();
  }
  return m_Zeros > 0 ? 0 : static_cast<int_type>(*m_Packed);
}

ZeroRunReader::int_type
ZeroRunReader::uflow()
{
  char byte = 0;
  return this->xsgetn(&byte, 1) == 1 ? traits_type::to_int_type(byte) : traits_type::eof();
}

} // namespace sensornoise
