// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_AndroidExport_h
#define sensornoise_exports_AndroidExport_h

#include "sensornoise/NoiseExport.h"

#include <vector>

namespace sensornoise
{

/** The coefficients of Android's sensor noise model (CTS, dng_noise_model.py), JSON: for each channel S = A iso + B and
 * O = C iso^2 + D d^2 with d = max(1, iso / max_analog_iso), where S and O are those of NoiseProfile at this ISO speed.
 * The fits weight relative errors, and no coefficient of O is negative. The note has the largest misfit of the
 * variance. Throws ExportError unless two reports have different ISO speeds and all have the same channels. */
NoiseExport
ExportAndroid(const std::vector<CameraNoise> & settings);

} // namespace sensornoise

#endif
