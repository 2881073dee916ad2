// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_MedianLine_h
#define sensornoise_pixels_MedianLine_h

#include "SensorNoiseExport.h"
#include "pixels/VarianceLine.h"

#include <optional>

namespace sensornoise
{

class ChiSquareTrim;

/** A first line, through the medians of 40 bins of the intensity; \a trim knows the medians of all degrees of freedom.
 * Null with one intensity. */
SensorNoise_EXPORT std::optional<VarianceLine>
FitMedians(const VarianceData & data, const ChiSquareTrim & trim);

} // namespace sensornoise

#endif
