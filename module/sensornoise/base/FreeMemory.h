/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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

/** A number of bytes as people read it, for example "2.4 GB". */
SensorNoise_EXPORT std::string
TextOfBytes(double bytes);

} // namespace sensornoise

#endif
