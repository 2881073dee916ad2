// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_ByteRanges_h
#define sensornoise_files_ByteRanges_h

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Which bytes of a file hold pixels and which hold tables, to find bytes that would be read twice over. Neighbours
 * that come one after the other are kept as one, and there is a limit to the number of others: at most 8 MiB are
 * needed. */
class ByteRanges
{
public:
  using Range = std::pair<std::uint64_t, std::uint64_t>; // its first byte and that behind its last

  /** Bytes that hold pixels. Returns false if there are too many ranges apart from each other. */
  bool
  AddPixels(std::uint64_t offset, std::uint64_t count)
  {
    return Add(m_Pixels, offset, count, false);
  }

  /** Bytes that hold something else; these may be used several times. Returns false as AddPixels(). */
  bool
  AddTable(std::uint64_t offset, std::uint64_t count)
  {
    return Add(m_Tables, offset, count, true);
  }

  /** A byte that holds pixels twice, or pixels and something else. */
  std::optional<std::uint64_t>
  FirstConflict();

  /** The places, of a file of that size, that belong to neither. */
  std::vector<Range>
  Gaps(std::uint64_t size);

private:
  static constexpr std::size_t MaximumRanges = std::size_t{ 1 } << 18;

  /** Sorts them, and makes one of those that touch each other, or, if they may share bytes, overlap. */
  static void
  Join(std::vector<Range> & ranges, bool mayShare);

  static bool
  Add(std::vector<Range> & ranges, std::uint64_t offset, std::uint64_t count, bool mayShare);

  std::vector<Range> m_Pixels;
  std::vector<Range> m_Tables;
};

} // namespace sensornoise

#endif
