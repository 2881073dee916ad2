// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_DataFile_h
#define sensornoise_files_DataFile_h

#include "files/FileIdentity.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** Where the pixels of a MetaImage or NRRD file are, or those of one of its frames. */
struct DataPlace
{
  std::string   path{}; // of the file itself, or of its data file
  std::uint64_t offset{ 0 };
  bool fromEnd{ false }; // the pixels are the last bytes of the file; `offset` is then the least that it may be
  bool attached{ true }; // in the file itself, behind its header
};

/** Notes the identity of \a path among \a identities. Throws FileError where there is no regular file, and where it is
 * there already: the file whose data it should be, or that of another frame. */
void
AddDataFile(const std::string & file, const std::string & path, std::vector<FileIdentity> & identities);

/** Throws FileError unless the file holds exactly \a expected bytes at that place, up to its end. Where only that end
 * is known, fewer bytes than a frame has may be left over before: with more, the header may have lost frames. */
void
RequireExactly(const std::string & file, const DataPlace & place, std::uint64_t expected, std::uint64_t frameBytes);

/** Throws FileError unless the bytes there, \a compressed of them or, where that is 0, all up to the end of the file,
 * are one stream of gzip (or, if \a orZlib, of zlib) that gives exactly \a expected bytes, and the file ends with it.
 */
void
RequireInflates(const std::string & file,
                const DataPlace &   place,
                std::uint64_t       compressed,
                std::uint64_t       expected,
                bool                orZlib);

} // namespace sensornoise

#endif
