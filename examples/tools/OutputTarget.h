// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef OutputTarget_h
#define OutputTarget_h

#include <filesystem>
#include <string>

namespace sensornoise::tools
{

/** Where the name of an output leads, through symbolic links. */
struct OutputTarget
{
  enum class Kind
  {
    File,      ///< an ordinary one, there already or not: replaced when the new one is complete
    Special,   ///< a pipe or a character device, such as /dev/null: written to, never replaced
    Descriptor ///< an open file of this program, such as /dev/stdout or /dev/fd/3: written to
  };

  std::string           name; ///< as given
  Kind                  kind{ Kind::File };
  std::filesystem::path path;             ///< absolute, without symbolic links; empty for a descriptor
  int                   descriptor{ -1 }; ///< of Kind::Descriptor
};

/** Follows \a name. Throws std::runtime_error, which says why, if it cannot be written: no folder, no permission, a
 * folder itself. Writes nothing. */
OutputTarget
FindTarget(const std::string & name);

} // namespace sensornoise::tools

#endif
