// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_FrameFile_h
#define sensornoise_FrameFile_h

#include "SensorNoiseExport.h"
#include "sensornoise/CameraSettings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

class FrameReader; // private

/** What is wrong with a file: one sentence that begins with the file's name and says what was found and what was
 * expected. It is one line of UTF-8, whatever is in the file: other characters are shown as "?". */
class SensorNoise_EXPORT FileError : public std::runtime_error
{
public:
  FileError(const std::string & file, const std::string & what);
};

/** Which file a name stands for, and in which state: while it stays equal, nobody has replaced the file or written to
 * it (to the resolution of the file system's clock). */
struct FileIdentity
{
  std::string   name{};
  std::uint64_t device{ 0 };
  std::uint64_t inode{ 0 };
  std::uint64_t size{ 0 };         // [bytes]
  std::int64_t  modified{ 0 };     // the contents [ns since the file system's epoch]
  std::int64_t  statusChange{ 0 }; // contents or rights; unlike `modified` it cannot be set back [ns]
};

struct FrameFormat;

/** The component types that a stack may have. */
enum class FramePixel
{
  UnsignedChar,
  UnsignedShort,
  Short,
  Float,
  Double
};

/** The numbers that a file holds: those of FramePixel, or integers of 32 bits, which are read as double, that holds
 * each exactly. Integers of 64 bits are refused. */
enum class StoredNumber
{
  SameAsPixel,
  UnsignedInt,
  Int
};

/** An axis along which the frames of a file differ. */
struct FrameAxis
{
  enum class Kind
  {
    Channel,
    Plane, ///< Z, the focus
    Time
  };
  Kind        kind{ Kind::Time };
  std::size_t size{ 1 };
};

/** What a file of a frame or of a stack says of itself, after it was found to be whole. */
struct FrameFile
{
  std::string name{};
  /** What it is by its contents, a line of FrameFormats(); never null after InspectFrameFile(). */
  const FrameFormat * format{ nullptr };
  std::size_t         width{ 0 };  // [pixels]
  std::size_t         height{ 0 }; // [pixels]
  std::size_t         frames{ 0 }; // 1 where the file is a single frame
  FramePixel          pixel{ FramePixel::UnsignedChar };
  StoredNumber        stored{ StoredNumber::SameAsPixel };
  std::uint64_t       bytes{ 0 }; // of its pixels as they are read; StoredBytesOf(): as they are in the file

  /** Of a PNG whose sBIT chunk says that fewer bits than it has are significant: their number, else 0. ITK shifts such
   * codes down by the others, which are 0 (or the file is refused): shifted up again they are what the file holds. */
  unsigned significantBits{ 0 };

  /** The axes of its frames, the fastest first, where the file says that they differ in more than time: their sizes,
   * each above 1, multiply to `frames`. Empty: time alone. ChooseFrames() takes those of one channel and plane. */
  std::vector<FrameAxis> axes{};

  CameraSettings camera{};  // what it says of it
  std::string    warning{}; // what is odd about the file and no error, without its name; empty: nothing

  /** Reads its pixels; null: ITK does, by the class that `format` names. */
  std::shared_ptr<const FrameReader> reader{};
  std::array<double, 2>              spacing{ { 1.0, 1.0 } }; // along x and y [mm], of files with a `reader`

  std::vector<FileIdentity> identities{}; // of the file, then of its data files, each once
};

/** The size in bytes of a pixel. */
SensorNoise_EXPORT std::size_t
SizeOf(FramePixel pixel);

/** The pixel's type, as C++ calls it. */
SensorNoise_EXPORT std::string
NameOf(FramePixel pixel);

/** Called with what a file says of itself before its compressed pixels are inflated; `frames` and `bytes` are those
 * known so far, which grow page by page in a TIFF. May throw, where they are too many to go on. */
using BeforeInflating = std::function<void(const FrameFile &)>;

/** Reads with this library's own code what the file says of itself, and checks that it is whole, before any other
 * library opens it: the whole of its structure, all checksums that it has, and that there is exactly one value for each
 * pixel that it declares. Compressed pixels are inflated for that, and not kept; uncompressed ones are not read. Needs
 * a few MiB of memory at most. Throws FileError for all that cannot be read without conversion, or not be checked. */
SensorNoise_EXPORT FrameFile
InspectFrameFile(const std::string & name, const BeforeInflating & beforeInflating = {});

/** Throws FileError unless the file and its data files are still those, in that state, that were inspected. */
SensorNoise_EXPORT void
RequireUnchanged(const FrameFile & file);

/** Which frames of a file are those of a burst, where it holds several channels or planes (FrameFile::axes). */
struct FrameChoice
{
  std::optional<std::size_t> channel{};    ///< from 0
  std::optional<std::size_t> plane{};      ///< from 0
  bool                       all{ false }; ///< frames of any channel and plane, one after the other
};

/** Reduces the frames of the file to those of one channel and one plane, in time order. Throws FileError that names the
 * axes where there are several channels or planes and none is chosen, and where the choice is not in the file. */
SensorNoise_EXPORT void
ChooseFrames(FrameFile & file, const FrameChoice & choice);

} // namespace sensornoise

#endif
