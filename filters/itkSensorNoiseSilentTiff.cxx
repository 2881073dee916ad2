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
#include "itkSensorNoiseSilentTiff.h"

#include <string>

#if defined(__unix__) || defined(__APPLE__)
#  include <dlfcn.h>
#endif

namespace sensornoise
{
namespace
{
using TiffHandler = void (*)();
using TiffSetter = TiffHandler (*)(TiffHandler);

/** libtiff's function of this name, as ITK renames it (5.4, 5.2) or as it is; nothing where the program has none. */
TiffSetter
SetterNamed(const char * name)
{
#if defined(__unix__) || defined(__APPLE__)
  // Looked up, not linked: it is that of ITK's TIFF reader, wherever the program has that from.
  for (const char * const prefix : { "itk_tiff_", "itk_", "" })
  {
    if (void * const function = dlsym(RTLD_DEFAULT, (std::string(prefix) + name).c_str()))
    {
      return reinterpret_cast<TiffSetter>(function);
    }
  }
  return nullptr;
#else
  (void)name;
  return nullptr;
#endif
}

TiffHandler
SetHandler(const char * name, TiffHandler handler)
{
  const TiffSetter set = SetterNamed(name);
  return set == nullptr ? nullptr : set(handler);
}
} // namespace

SilentTiff::SilentTiff()
  : m_Warning(SetHandler("TIFFSetWarningHandler", nullptr))
  , m_Error(SetHandler("TIFFSetErrorHandler", nullptr))
{}

SilentTiff::~SilentTiff()
{
  SetHandler("TIFFSetWarningHandler", m_Warning);
  SetHandler("TIFFSetErrorHandler", m_Error);
}

} // namespace sensornoise
