// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_RandomStreams_h
#define sensornoise_simulation_RandomStreams_h

#include <cstdint>

namespace sensornoise
{

/** Purpose of the random numbers of a simulated stack: the stream of a CounterSeededRandom. The meaning of a number
 * never changes, because a seed would otherwise yield another stack. Streams from 100 on are free for programs that
 * extend the simulator. The counter "frame" is the number of the exposure, where frames are repeated. */
enum class RandomStream : std::uint64_t
{
  Series = 1,       ///< flicker, shifts and phase; counter: frame
  Pixels = 2,       ///< electrons and read noise; counters: frame, row
  FixedPattern = 3, ///< fixed-pattern noise; counter: FixedPatternKind
  RowNoise = 4,     ///< counters: frame, row
  ColumnNoise = 5,  ///< counter: frame
  Banding = 6,      ///< counter: frame
  Illumination = 7  ///< counter: frame
};

/** Maps of the stream FixedPattern. */
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

/** Returns the number of a stream. Frames with the shutter closed have independent temporal noise, but the
 * fixed-pattern noise of the bright frames, so that both come from one sensor. */
inline std::uint64_t
StreamNumber(RandomStream stream, bool isDark = false)
{
  constexpr std::uint64_t dark = std::uint64_t{ 1 } << 32;
  return static_cast<std::uint64_t>(stream) + (isDark ? dark : 0);
}

} // namespace sensornoise

#endif
