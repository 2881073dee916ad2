// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FrameReader_h
#define sensornoise_files_FrameReader_h

#include <cstddef>

namespace sensornoise
{

struct FrameFile;

/** Reads frames of a file that was inspected, with this library's own code, a few at a time. */
class FrameReader
{
public:
  FrameReader() = default;
  virtual ~FrameReader() = default;
  FrameReader(const FrameReader &) = delete;
  FrameReader &
  operator=(const FrameReader &) = delete;

  /** Reads \a count frames from the frame \a first on, one after the other, into \a buffer, which has room for so many
   * pixels of the file's type. Holds a MiB or two beside them. Throws FileError where the file has changed in a way
   * that does not let them be read; RequireUnchanged() tells of others. May be called from several threads at once. */
  virtual void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const = 0;

  /** Returns whether frames have to be read in their order to be read fast: those of one compressed stream. Then
   * several threads would wait for each other. */
  virtual bool
  IsSequential() const
  {
    return false;
  }
};

} // namespace sensornoise

#endif
