// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_Emva1288_h
#define sensornoise_page_Emva1288_h

#include "sensornoise/Report.h"

#include <string>
#include <vector>

namespace sensornoise
{

/** A quantity of EMVA standard 1288 beside what the report has of it. */
struct Emva1288Row
{
  std::string symbol;
  std::string name;
  std::string value;  ///< with its unit; "not given by this method", or "not known" of this report
  std::string source; ///< what of the report it is, or is computed from
};

/** What the standard asks for, as far as a burst of any scene tells: photons are not counted, so there is no quantum
 * efficiency and no measured SNR curve. What follows from gain, read noise, offset and the level of saturation is
 * computed, by the standard's linear model. */
std::vector<Emva1288Row>
Emva1288Rows(const Report & report);

} // namespace sensornoise

#endif
