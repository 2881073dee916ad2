// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef InfluenceConstants_h
#define InfluenceConstants_h

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Prints the constants of the refined method that MultiplyConstants() can change: name, value, unit and purpose.
 * They are the most influential of all numbers in the Constants.h files of the components: half or twice their value
 * changed the results of the robustness cases most. */
void
PrintVariedConstants();

/** Multiplies constants of the refined method for the rest of the program. \a changes are of the form NAME=FACTOR,
 * with a name that PrintVariedConstants() prints and a positive factor: "Significance.manyTests=0.5". Throws
 * std::invalid_argument for another form or an unknown name. */
void
MultiplyConstants(const std::vector<std::string> & changes);

} // namespace sensornoise::tools

#endif
