# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Registers the suites of a GoogleTest program as tests of CTest, one process per suite. Starting a process for each of
# 1,500 tests takes longer than most of them, with sanitizers above all.
#
#   sensornoise_add_suites(PROGRAM)      after add_executable(); the suites are listed when the program has been built
#
# Suites of one typed test ("Name/0", "Name/1", ...) are one test, "Name". Every suite writes what its tests took, and which
# were skipped, to test-results/PROGRAM/SUITE.xml in the build folder: test/summarise_tests.py reads these files.
if(CMAKE_SCRIPT_MODE_FILE)
  # cmake -DPROGRAM=... -DRESULTS=... -DOUTPUT=... -P TestsBySuite.cmake: writes OUTPUT, for CTest.
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE _listed RESULT_VARIABLE _code)
  if(NOT _code EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} --gtest_list_tests ended with ${_code}")
  endif()
  string(REPLACE ";" "," _listed "${_listed}") # in comments on parameters
  string(REPLACE "\n" ";" _lines "${_listed}")
  set(_names)
  foreach(_line IN LISTS _lines)
    if(_line MATCHES "^([A-Za-z0-9_/]+)\\.( |$)")
      string(REGEX REPLACE "/[0-9]+$" "" _name "${CMAKE_MATCH_1}")
      list(APPEND _names ${_name})
      set(_filter_of_${_name} "${_name}.*:${_name}/*")
    elseif(_line MATCHES "^  [A-Za-z0-9_]")
      math(EXPR _count_of_${_name} "${_count_of_${_name}} + 1")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES _names)
  set(_text)
  foreach(_name IN LISTS _names)
    string(REPLACE "/" "-" _file "${_name}")
    # What has many tests is likely to take long, and starts first.
    string(APPEND _text "add_test([[${_name}]] [[${PROGRAM}]] [[--gtest_filter=${_filter_of_${_name}}]] "
                        "[[--gtest_output=xml:${RESULTS}/${_file}.xml]])\n"
                        "set_tests_properties([[${_name}]] PROPERTIES COST ${_count_of_${_name}})\n")
  endforeach()
  file(WRITE "${OUTPUT}" "${_text}")
  return()
endif()

set(_sensornoise_tests_by_suite ${CMAKE_CURRENT_LIST_FILE})
function(sensornoise_add_suites program)
  set(_list ${CMAKE_CURRENT_BINARY_DIR}/${program}-suites.cmake)
  add_custom_command(
    TARGET ${program} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${program}> -DRESULTS=${CMAKE_BINARY_DIR}/test-results/${program}
            -DOUTPUT=${_list} -P ${_sensornoise_tests_by_suite}
    VERBATIM)
  # A program that was not built is a test that fails, not one that is missing.
  set(_include ${CMAKE_CURRENT_BINARY_DIR}/${program}-include.cmake)
  file(WRITE ${_include} "if(EXISTS [[${_list}]])\n  include([[${_list}]])\nelse()\n"
                         "  add_test(${program}_NOT_BUILT ${program}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${_include})
endfunction()
