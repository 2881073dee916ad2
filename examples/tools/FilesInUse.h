// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FilesInUse_h
#define FilesInUse_h

#include <map>
#include <string>

namespace sensornoise::tools
{

/** \class FilesInUse
 * Files that a tool reads and writes. A file that is read may not be written, and no file may be written twice.
 * Files are identified by device and inode, so symbolic and hard links are resolved. Pipes and devices are exempt.
 */
class FilesInUse
{
public:
  /** Registers \a file as input. \a role is its name in messages: "the frame", "the mask". The pixel files of a
   * header (MetaImage, NRRD, Photron) are registered as well. */
  void
  Read(const std::string & file, const std::string & role);

  /** Registers \a file as the output of \a option. Throws std::runtime_error, which names both uses, if the file is
   * in use. */
  void
  Write(const std::string & file, const std::string & option);

private:
  std::map<std::string, std::string> m_Uses; // role and name of each file, by its identity
};

/** Throws std::runtime_error if a text report would get the name of an image. Most likely the name of the report was
 * forgotten, and this is the name of the first frame. */
void
RequireReportName(const std::string & file, const std::string & option);

} // namespace sensornoise::tools

#endif
