// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ExposureList_h
#define ExposureList_h

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Returns whether the value of --exposures is a list of numbers, "0,0,10,20.5". Otherwise it is a file name. */
bool
IsExposureList(const std::string & text);

/** Reads the exposures of --exposures: a list of numbers separated by commas, or a text file with one frame per
 * line. The exposure is the last column of a line. One character separates the columns of the whole file: a tab if it
 * has one, else a semicolon, else a comma. With a tab or a semicolon, decimals may have a comma. The first line may be
 * a header. Empty lines and lines that begin with # are skipped. Throws std::runtime_error if the file cannot be read
 * or holds no exposure, or if each line is two whole numbers and a comma, which may be a decimal comma. A line that
 * does not end with a number, or has a different number of columns from the first line, also throws; the error names
 * the line. */
std::vector<double>
ReadExposures(const std::string & text);

} // namespace sensornoise::tools

#endif
