// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorCorrelation_h
#define RealSensorCorrelation_h

#include "sensornoise/Report.h"

#include <string>

/** \file
 * What a report says of noise that neighbours or frames share, in one place. */

namespace sensornoise::tools
{

/** The kind of the noise: "white", "crosstalk", "filtered", "temporal", "brighter-fatter", "not-linear"; "": the report
 * names none. */
std::string
KindOf(const Report & report);

/** Standard deviation of what the pixels of a row share in a frame [DN]; failed: the report does not have it. */
Quantity
RowNoiseOf(const Report & report);

/** The same of a column. */
Quantity
ColumnNoiseOf(const Report & report);

} // namespace sensornoise::tools

#endif
