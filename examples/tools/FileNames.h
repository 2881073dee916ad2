// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FileNames_h
#define FileNames_h

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Returns whether \a a precedes \a b in natural order, in which digits compare as numbers: frame_2 before frame_10. */
bool
IsBefore(const std::string & a, const std::string & b);

/** Replaces each folder by the images in it, and each pattern (* ? [) by the files that match it. Both are in the
 * order of IsBefore(). A name with such characters that exists as a file is not a pattern. Other names stay, in
 * their order. With \a areRaw the frames have no header, and all files of a folder are taken. Otherwise files that
 * are not images are left out, and a note on standard error says so. A second note reports names that a shell has
 * sorted as text. Throws std::invalid_argument if a name is empty, a folder holds no image, or no file matches a
 * pattern. */
std::vector<std::string>
ExpandNames(const std::vector<std::string> & names, bool areRaw);

} // namespace sensornoise::tools

#endif
