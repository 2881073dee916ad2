#-- # Grading Level Criteria Report
#-- EVALUATION DATE: 2026-11-27
#-- EVALUATORS: [The ITKSensorNoise contributors]
#--
#-- ## Compliance level 3 star (Quality beta code)
#--   - [X] API | executable interface is considered mostly stable and feature complete
#--   - [X] 10% C0-code coverage demonstrated for testing suite
#--   - [X] Some tests exist and pass on at least some platform
#--   - [X] All requirements of Levels 2,1
#--
#-- Level 4 demands tests on all platforms that ITK supports. Windows and macOS were never tried.
# A link to this file in Modules/Remote of ITK, or its repository there, fetches the module from that repository. A copy of the
# file needs SensorNoise_GIT_REPOSITORY.
get_filename_component(_sensornoise_repository "${CMAKE_CURRENT_LIST_FILE}" REALPATH)
get_filename_component(_sensornoise_repository "${_sensornoise_repository}" DIRECTORY)
if(NOT SensorNoise_GIT_REPOSITORY AND EXISTS "${_sensornoise_repository}/itk-module.cmake")
  set(SensorNoise_GIT_REPOSITORY "${_sensornoise_repository}")
endif()
if(Module_SensorNoise AND NOT SensorNoise_GIT_REPOSITORY)
  message(FATAL_ERROR "Set SensorNoise_GIT_REPOSITORY to the URL or folder of the ITKSensorNoise repository.")
endif()
itk_fetch_module(
  SensorNoise
  "Measures the noise of a camera (gain, offset, read noise) from a burst of raw frames of any static scene,
also under flickering illumination and vibrations. After F. Sur and M. Grediac, SIAM J. Imaging Sci. 8(1), 2015,
https://doi.org/10.1137/140977035"
  MODULE_COMPLIANCE_LEVEL 3
  GIT_REPOSITORY ${SensorNoise_GIT_REPOSITORY}
  GIT_TAG e94f47d5ea7b7b224d7a7be4746ee43f12bea080
  )
