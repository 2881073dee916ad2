// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/ByteRanges.h"

#include <algorithm>

namespace sensornoise
{
namespace
{
/** Whether what begins at `offset` follows what ends at `end`. Writers fill strips up to words of four bytes, which
 * leaves no room for a table between; between tables there may be a strip of a byte. */
bool
Follows(std::uint64_t end, std::uint64_t offset, bool areTables)
{
  return offset >= end && offset - end <= (areTables ? 0 : 3);
}
} // namespace

void
ByteRanges::Join(std::vector<Range> & ranges, bool mayShare)
{
  std::sort(ranges.begin(), ranges.end());
  std::size_t last = 0;
  for (std::size_t i = 1; i < ranges.size(); ++i)
  {
    if (Follows(ranges[last].second, ranges[i].first, mayShare) || (mayShare && ranges[i].first < ranges[last].second))
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
ByteRanges::Add(std::vector<Range> & ranges, std::uint64_t offset, std::uint64_t count, bool mayShare)
{
  if (count == 0)
  {
    return true;
  }
  if (!ranges.empty() && Follows(ranges.back().second, offset, mayShare))
  {
    ranges.back().second = offset + count;
    return true;
  }
  if (ranges.size() == MaximumRanges)
  {
    Join(ranges, mayShare);
    if (ranges.size() > MaximumRanges / 2)
    {
      return false; // else it would soon be due again, and again
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
  std::uint64_t tablesEnd = 0; // of those that begin before the pixels' range
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

} // namespace sensornoise
