// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_NrrdGeometry_h
#define sensornoise_files_NrrdGeometry_h

#include "sensornoise/FrameFile.h"
#include "files/NrrdHeader.h"

#include <cstddef>
#include <string>

namespace sensornoise
{

/** Returns the positions that the header of a NRRD image of \a axes axes gives, in the coordinates of ITK (left,
 * posterior, superior), to which RAS and LAS are converted. Without a space, `spacings` count; with a space of another
 * number of axes, the default stands. Throws FileError where a field cannot be read. Source: the fields "Space and
 * orientation information" of the definition of the format, https://teem.sourceforge.net/nrrd/format.html. */
StackGeometry
GeometryOfNrrd(const std::string & file, const NrrdHeader & header, std::size_t axes);

} // namespace sensornoise

#endif
