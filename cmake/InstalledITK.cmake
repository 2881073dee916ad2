# Way 3: an installed ITK has no module macros, so the library, the tools and the tests are plain CMake targets.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
option(SensorNoise_BUILD_EXAMPLES "Build the command-line tools and the example programs" ON)
option(BUILD_SHARED_LIBS "Build a shared library" OFF)
option(BUILD_TESTING "Build the tests" ON)
option(SensorNoise_UNITY_BUILD "Compile sources together, which takes half of the time" ON)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(SensorNoise_INSTALL_INCLUDE_DIR ${CMAKE_INSTALL_INCLUDEDIR}/SensorNoise)
if(UNIX AND NOT APPLE)
  set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}") # the tools find a shared library that was installed with them
endif()

# The whole of the distribution's ITK wants the development files of every library that it was built with, and programs would
# load these libraries. These modules are all that the filters, the tools and the tests use: of the formats, those that the
# tools write. Frames are read without ITK.
set(_modules ITKCommon ITKEigen3 ITKIOImageBase)
if(SensorNoise_BUILD_EXAMPLES OR BUILD_TESTING)
  list(APPEND _modules ITKIOMeta ITKIONRRD ITKIOPNG ITKIOTIFF ITKImageFeature ITKImageFilterBase ITKImageGrid
       ITKImageStatistics)
endif()
find_package(ITK 5.2.1 REQUIRED COMPONENTS ${_modules})
include(cmake/RegisterFormats.cmake)
sensornoise_register_formats()
if(NOT TARGET ITK::ITKCommonModule)
  include(cmake/ClangHeaders.cmake)
  find_package(ZLIB REQUIRED) # the same as ITK's: the module ITKZLIB of an installed ITK may stand for the system's
endif()

add_subdirectory(module)
# Ways 1 and 2 compile the files one by one, which shows whether each includes what it uses.
include(cmake/UnityByComponent.cmake)
sensornoise_unity_by_component(SensorNoise)

install(EXPORT SensorNoiseTargets NAMESPACE SensorNoise:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/SensorNoise)
configure_package_config_file(cmake/SensorNoiseConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/SensorNoiseConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/SensorNoise)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/SensorNoiseConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/SensorNoiseConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/SensorNoiseConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/SensorNoise)

if(SensorNoise_BUILD_EXAMPLES)
  add_subdirectory(examples)
endif()
if(BUILD_TESTING)
  enable_testing()
  add_subdirectory(test)
endif()
