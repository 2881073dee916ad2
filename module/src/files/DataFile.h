// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_DataFile_h
#define sensornoise_files_DataFile_h

#include "sensornoise/FrameFile.h"
#include "files/FrameReader.h"
#include "files/Inflate.h"

#include <cstdint>
#include <optional>
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

/** Returns where the pixels begin. Throws FileError unless the file holds exactly \a expected bytes at that place, up
 * to its end. Where only that end is known, fewer bytes than a frame has may be left over before: with more, the header
 * may have lost frames. */
std::uint64_t
RequireExactly(const std::string & file, const DataPlace & place, std::uint64_t expected, std::uint64_t frameBytes);

/** Throws FileError if \a left bytes, those behind the pixels, are any. */
void
RequireNothingLeft(const std::string & file, const DataPlace & place, std::uint64_t left);

/** " in its data file NAME", or nothing for a place in \a file itself. */
std::string
InDataFile(const std::string & file, const DataPlace & place);

/** The path of a data file that the header of \a file names: relative to the folder of \a file. */
std::string
PathOfDataFile(const std::string & file, const std::string & name);

/** How the numbers at the places of pixels are written. */
struct DataCoding
{
  SampleFormat                    sample{};
  std::optional<InflateContainer> compression{};
  std::uint64_t                   compressedBytes{ 0 }; // of one place; 0: all up to the end of its file
};

/** Checks that the places, one for all frames or one for each, hold exactly the pixels of \a file, whose size is set;
 * adds the identities of data files; and sets the reader of the frames. Calls \a beforeInflating before it inflates
 * compressed pixels. Throws FileError. */
void
SetDataFrames(FrameFile &                    file,
              const std::vector<DataPlace> & places,
              const DataCoding &             coding,
              const BeforeInflating &        beforeInflating);

} // namespace sensornoise

#endif
