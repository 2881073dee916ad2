// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_Sensitivity_h
#define sensornoise_emva1288_Sensitivity_h

#include "sensornoise/Emva1288.h"

namespace sensornoise
{

class DarkLevels;
struct TransferCurve;

/** Sets dark signal, dark noise (53), (54) and dark current (section 7.1). The dark noise and the dark current in
 * electrons need report.gain. */
void
MeasureDark(const DarkLevels & dark, EmvaReport & report);

/** Sets saturation capacity, sensitivity threshold (26), dynamic range (28) and largest signal-to-noise ratio (55), all
 * of which need report.gain. In photons they need report.quantumEfficiency. Where no frames are saturated, the
 * saturation has a lower bound and no value. */
void
MeasureRange(const TransferCurve & curve, const DarkLevels & dark, EmvaReport & report);

/** Sets the signal-to-noise ratios of the linear model of all points, (21) and (69). */
void
ModelSnr(const DarkLevels & dark, EmvaReport & report);

} // namespace sensornoise

#endif
