// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_BinaryExports_h
#define sensornoise_exports_BinaryExports_h

#include "sensornoise/NoiseExport.h"

namespace sensornoise
{

/** A GaussianMixtureNoiseModel of CAREamics with one Gaussian, between the darkest and the brightest level. Its
 * variance is exp(w0) + exp(w1) (x - min_signal) / (max_signal - min_signal), with w the second row of trained_weight.
 * Throws ExportError unless the variance at the darkest level is above 0 and the levels are known. */
NoiseExport
ExportCareamics(const CameraNoise & noise);

/** Maps of the pixels as TIFF files of 32-bit floating-point numbers, a row of the file for a row of the sensor:
 * offset.tif [DN] and variance.tif, the square of the read noise [DN^2]. Of a sensor without a mosaic with a gain, also
 * variance_electrons.tif [e-^2]. Throws ExportError if the report has no maps. */
NoiseExport
ExportMaps(const CameraNoise & noise);

} // namespace sensornoise

#endif
