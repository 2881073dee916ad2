# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# sensornoise_unity_by_component(TARGET): the files of a component are compiled together, six at a time to spare memory. Half
# of the time to compile them one by one goes into reading Eigen and ITK and into what they instantiate alike. CMake before
# 3.18, which cannot ask for the properties of another folder's sources, compiles them one by one.
#
# CMake's own UNITY_BUILD writes where the checkout is into its files. Here they include by relative paths, so that a
# compiler cache knows them again in another checkout.
function(sensornoise_unity_by_component target)
  if(NOT SensorNoise_UNITY_BUILD OR CMAKE_VERSION VERSION_LESS 3.18)
    return()
  endif()
  get_target_property(_sources ${target} SOURCES)
  get_target_property(_source_folder ${target} SOURCE_DIR)
  get_target_property(_binary_folder ${target} BINARY_DIR)
  set(_unity_folder ${_binary_folder}/unity/${target})
  list(SORT _sources)
  set(_alone)
  set(_groups)
  foreach(_source IN LISTS _sources)
    get_filename_component(_path ${_source} ABSOLUTE BASE_DIR ${_source_folder})
    get_source_file_property(_is_skipped ${_path} TARGET_DIRECTORY ${target} SKIP_UNITY_BUILD_INCLUSION)
    get_source_file_property(_options ${_path} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
    if(_is_skipped OR _options)
      list(APPEND _alone ${_path})
      continue()
    endif()
    get_filename_component(_component ${_path} DIRECTORY)
    get_filename_component(_component ${_component} NAME)
    math(EXPR _number "${_files_of_${_component}} + 0")
    math(EXPR _files_of_${_component} "${_number} + 1")
    math(EXPR _group "${_number} / 6")
    file(RELATIVE_PATH _relative ${_unity_folder} ${_path})
    list(APPEND _groups ${_component}${_group})
    string(APPEND _text_of_${_component}${_group} "#include \"${_relative}\"\n")
  endforeach()
  list(REMOVE_DUPLICATES _groups)
  set(_together)
  foreach(_group IN LISTS _groups)
    file(CONFIGURE OUTPUT ${_unity_folder}/${_group}.cxx CONTENT "${_text_of_${_group}}" @ONLY)
    list(APPEND _together ${_unity_folder}/${_group}.cxx)
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${_alone};${_together}")
endfunction()
