# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# sensornoise_register_formats(): for the targets of this folder that link ITK_LIBRARIES. A file of these that includes a
# reader or a writer of ITK registers the formats of the modules that find_package(ITK) found.
macro(sensornoise_register_formats)
  if(TARGET ITK::ITKCommonModule)
    # The targets of ITK 6 have its header folders.
    set(ITK_LIBRARIES ${ITK_INTERFACE_LIBRARIES})
    if("ImageIO" IN_LIST ITK_FACTORY_LIST)
      itk_generate_factory_registration(ImageIO)
      list(APPEND ITK_LIBRARIES ITK::ITKImageIO)
    endif()
  else()
    include(${ITK_USE_FILE})
  endif()
endmacro()
