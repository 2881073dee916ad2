// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FilesInUse_h
#define FilesInUse_h

#include <map>
#include <string>

namespace sensornoise::tools
{

/** \class FilesInUse
 * What a tool reads and writes: no file that is read may be written, and none twice. Files are told apart by device and
 * inode, so through symbolic and hard links. Pipes and devices may be both.
 */
class FilesInUse
{
public:
  /** \a file will be read, as "the frame", "the mask", and so on; and with a header of MetaImage or NRRD the files of
   * its pixels. */
  void
  Read(const std::string & file, const std::string & role);

  /** \a file will be written for \a option. Throws std::runtime_error, which names both, if it is in use. */
  void
  Write(const std::string & file, const std::string & option);

private:
  std::map<std::string, std::string> m_Uses; // of a file, by what it is told by
};

/** Throws std::runtime_error if a report of text would have the name of an image: most likely the report's name was
 * forgotten, and this is the first frame's. */
void
RequireReportName(const std::string & file, const std::string & option);

} // namespace sensornoise::tools

#endif
