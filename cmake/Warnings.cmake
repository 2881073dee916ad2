# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Warnings over this project's own sources: include(Warnings) in a folder's CMakeLists.txt, before its targets. Headers of
# others are SYSTEM, so that their warnings are theirs; what SWIG writes is in wrapping/, which does not include this.
option(SensorNoise_WARNINGS_AS_ERRORS "Warnings in this project's own sources are errors" OFF)
if(SensorNoise_WARNINGS_AS_ERRORS)
  add_compile_options(
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Werror;-Wall;-Wextra>"
    # A name that hides another one is two things to the compiler and one to the reader.
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Wshadow>"
    # Pixel types, sizes and doubles meet everywhere: where one loses digits, the code says so by a cast.
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Wconversion;-Wold-style-cast;-Wcast-qual>"
    # Classes that ITK's are derived from, and that are derived from ITK's.
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Wnon-virtual-dtor;-Woverloaded-virtual>"
    # Formats of printf that no compiler checks; class templates whose arguments are deduced by accident.
    "$<$<COMPILE_LANG_AND_ID:CXX,Clang,AppleClang>:-Wformat-nonliteral;-Wctad-maybe-unsupported>"
    # Of C++, GCC's -Wconversion does not have it.
    "$<$<COMPILE_LANG_AND_ID:CXX,Clang,AppleClang>:-Wno-sign-conversion>"
    # Conditions copied from one line to the next. GCC 12 takes for uninitialised what inlined CLI11 and std::optional guard.
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wduplicated-cond;-Wlogical-op;-Wno-maybe-uninitialized>")
  # Not here: -Wpedantic, as ITK 5.4 demands the semicolon after itkNewMacro(Self) that it objects to with ITK 5.2
  # (test/check-style.sh has Clang look for the rest of it); -Wsign-conversion, as GCC 12 takes `count += isTrue ? 1 : 0` for
  # one; -Wdouble-promotion, as a float loses nothing in a double.
endif()
