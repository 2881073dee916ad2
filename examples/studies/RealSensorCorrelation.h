/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef RealSensorCorrelation_h
#define RealSensorCorrelation_h

#include "sensornoise/report/Report.h"

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
