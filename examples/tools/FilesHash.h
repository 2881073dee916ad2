// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FilesHash_h
#define FilesHash_h

#include "sensornoise/Report.h"

namespace sensornoise
{
struct FrameList;
}

namespace sensornoise::tools
{

/** Whether this program was built with OpenSSL, which computes the hash. */
bool
HasHash();

/** Number, bytes and SHA-256 of the files of \a list, and of their pixels where these are in other files; without
 * OpenSSL there is no hash. Reads all of them once. Throws FileError if one is no longer what was opened. */
InputFiles
HashOf(const FrameList & list);

} // namespace sensornoise::tools

#endif
