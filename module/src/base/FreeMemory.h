// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_FreeMemory_h
#define sensornoise_base_FreeMemory_h

#include "SensorNoiseExport.h"

#include <optional>
#include <string>

namespace sensornoise
{

/** Returns the memory that this process can still allocate [bytes]. This is the available memory of the machine, swap
 * included, or the smaller limit of the process (ulimit -v) or of its control group (a container). Null where the
 * system does not provide it. */
SensorNoise_EXPORT std::optional<double>
FreeMemoryBytes();

/** Throws std::runtime_error, "<what> needs N GB of memory, but M GB are free", if \a bytes exceed the free memory. The
 * argument is a double, because a product of sizes from a header may exceed every integer. */
SensorNoise_EXPORT void
RequireMemory(double bytes, const std::string & what);

/** Gives freed memory back to the system. The C library otherwise keeps freed memory that lies between pieces in use.
 * Does nothing with C libraries other than glibc. */
SensorNoise_EXPORT void
ReleaseFreedMemory();

/** Returns a number of bytes as readable text, for example "2.4 GB". */
SensorNoise_EXPORT std::string
TextOfBytes(double bytes);

} // namespace sensornoise

#endif
