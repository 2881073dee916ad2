// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FileIdentity_h
#define sensornoise_files_FileIdentity_h

#include "sensornoise/FrameFile.h"
#include "SensorNoiseExport.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

SensorNoise_EXPORT bool
operator==(const FileIdentity & a, const FileIdentity & b);

inline bool
operator!=(const FileIdentity & a, const FileIdentity & b)
{
  return !(a == b);
}

/** Whether both are the same file, in whichever state, by whichever names. */
SensorNoise_EXPORT bool
AreSameFile(const FileIdentity & a, const FileIdentity & b);

/** The identity of the regular file that \a name, or the link of that name, stands for. It is not opened: pipes and
 * devices cannot make this wait. Throws FileError where there is no file, or no regular one. */
SensorNoise_EXPORT FileIdentity
IdentityOf(const std::string & name);

/** The same of a file whose name stands in another one, \a file, with which the errors then begin. */
SensorNoise_EXPORT FileIdentity
IdentityOfDataFile(const std::string & file, const std::string & dataFile);

} // namespace sensornoise

#endif
