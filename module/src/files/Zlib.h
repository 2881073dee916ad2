// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_Zlib_h
#define sensornoise_files_Zlib_h

// Includes the zlib of ITK in a build of ITK, else the zlib of the system.
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
