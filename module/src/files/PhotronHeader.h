// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_PhotronHeader_h
#define sensornoise_files_PhotronHeader_h

#include "files/FileBytes.h"

#include <map>
#include <string>

namespace sensornoise
{

/** The fields of a .cihx file by the path of their elements below <cih>, "frameInfo/totalFrame", with their text; those
 * of an older .cih file by their names, "Total Frame". Of a .cihx only what is between <cih> and </cih> is read, as
 * there may be anything around it. Fields that come twice with different texts have the text "two values". \a file
 * begins the errors. Throws FileError for elements that are not closed, and above 4 MiB. */
std::map<std::string, std::string>
ReadPhotronHeader(const std::string & file, FileBytes & bytes);

} // namespace sensornoise

#endif
