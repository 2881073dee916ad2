// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_CareamicsExport_h
#define sensornoise_exports_CareamicsExport_h

#include "sensornoise/NoiseExport.h"

namespace sensornoise
{

/** A GaussianMixtureNoiseModel of CAREamics with one Gaussian, between the darkest and the brightest level. Its
 * variance is exp(w0) + exp(w1) (x - min_signal) / (max_signal - min_signal), with w the second row of trained_weight.
 * Throws ExportError unless the variance at the darkest level is above 0 and the levels are known. */
NoiseExport
ExportCareamics(const CameraNoise & noise);

} // namespace sensornoise

#endif
