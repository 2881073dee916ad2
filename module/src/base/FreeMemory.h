// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_FreeMemory_h
#define sensornoise_base_FreeMemory_h

#include "SensorNoiseExport.h"

#include <optional>
#include <string>

namespace sensornoise
{

/** Memory that this process can still get [bytes]: what the machine has available, swap included, or less where a limit
 * of the process (ulimit -v) or of its control group (a container) is closer. Null where the system does not tell. */
SensorNoise_EXPORT std::optional<double>
FreeMemoryBytes();

/** Throws std::runtime_error, "<what> needs N GB of memory, but M GB are free", if \a bytes are more than that. A
 * double: a product of sizes from a header may be beyond every integer. */
SensorNoise_EXPORT void
RequireMemory(double bytes, const std::string & what);

/** Gives memory that was freed, but is kept by the C library between pieces that are in use, back to the system; where
 * the library is not known, nothing is done. */
SensorNoise_EXPORT void
GiveBackFreedMemory();

/** A number of bytes as people read it, for example "2.4 GB". */
SensorNoise_EXPORT std::string
TextOfBytes(double bytes);

} // namespace sensornoise

#endif
