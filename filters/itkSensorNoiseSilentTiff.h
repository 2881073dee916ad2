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
#ifndef SilentTiff_h
#define SilentTiff_h

#include <tiffio.h>

namespace sensornoise::tools
{

/** libtiff writes to standard error, and what matters there is found by CheckFileIsComplete(). */
class SilentTiff
{
public:
  SilentTiff()
    : m_Warning(TIFFSetWarningHandler(nullptr))
    , m_Error(TIFFSetErrorHandler(nullptr))
  {}
  ~SilentTiff()
  {
    TIFFSetWarningHandler(m_Warning);
    TIFFSetErrorHandler(m_Error);
  }
  SilentTiff(const SilentTiff &) = delete;
  SilentTiff &
  operator=(const SilentTiff &) = delete;

private:
  TIFFErrorHandler m_Warning;
  TIFFErrorHandler m_Error;
};

} // namespace sensornoise::tools

#endif
