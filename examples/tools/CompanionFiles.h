// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef CompanionFiles_h
#define CompanionFiles_h

#include "itkSensorNoiseFrameFiles.h"
#include "itkImage.h"

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Reads a mask of the size of the frames from a file of any pixel type. Returns 1 where the file is not 0. Throws
 * std::runtime_error. */
itk::Image<unsigned char, 2>::Pointer
ReadMask(const std::string & file, const FrameList & frames);

/** Warns on standard error if a file is both a frame and a dark frame. */
void
WarnOfSharedDarkFrames(const std::vector<std::string> & dark, const std::vector<std::string> & frames);

/** Opens the headers of dark frames, which must have the size and type of the bright frames. \a rawLayout and \a
 * choice are as for OpenFrames(). Throws std::runtime_error. */
FrameList
OpenDark(const std::vector<std::string> & files,
         const FrameList &                frames,
         const std::string &              rawLayout,
         const FrameChoice &              choice);

/** Prints a warning about the files, if there is one, on standard error. */
void
PrintWarningOf(const FrameList & frames);

} // namespace sensornoise::tools

#endif
