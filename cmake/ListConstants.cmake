# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0

# Writes a line for each member of the structs of constants in the Constants.h of components into a file, for a program
# that changes them:
#
#   Constant(InSeries, edgeOfNoise)
#
# Members that are constant expressions or arrays cannot be changed, and are left out.
function(sensornoise_list_constants file)
  set(_member "\n  [a-z][a-z0-9_:]* +[A-Za-z0-9]+{")
  set(_instance "\nSENSORNOISE_CONSTANT [A-Za-z]+ [A-Za-z]+")
  set(_lines "// Written by cmake/ListConstants.cmake.\n")
  foreach(_component ${ARGN})
    set(_header ${SensorNoise_SOURCE_DIR}/module/src/${_component}/Constants.h)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${_header})
    file(READ ${_header} _text)
    string(REPLACE ";" "" _text "${_text}")
    string(REPLACE "[" "(" _text "${_text}") # brackets would join the elements of a list
    string(REPLACE "]" ")" _text "${_text}")
    string(REGEX MATCHALL "${_member}|${_instance}" _found "${_text}")
    set(_names "")
    foreach(_one ${_found})
      string(REGEX REPLACE "^.* |{" "" _last "${_one}")
      if(_one MATCHES "SENSORNOISE_CONSTANT")
        foreach(_name ${_names})
          string(APPEND _lines "Constant(${_last}, ${_name})\n")
        endforeach()
        set(_names "")
      else()
        list(APPEND _names ${_last})
      endif()
    endforeach()
  endforeach()
  file(WRITE ${file} "${_lines}")
endfunction()
