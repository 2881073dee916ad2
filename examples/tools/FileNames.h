// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FileNames_h
#define FileNames_h

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Whether \a a comes before \a b where numbers in names count as numbers: frame_2 before frame_10. */
bool
IsBefore(const std::string & a, const std::string & b);

/** Replaces each folder by the images in it and each pattern (* ? [), for which there is no file of that name, by the
 * files that match it, both in the order of IsBefore(). Other names stay, in their order. \a areRaw: the frames have no
 * header, and all files of a folder count; else files that are no images are left out, which a note on standard error
 * says. A second note says where a shell has sorted the names as text. Throws std::invalid_argument where a folder has
 * no image or a pattern no file. */
std::vector<std::string>
ExpandNames(const std::vector<std::string> & names, bool areRaw);

} // namespace sensornoise::tools

#endif
