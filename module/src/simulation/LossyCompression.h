// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_LossyCompression_h
#define sensornoise_simulation_LossyCompression_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/SensorFlaws.h"
#include "simulation/DoubleFrame.h"

#include <array>
#include <cstddef>

namespace sensornoise
{

/** Quantization step of each coefficient [DN], row by row: vertical frequency 0 to 7, within it horizontal frequency 0
 * to 7. */
using BlockStepsDn = std::array<double, 64>;

/** \throws std::invalid_argument if the setting cannot be used with a converter of \a bitDepth bits. */
SensorNoise_EXPORT void
CheckSettings(const BlockSettings & settings, unsigned int bitDepth);

/** Returns the luminance table of T.81, Table K.1, in units of (2^bitDepth - 1) / 255 [DN]. It is scaled by the quality
 * and rounded as libjpeg's jpeg_quality_scaling() and jpeg_add_quant_table() do for baseline JPEG. */
SensorNoise_EXPORT BlockStepsDn
StepsOfQuality(const BlockSettings & settings, unsigned int bitDepth);

/** Returns \a codesDn with the coefficients of each block rounded to multiples of \a stepsDn, all above 0 [DN]. A block
 * that the edge of the frame cuts is filled with copies of its last column and row. */
SensorNoise_EXPORT DoubleFrame
QuantiseBlocks(const DoubleFrame & codesDn, const BlockStepsDn & stepsDn, const ParallelFor & parallelFor);

/** \throws std::invalid_argument if the setting cannot be used with a converter of \a bitDepth bits. */
SensorNoise_EXPORT void
CheckSettings(const CompandingSettings & settings, unsigned int bitDepth);

/** Compands the codes and expands them again, in place [DN].
 * \param codesDn codes, which are clamped to 0 and 2^bitDepth - 1 first */
SensorNoise_EXPORT void
Compand(double * codesDn, std::size_t count, const CompandingSettings & settings, unsigned int bitDepth);

} // namespace sensornoise

#endif
