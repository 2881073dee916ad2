// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_RandomStreams_h
#define sensornoise_simulation_RandomStreams_h

#include <cstdint>

namespace sensornoise
{

/** What the random numbers of a simulated stack are for: the stream of a CounterSeededRandom. A number once given never
 * changes its meaning, or a seed would give another stack. Streams from 100 on are free for programs that add to the
 * simulator. */
enum class RandomStream : std::uint64_t
{
  Series = 1,       ///< flicker, shifts and phase; counter: frame
  Pixels = 2,       ///< electrons and read noise; counters: frame, row
  FixedPattern = 3, ///< what stays from frame to frame; counter: FixedPatternKind
  RowNoise = 4,     ///< counter: frame
  ColumnNoise = 5,  ///< counter: frame
  Banding = 6,      ///< counter: frame
  Illumination = 7  ///< counter: frame
};

/** The maps of the stream FixedPattern. */
enum class FixedPatternKind : std::uint64_t
{
  Efficiency = 0,
  Offset = 1,
  HotPixels = 2,
  Gain = 3,
  ColumnGain = 4,
  ColumnEfficiency = 5,
  ColumnOffset = 6,
  ReadNoise = 7
};

/** The number of a stream. Frames with the shutter closed have noise of their own, but the fixed patterns of the bright
 * ones, so that both come from one sensor. */
inline std::uint64_t
StreamNumber(RandomStream stream, bool isDark = false)
{
  constexpr std::uint64_t dark = std::uint64_t{ 1 } << 32;
  return static_cast<std::uint64_t>(stream) + (isDark ? dark : 0);
}

} // namespace sensornoise

#endif
