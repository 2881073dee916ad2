// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_NpzReader_h
#define sensornoise_exports_NpzReader_h

#include <map>
#include <string>
#include <vector>

namespace sensornoise
{

/** Returns the arrays of a NumPy archive (.npz) by their names, the values in the order of the file. Throws ExportError
 * unless \a bytes are a whole ZIP file, whose members are not compressed and are arrays of float or double of little
 * endian. */
std::map<std::string, std::vector<double>>
ReadNpz(const std::string & bytes);

} // namespace sensornoise

#endif
