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

/** Reads a mask: 1 where the file, of any type but of the size of the frames, is not 0. Throws std::runtime_error. */
itk::Image<unsigned char, 2>::Pointer
ReadMask(const std::string & file, const FrameList & frames);

/** Warns on standard error where a file is a frame and a dark frame. */
void
TellOfSharedDarkFrames(const std::vector<std::string> & dark, const std::vector<std::string> & frames);

/** Opens the headers of dark frames, which must have the size and type of the others; \a rawLayout and \a choice as
 * OpenFrames() takes them. Throws std::runtime_error. */
FrameList
OpenDark(const std::vector<std::string> & files,
         const FrameList &                frames,
         const std::string &              rawLayout,
         const FrameChoice &              choice);

/** Says on standard error what is odd about the files and no error. */
void
TellWarningOf(const FrameList & frames);

} // namespace sensornoise::tools

#endif
