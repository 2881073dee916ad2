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
#ifndef InputError_h
#define InputError_h

#include <stdexcept>

namespace sensornoise::tools
{

/** Wrong, damaged or unsuitable input files. The message is one sentence that starts with the name of the file. */
struct InputError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

} // namespace sensornoise::tools

#endif
