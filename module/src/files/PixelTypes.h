// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_PixelTypes_h
#define sensornoise_files_PixelTypes_h

#include "sensornoise/FrameFile.h"

namespace sensornoise
{

/** Returns function(0) with a 0 of the type of C++ of \a pixel. */
template <typename TFunction>
auto
CallWithPixelType(FramePixel pixel, TFunction function)
{
  switch (pixel)
  {
    case FramePixel::UnsignedChar:
      return function(static_cast<unsigned char>(0));
    case FramePixel::UnsignedShort:
      return function(static_cast<unsigned short>(0));
    case FramePixel::Short:
      return function(static_cast<short>(0));
    case FramePixel::Float:
      return function(0.0F);
    default:
      return function(0.0);
  }
}

} // namespace sensornoise

#endif
