# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# The files of a room are compiled together, six at a time to spare memory: half of the time to compile them one by one goes
# into reading Eigen and ITK and into what they instantiate alike. CMake before 3.18, which knows no groups, compiles them
# one by one.
function(sensornoise_unity_by_room target)
  if(CMAKE_VERSION VERSION_LESS 3.18)
    return()
  endif()
  get_target_property(_sources ${target} SOURCES)
  list(SORT _sources)
  foreach(_source IN LISTS _sources)
    get_filename_component(_room ${_source} DIRECTORY)
    get_filename_component(_room ${_room} NAME)
    math(EXPR _group "${_files_of_${_room}} + 0")
    math(EXPR _files_of_${_room} "${_group} + 1")
    math(EXPR _group "${_group} / 6")
    set_property(SOURCE ${_source} TARGET_DIRECTORY ${target} PROPERTY UNITY_GROUP ${_room}${_group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
