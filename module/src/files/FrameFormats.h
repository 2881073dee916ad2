// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FrameFormats_h
#define sensornoise_files_FrameFormats_h

#include "SensorNoiseExport.h"
#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"

#include <initializer_list>
#include <string>
#include <vector>

namespace sensornoise
{

/** A format that is read: a line of the table in FrameFormats.cxx, which is all that knows of it but its own files. */
struct FrameFormat
{
  const char * name;    ///< as sentences call it
  const char * imageIO; ///< the class of ITK that reads it, once it was found to be whole; null: FrameFile::reader does
  const char * itkModule; ///< the module of ITK that brings this class

  /** Whether a file is of this format, by its first bytes, 512 or all, and where these do not tell by its name. */
  bool (*isItsHead)(const std::string & head, const std::string & name);

  /** Fills in all of \a file but its name, format and first identity, or throws FileError, see InspectFrameFile(). */
  void (*inspect)(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);
};

/** All formats. A file is of the first that takes its head. */
SensorNoise_EXPORT const std::vector<FrameFormat> &
FrameFormats();

/** The format of a file that begins with \a head; null: none of them. */
SensorNoise_EXPORT const FrameFormat *
FindFrameFormat(const std::string & head, const std::string & name);

/** Whether a file's name ends in one of \a endings, each with its dot. */
bool
HasEnding(const std::string & name, std::initializer_list<const char *> endings);

/** What is expected of a file: "TIFF, PNG, MetaImage or NRRD". */
SensorNoise_EXPORT std::string
NamesOfFrameFormats();

} // namespace sensornoise

#endif
