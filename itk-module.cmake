set(DOCUMENTATION
    "Measures the noise of a camera (gain, offset, read noise) from a burst of raw frames of any static scene,
under flickering illumination and vibration. After F. Sur and M. Grediac, SIAM J. Imaging Sci. 8(1), 2015,
https://doi.org/10.1137/140977035")

itk_module(SensorNoise
  ENABLE_SHARED
  DEPENDS
    ITKCommon
    ITKEigen3
    ITKIOImageBase
    ITKZLIB
  TEST_DEPENDS
    ITKTestKernel
    ITKGoogleTest
    ITKImageFilterBase
    ITKImageStatistics
    ITKIOTIFF
  FACTORY_NAMES
    ImageIO::SensorNoise
  DESCRIPTION "${DOCUMENTATION}"
  EXCLUDE_FROM_DEFAULT)
