// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_FrameFile_h
#define sensornoise_FrameFile_h

#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"

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

/** Error in a file. The message is one sentence that begins with the name of the file and says what was found and what
 * was expected. It is one line of UTF-8: other characters of the file are shown as "?". */
class SensorNoise_EXPORT FileError : public std::runtime_error
{
public:
  /** Makes the message of the name of the \a file and of \a what, the rest of the sentence. */
  FileError(const std::string & file, const std::string & what);
};

/** Identity and state of a file. While it stays equal, the file was neither replaced nor written to, within the
 * resolution of the clock of the file system. */
struct FileIdentity
{
  std::string   name{};            ///< path of the file, as it was given
  std::uint64_t device{ 0 };       ///< number of the device; 0 where the operating system has none
  std::uint64_t inode{ 0 };        ///< number of the file on its device; 0 where the operating system has none
  std::uint64_t size{ 0 };         ///< size of the contents [bytes]
  std::int64_t  modified{ 0 };     ///< last change of the contents [ns since the file system's epoch]
  std::int64_t  statusChange{ 0 }; ///< last change of contents or rights, which cannot be set back [ns]; 0: not known
};

struct FrameFormat;

/** Types of the pixels of a stack. */
enum class FramePixel
{
  UnsignedChar,
  UnsignedShort,
  Short,
  Float,
  Double
};

/** Types of the numbers in a file: the type of the pixels, or integers of 32 bits. These are read as double, which
 * represents them exactly. Integers of 64 bits are not accepted. */
enum class StoredNumber
{
  SameAsPixel, ///< the type of FrameFile::pixel
  UnsignedInt, ///< unsigned integers of 32 bits; FrameFile::pixel is Double
  Int          ///< signed integers of 32 bits; FrameFile::pixel is Double
};

/** Axis along which the frames of a file differ. */
struct FrameAxis
{
  enum class Kind
  {
    Channel,
    Plane, ///< Z, the focus
    Time
  };
  Kind        kind{ Kind::Time }; ///< quantity that changes along the axis
  std::size_t size{ 1 };          ///< number of positions along the axis, at least 1
};

/** Positions of the pixels of a stack in space, from the header of its file: along x, y and time. The default is
 * spacing 1, origin 0 and directions along the axes. The default replaces values that the file does not give or that an
 * image cannot have (a spacing of 0, a singular direction). */
struct StackGeometry
{
  std::array<double, 3>                spacing{ { 1.0, 1.0, 1.0 } }; ///< distance of neighbours, above 0 [mm]
  std::array<double, 3>                origin{ { 0.0, 0.0, 0.0 } };  ///< position of the first pixel [mm]
  std::array<std::array<double, 3>, 3> direction{
    { { { 1.0, 0.0, 0.0 } }, { { 0.0, 1.0, 0.0 } }, { { 0.0, 0.0, 1.0 } } } // columns are the axes
  };
};

/** Description of a file with a frame or a stack, as InspectFrameFile() returns it. */
struct FrameFile
{
  std::string name{}; ///< path of the file, as it was given
  /** Format of the contents, an entry of FrameFormats(); never null after InspectFrameFile(). */
  const FrameFormat * format{ nullptr };
  std::size_t         width{ 0 };                          ///< columns of a frame [pixel]
  std::size_t         height{ 0 };                         ///< rows of a frame [pixel]
  std::size_t         frames{ 0 };                         ///< number of frames; 1: a single frame
  FramePixel          pixel{ FramePixel::UnsignedChar };   ///< type of the pixels that are read
  StoredNumber        stored{ StoredNumber::SameAsPixel }; ///< type of the numbers in the file
  std::uint64_t       bytes{ 0 };                          ///< size of all pixels after reading [bytes]

  /** The axes of its frames, the fastest first, where the file says that they differ in more than time: their sizes,
   * each above 1, multiply to `frames`. Empty: time alone. ChooseFrames() takes the frames of one channel and plane. */
  std::vector<FrameAxis> axes{};

  CameraSettings camera{};  ///< settings of the camera that the file records
  std::string    warning{}; ///< an oddity of the file that is no error, without the name of the file; "": none

  /** Reader of the pixels; never null after InspectFrameFile(). */
  std::shared_ptr<const FrameReader> reader{};
  StackGeometry                      geometry{}; ///< positions of the pixels, as the header gives them

  std::vector<FileIdentity> identities{}; ///< identity of the file, then of each of its data files
};

/** Returns the size of a pixel [bytes]. */
SensorNoise_EXPORT std::size_t
SizeOf(FramePixel pixel);

/** Returns the name of the pixel type in C++, for example "unsigned short". */
SensorNoise_EXPORT std::string
NameOf(FramePixel pixel);

/** Function that is called with the description of a file before its compressed pixels are inflated. `frames` and
 * `bytes` are the numbers known so far; in a TIFF they grow page by page. The function may throw if they are too large.
 */
using BeforeInflating = std::function<void(const FrameFile &)>;

/** Reads the description of a file with the code of this library alone, before any other library opens the file. Checks
 * the whole structure, all checksums, and that there is exactly one value for each declared pixel. Compressed pixels
 * are inflated for this check, and not kept. Uncompressed pixels are not read. Needs a few MiB of memory at most.
 * Throws FileError for a file that is not whole, cannot be checked, or cannot be read without conversion. */
SensorNoise_EXPORT FrameFile
InspectFrameFile(const std::string & name, const BeforeInflating & beforeInflating = {});

/** Throws FileError if the file or one of its data files was replaced or changed after its inspection. */
SensorNoise_EXPORT void
RequireUnchanged(const FrameFile & file);

/** Choice of the frames of a burst in a file with several channels or planes (FrameFile::axes). */
struct FrameChoice
{
  std::optional<std::size_t> channel{};    ///< number of the channel, from 0; null: not chosen
  std::optional<std::size_t> plane{};      ///< number of the plane, from 0; null: not chosen
  bool                       all{ false }; ///< true: the frames of all channels and planes, in the order of the file
};

/** Reduces the frames of the file to the frames of one channel and one plane, in time order. Throws FileError if there
 * are several channels or planes and none is chosen, or if the choice is not in the file. The message names the axes.
 */
SensorNoise_EXPORT void
ChooseFrames(FrameFile & file, const FrameChoice & choice);

} // namespace sensornoise

#endif
