// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef OutputTarget_h
#define OutputTarget_h

#include <filesystem>
#include <string>

namespace sensornoise::tools
{

/** File that an output name leads to, through symbolic links. */
struct OutputTarget
{
  enum class Kind
  {
    File,      ///< ordinary file, which may exist: replaced when the new file is complete
    Special,   ///< pipe or character device, such as /dev/null: written to, never replaced
    Descriptor ///< open file of this program, such as /dev/stdout or /dev/fd/3: written to
  };

  std::string           name; ///< as given
  Kind                  kind{ Kind::File };
  std::filesystem::path path;             ///< absolute, without symbolic links; empty for a descriptor
  int                   descriptor{ -1 }; ///< file descriptor of Kind::Descriptor; else -1
};

/** Finds the target of the output \a name. Writes nothing. Throws std::runtime_error, with the reason, if it cannot
 * be written: for example a missing folder, a missing permission, or a folder of this name. */
OutputTarget
FindTarget(const std::string & name);

} // namespace sensornoise::tools

#endif
