// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
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
