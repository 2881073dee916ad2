// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_FittedExports_h
#define sensornoise_exports_FittedExports_h

#include "sensornoise/NoiseExport.h"

#include <vector>

namespace sensornoise
{

/** Factor by which rpi-ctt 1.4.0 multiplies the slope that it stores [1]. */
constexpr double libcameraSlopeFactor = 1.4;

/** The numbers of rpi.noise, as a tuning file of libcamera has them. */
struct LibcameraNoise
{
  double constant{ 0.0 }; ///< reference_constant [DN of 16 bits]
  double slope{ 0.0 };    ///< reference_slope [root of DN of 16 bits]
};

/** Fits libcamera's model to a camera. Throws ExportError if the line, a level or the bit depth is missing. */
LibcameraNoise
FitLibcamera(const CameraNoise & noise);

/** Returns the variance of libcamera's model at a level [DN^2]: at the black level where the level is below. The camera
 * gives bit depth, analogue gain and black level. Throws ExportError if one is missing. */
double
LibcameraVariance(const LibcameraNoise & model, const CameraNoise & noise, double levelDn);

/** The section rpi.noise of a tuning file of libcamera, JSON. On a scale of 16 bits at an analogue gain of 1, its
 * standard deviation is constant + slope sqrt(mean - black). The constant and the slope are fitted between the black
 * and the white level, and stored as the tuning tool rpi-ctt 1.4.0 does: int(constant) and round(1.4 slope, 3).
 * Channels of a mosaic are averaged. The note has the largest error of the fit. */
NoiseExport
ExportLibcamera(const CameraNoise & noise);

/** The coefficients of Android's sensor noise model (CTS, dng_noise_model.py), JSON: for each channel S = A iso + B and
 * O = C iso^2 + D d^2 with d = max(1, iso / max_analog_iso), where S and O are those of NoiseProfile at this ISO speed.
 * The fits weight relative errors, and no coefficient of O is negative. The note has the largest error of the variance.
 * Throws ExportError unless two reports have different ISO speeds and all have the same channels. */
NoiseExport
ExportAndroid(const std::vector<CameraNoise> & settings);

} // namespace sensornoise

#endif
