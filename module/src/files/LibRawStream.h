// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_LibRawStream_h
#define sensornoise_files_LibRawStream_h
#ifdef SENSORNOISE_LIBRAW

#  include <libraw/libraw.h>

#  include <atomic>
#  include <string>

namespace sensornoise
{

/** A file as LibRaw reads it, which tells whether it was asked for bytes behind its end: many of LibRaw's decoders take
 * these for zeros, and say nothing. */
class LibRawStream : public LibRaw_bigfile_datastream
{
public:
  explicit LibRawStream(const std::string & file);

  /** From here on; what reads a header may look too far. */
  void
  WatchForEnd()
  {
    m_Watches = true;
  }

  bool
  HasEnded() const
  {
    return m_HasEnded;
  }

  int
  read(void * buffer, size_t size, size_t count) override;
  int
  get_char() override;

private:
  /** What a decoder gets at the end: an exception, unless it may run in several threads, which no exception leaves. */
  void
  OnEnd();

  bool              m_Watches{ false };
  bool              m_ReadsBlocks{ false }; // of a fixed size, also the last
  bool              m_MayThrow{ false };
  std::atomic<bool> m_HasEnded{ false };
};

} // namespace sensornoise

#endif
#endif
