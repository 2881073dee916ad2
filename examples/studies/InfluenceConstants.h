// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef InfluenceConstants_h
#define InfluenceConstants_h

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Prints the constants of the refined method that MultiplyConstants() changes: name, value, unit, what for. They are
 * the most influential ones: of all numbers in the Constants.h of the components, those whose half or double changed
 * most in the robustness cases. */
void
PrintVariedConstants();

/** Multiplies constants of the refined method for the rest of the program. \a changes are of the form NAME=FACTOR, with
 * the name as at the place where the constant is used: "Significance.manyTests=0.5". Throws std::invalid_argument for
 * another form or another name. */
void
MultiplyConstants(const std::vector<std::string> & changes);

} // namespace sensornoise::tools

#endif
