// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef BurstMemory_h
#define BurstMemory_h

#include "browser/Burst.h"

#include <cstddef>

namespace sensornoise::browser
{

/** Memory that a page can use [bytes]. The addresses of WebAssembly have 32 bits, and signed sizes reach half of this
 * range. */
inline constexpr double PageMemoryBytes = 2e9;

/** Returns the number of frames that are read at a time. */
std::size_t
FramesPerChunk(const Burst & burst);

/** Returns the memory that the estimate needs at most, with the frames that are held at a time [bytes]. A larger need
 * is reduced to PageMemoryBytes where the stack can be read more often instead. */
double
MemoryNeedOf(const Burst & burst, const BurstOptions & options);

/** Returns the limit for the refined method, RefinedSettings::memoryLimitBytes [bytes]: infinite if it needs none. */
double
MemoryLimitOf(const Burst & burst, const BurstOptions & options);

/** Throws std::runtime_error, which names the tool, if the estimate needs more memory than PageMemoryBytes. */
void
RequirePageMemory(const Burst & burst, const BurstOptions & options);

} // namespace sensornoise::browser

#endif
