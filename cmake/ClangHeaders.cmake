# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Debian's ITK 5.2 was configured for GCC alone: its header itk_compiler_detection.h is an error for any other compiler,
# although Clang compiles all other headers. Clang reads a copy of this header without the error before every source; its
# include guard keeps the original out.
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  return()
endif()
foreach(_folder IN LISTS ITK_INCLUDE_DIRS)
  if(NOT EXISTS ${_folder}/itk_compiler_detection.h)
    continue()
  endif()
  file(READ ${_folder}/itk_compiler_detection.h _text)
  string(REPLACE "#    error Unsupported compiler\n" "" _mended "${_text}")
  if(NOT _mended STREQUAL _text AND NOT _text MATCHES "COMPILER_INFO_Clang")
    set(_copy ${CMAKE_CURRENT_BINARY_DIR}/clang/itk_compiler_detection.h)
    file(CONFIGURE OUTPUT ${_copy} CONTENT "${_mended}" @ONLY)
    add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${_copy}>")
    return()
  endif()
endforeach()
