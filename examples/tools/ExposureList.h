// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ExposureList_h
#define ExposureList_h

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Whether the value of --exposures is a list of numbers, "0,0,10,20.5", and not the name of a file. */
bool
IsExposureList(const std::string & text);

/** Reads the exposures of --exposures: a list of numbers separated by commas, or a text file with one frame a line,
 * whose exposure is the last column. Columns are separated by commas, semicolons or tabs. The first line may be a
 * header; empty lines and lines that begin with # are skipped. Throws std::runtime_error that names the line for a line
 * that is no number or has another number of columns than the first one, and for a file that cannot be read. */
std::vector<double>
ReadExposures(const std::string & text);

} // namespace sensornoise::tools

#endif
