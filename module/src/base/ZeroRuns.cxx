// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ZeroRuns.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <streambuf>
#include <utility>
#include <vector>

namespace sensornoise
{

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
