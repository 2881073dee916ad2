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

/** Fits a first line to the medians of 40 bins of the intensity. \a trim has the medians for the degrees of freedom of
 * all pixels. Null if there is only one intensity. */
SensorNoise_EXPORT std::optional<VarianceLine>
FitMedians(const VarianceData & data, const ChiSquareTrim & trim);

} // namespace sensornoise

#endif
