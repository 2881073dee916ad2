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

/** Returns whether this program was built with OpenSSL, which computes the hash. */
bool
HasHash();

/** Returns the number, the bytes and the SHA-256 of the files of \a list, including the files that hold only pixels.
 * Without OpenSSL the hash is missing. Reads all files once. Throws FileError if a file has changed since it was
 * opened. */
InputFiles
HashOf(const FrameList & list);

} // namespace sensornoise::tools

#endif
