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
  const char * name{ nullptr };       ///< as sentences call it
  bool         hasITKReader{ false }; ///< ITK's own class reads it, to which itk::ImageFileReader is left

  /** Whether a file is of this format, by its first bytes, 512 or all, and where these do not tell by its name. */
  bool (*isItsHead)(const std::string & head, const std::string & name){ nullptr };

  /** Fills in all of \a file but its name, format and first identity, and sets its reader, or throws FileError, see
   * InspectFrameFile(). */
  void (*inspect)(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating){ nullptr };

  /** The paths of the other files that hold a part of this one; null: all is in one file. */
  std::vector<std::string> (*dataFiles)(FileBytes & bytes, const std::string & name){ nullptr };
};

/** All formats. A file is of the first that takes its head. */
SensorNoise_EXPORT const std::vector<FrameFormat> &
FrameFormats();

/** The first bytes of a file, 512 or all. */
SensorNoise_EXPORT std::string
HeadOf(FileBytes & bytes);

/** The format of a file that begins with \a head; null: none of them. */
SensorNoise_EXPORT const FrameFormat *
FindFrameFormat(const std::string & head, const std::string & name);

/** Returns the paths of the files that hold the pixels, or the header, of a file, where they are not in it. They need
 * not exist. Nothing of a file that cannot be read. */
SensorNoise_EXPORT std::vector<std::string>
DataFilesOf(const std::string & name);

/** Whether a file's name ends in one of \a endings, each with its dot. */
bool
HasEnding(const std::string & name, std::initializer_list<const char *> endings);

/** What is expected of a file: "TIFF, PNG, MetaImage or NRRD". */
SensorNoise_EXPORT std::string
NamesOfFrameFormats();

} // namespace sensornoise

#endif
