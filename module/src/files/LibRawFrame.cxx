// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifdef SENSORNOISE_LIBRAW
#  include "files/RawCameraFile.h"

#  include "base/FreeMemory.h"
#  include "sensornoise/FrameFile.h"
#  include "files/FileBytes.h"

#  include <libraw/libraw.h>

#  include <algorithm>
#  include <atomic>
#  include <cstdio>
#  include <cstring>
#  include <exception>

namespace sensornoise
{
namespace
{
/** Stream of a file for LibRaw that detects reads behind the end of the file. Many decoders of LibRaw take zeros for
 * the missing bytes and report no error. */
class LibRawStream : public LibRaw_bigfile_datastream
{
public:
  explicit LibRawStream(const std::string & file);

  /** Detects reads behind the end from now on. The reader of the header may read behind the end without damage. */
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
  /** Records a read behind the end. Throws in the decoder, unless it may run in several threads, which an exception
   * cannot leave. */
  void
  OnEnd();

  bool              m_Watches{ false };
  bool              m_ReadsBlocks{ false }; // decoders read blocks, and the last block may be short
  bool              m_MayThrow{ false };
  std::atomic<bool> m_HasEnded{ false };
};

LibRawStream::LibRawStream(const std::string & file)
  : LibRaw_bigfile_datastream(file.c_str())
{
  if (!valid())
  {
    throw FileError(file, "cannot be read");
  }
  char      head[4] = {};
  FileBytes bytes(file);
  bytes.ReadSome(0, head, sizeof(head));
  m_MayThrow = std::memcmp(head, "II", 2) == 0 || std::memcmp(head, "MM", 2) == 0;
  m_ReadsBlocks = std::memcmp(head, "IIU", 3) == 0; // Panasonic
}

int
LibRawStream::read(void * buffer, size_t size, size_t count)
{
  const int found = LibRaw_bigfile_datastream::read(buffer, size, count);
  if (m_Watches && size != 0 && found < static_cast<int>(count) && (found <= 0 || !m_ReadsBlocks))
  {
    OnEnd();
  }
  return found;
}

int
LibRawStream::get_char()
{
  const int found = LibRaw_bigfile_datastream::get_char();
  if (m_Watches && found == EOF)
  {
    OnEnd();
  }
  return found;
}

void
LibRawStream::OnEnd()
{
  m_HasEnded = true;
  if (m_MayThrow)
  {
    throw LIBRAW_EXCEPTION_IO_EOF;
  }
}

/** Calls LibRaw, which reports errors as numbers or exceptions. Returns the error in words; "" if there is none. */
template <typename TCall>
std::string
ErrorOf(TCall call)
{
  try
  {
    const int code = call();
    return code == LIBRAW_SUCCESS ? "" : libraw_strerror(code);
  }
  catch (const LibRaw_exceptions &)
  {
    return "Data error";
  }
  catch (const std::exception & error)
  {
    return error.what();
  }
}

/** Throws FileError for several frames, several colours per pixel, and a mosaic that is turned by 45 degrees. */
void
RequireOneMosaic(const std::string & file, LibRaw & raw)
{
  const libraw_iparams_t & about = raw.imgdata.idata;
  if (about.raw_count != 1)
  {
    throw FileError(file, "has " + std::to_string(about.raw_count) + " frames; expected one a raw file");
  }
  if (about.is_foveon != 0 || raw.is_sraw() != 0 || (about.filters == 0 && about.colors != 1))
  {
    throw FileError(file, "several colours a pixel; expected one, as a mosaic has it");
  }
  if (raw.is_fuji_rotated() != 0 || about.filters == 1)
  {
    throw FileError(file, "pixels that are not in rows and columns of one frame; expected a plain mosaic");
  }
}

void
RequireInside(const std::string & file, const libraw_image_sizes_t & sizes)
{
  if (sizes.width == 0 || sizes.height == 0 || sizes.left_margin + sizes.width > sizes.raw_width ||
      sizes.top_margin + sizes.height > sizes.raw_height)
  {
    throw FileError(file,
                    "damaged: its visible area of " + std::to_string(sizes.width) + " x " +
                      std::to_string(sizes.height) + " pixels is not within the " + std::to_string(sizes.raw_width) +
                      " x " + std::to_string(sizes.raw_height) + " that it has");
  }
}

/** Throws FileError for more than 32 pixels per byte of the file. No raw file packs more, and decoding a hostile header
 * could take minutes and all memory. */
void
RequireSomeBytes(const std::string & file, const libraw_image_sizes_t & sizes, double bytes)
{
  constexpr double mostPixelsPerByte = 32.0;
  const double     pixels = static_cast<double>(sizes.raw_width) * static_cast<double>(sizes.raw_height);
  if (pixels > mostPixelsPerByte * bytes)
  {
    throw FileError(file,
                    "truncated or damaged: declares " + std::to_string(sizes.raw_width) + " x " +
                      std::to_string(sizes.raw_height) + " pixels, more than its bytes can hold");
  }
}
} // namespace

struct LibRawFrame::Implementation
{
  explicit Implementation(const std::string & file)
    : stream(file)
    , raw(0)
  {
    // Without a handler, decoders print a message about data that they cannot decode, and continue. The type of the
    // position differs between versions of LibRaw.
    raw.set_dataerror_handler([](void * seen, const char *, auto) { *static_cast<bool *>(seen) = true; },
                              &hasDataError);
#  if LIBRAW_VERSION < LIBRAW_MAKE_VERSION(0, 21, 0)
    raw.imgdata.params.raw_processing_options = 0;
#  else
    raw.imgdata.rawparams.options = 0;
#  endif
  }

  bool         hasDataError{ false };
  LibRawStream stream; // must outlive `raw`, which reads it
  LibRaw       raw;
};

LibRawFrame::LibRawFrame(const std::string & file)
  : m_File(file)
  , m_Raw(std::make_unique<Implementation>(file))
{
  const std::string error = ErrorOf([this] { return m_Raw->raw.open_datastream(&m_Raw->stream); });
  if (!error.empty())
  {
    throw FileError(file, "LibRaw cannot read it (" + error + "); expected the raw file of a camera");
  }
  RequireOneMosaic(file, m_Raw->raw);
  RequireInside(file, m_Raw->raw.imgdata.sizes);
  RequireSomeBytes(file, m_Raw->raw.imgdata.sizes, static_cast<double>(m_Raw->stream.size()));
  const std::string loss = LossOf(m_Raw->raw);
  if (!loss.empty())
  {
    throw FileError(
      file, "compressed with loss (" + loss + "); expected uncompressed digital numbers, or compressed without");
  }
}

LibRawFrame::~LibRawFrame() = default;

std::size_t
LibRawFrame::Width() const
{
  return m_Raw->raw.imgdata.sizes.width;
}

std::size_t
LibRawFrame::Height() const
{
  return m_Raw->raw.imgdata.sizes.height;
}

std::size_t
LibRawFrame::RawWidth() const
{
  return m_Raw->raw.imgdata.sizes.raw_width;
}

std::size_t
LibRawFrame::RawHeight() const
{
  return m_Raw->raw.imgdata.sizes.raw_height;
}

void
LibRawFrame::Decode()
{
  constexpr double bytesPerPixel = 2.0;
  constexpr double moreRows = 8.0; // rows that LibRaw allocates in addition
  RequireMemory(bytesPerPixel * static_cast<double>(RawWidth()) * (static_cast<double>(RawHeight()) + moreRows),
                m_File + " is decoded whole: it");
  m_Raw->stream.WatchForEnd();
  const std::string error = ErrorOf([this] { return m_Raw->raw.unpack(); });
  if (m_Raw->stream.HasEnded())
  {
    throw FileError(m_File, "truncated or damaged: ends before its pixels do");
  }
  if (!error.empty() || m_Raw->hasDataError || m_Raw->raw.error_count() != 0)
  {
    throw FileError(m_File,
                    "damaged: its pixels cannot be decoded (" + (error.empty() ? std::string("data error") : error) +
                      "); expected the pixels of a whole file");
  }
  const libraw_rawdata_t & data = m_Raw->raw.imgdata.rawdata;
  if (data.raw_image == nullptr)
  {
    throw FileError(m_File, "several colours a pixel, or digital numbers that are not whole; expected a plain mosaic");
  }
  RequireInside(m_File, m_Raw->raw.imgdata.sizes);
}

void
LibRawFrame::CopyTo(unsigned short * greyValues) const
{
  const libraw_image_sizes_t & sizes = m_Raw->raw.imgdata.sizes;
  const std::size_t            pitch = sizes.raw_pitch / sizeof(unsigned short);
  const unsigned short * const first =
    m_Raw->raw.imgdata.rawdata.raw_image + sizes.top_margin * pitch + static_cast<std::size_t>(sizes.left_margin);
  for (std::size_t y = 0; y < sizes.height; ++y)
  {
    std::copy_n(first + y * pitch, sizes.width, greyValues + y * sizes.width);
  }
}

CameraSettings
LibRawFrame::Camera() const
{
  return CameraSettingsOf(m_Raw->raw);
}

} // namespace sensornoise
#endif
