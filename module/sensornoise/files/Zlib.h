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
#ifndef sensornoise_files_Zlib_h
#define sensornoise_files_Zlib_h

// In a build of ITK, the zlib that ITK was built with; else the system's.
#if defined(__has_include)
#  if __has_include("itk_zlib.h")
#    include "itk_zlib.h"
#  else
#    include <zlib.h>
#  endif
#else
#  include <zlib.h>
#endif

#endif
