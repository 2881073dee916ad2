// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_LibcameraExport_h
#define sensornoise_exports_LibcameraExport_h

#include "sensornoise/NoiseExport.h"

namespace sensornoise
{

/** The section rpi.noise of a tuning file of libcamera, JSON. On a scale of 16 bits at an analogue gain of 1, its
 * standard deviation is constant + slope sqrt(mean - black). The constant and the slope are fitted between the black
 * and the white level, and stored as the tuning tool rpi-ctt 1.4.0 does: int(constant) and round(1.4 slope, 3).
 * Channels of a mosaic are averaged. The note has the largest misfit. */
NoiseExport
ExportLibcamera(const CameraNoise & noise);

} // namespace sensornoise

#endif
