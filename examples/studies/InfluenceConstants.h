// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef InfluenceConstants_h
#define InfluenceConstants_h

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Prints name and value of all constants of the refined method that MultiplyConstants() can change. Unit, source and
 * meaning of each are in the Constants.h files of the components. */
void
PrintVariedConstants();

/** Multiplies constants of the refined method for the rest of the program. \a changes are of the form NAME=FACTOR,
 * with a name that PrintVariedConstants() prints and a positive factor: "Significance.manyTests=0.5". An integer
 * becomes the nearest integer, at least 1 if it was positive. Throws std::invalid_argument for another form or an
 * unknown name. */
void
MultiplyConstants(const std::vector<std::string> & changes);

} // namespace sensornoise::tools

#endif
