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
#ifndef itkSensorNoiseProfileFile_h
#define itkSensorNoiseProfileFile_h

#include "SensorNoiseExport.h"
#include "exports/NoiseProfile.h"

#include <string>

namespace sensornoise
{

/** Reads the bytes of a noise profile, without the byte order mark of UTF-8. Throws std::runtime_error if \a file is no
 * file that can be read, or has more than 4 GiB. */
SensorNoise_EXPORT std::string
ReadProfileBytes(const std::string & file);

/** Returns whether the bytes of a profile begin like JSON. */
SensorNoise_EXPORT bool
IsJsonProfile(const std::string & bytes);

/** Sets the black and the white level of a DNG file with a profile, where neither the caller nor the frames give them.
 */
SensorNoise_EXPORT void
FillProfileLevels(const NoiseProfile & profile, CameraNoise & noise);

} // namespace sensornoise

#endif
