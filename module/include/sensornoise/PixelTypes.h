// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_PixelTypes_h
#define sensornoise_PixelTypes_h

/** \def SensorNoise_FOR_PIXEL_TYPES
 * macro(TPixel) for each type of the pixels of frames, as a statement: with it templates are instantiated in the
 * library alone. */
#define SensorNoise_FOR_PIXEL_TYPES(macro) \
  macro(unsigned char);                    \
  macro(unsigned short);                   \
  macro(short);                            \
  macro(float);                            \
  macro(double)

#endif
