/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef itkSensorNoiseFrameFiles_h
#define itkSensorNoiseFrameFiles_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameFile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** Where the pixels of a stack stand in space, as its file says; of a list, as its first file says of x and y. Where a
 * file gives none, or one that ITK's images cannot have (a spacing of 0, a singular direction): 1, 0, along the axes.
 */
struct FrameListGeometry
{
  std::array<double, 3>                spacing{ { 1.0, 1.0, 1.0 } };
  std::array<double, 3>                origin{ { 0.0, 0.0, 0.0 } };
  std::array<std::array<double, 3>, 3> direction{
    { { { 1.0, 0.0, 0.0 } }, { { 0.0, 1.0, 0.0 } }, { { 0.0, 0.0, 1.0 } } }
  };
};

/** Frames on files in time order, whose headers have all been checked: stacks, or one frame a file. */
struct FrameList
{
  std::vector<FrameFile> files;
  bool                   isStack{ false }; // a stack, or several that follow each other in time
  FramePixel             pixel{ FramePixel::UnsignedShort };
  std::size_t            width{ 0 };  // pixels
  std::size_t            height{ 0 }; // pixels
  std::size_t            frames{ 0 };
  bool                   streams{ false }; // can be read a few frames at a time
  std::uint64_t          bytes{ 0 };       // of the pixels of all frames, uncompressed
  FrameListGeometry      geometry;
  CameraSettings         camera; // as the first file says

  std::vector<std::string>
  Names() const;
};

/** Checks every file (InspectFrameFile()), then has ITK open it, and requires that ITK says the same. No pixel is kept.
 *
 * Throws std::invalid_argument without a file, and FileError unless each file is a complete image of one grey value of
 * type unsigned char, unsigned short, short, float or double a pixel, and all have the same size and type. A 3-D file
 * is a stack; several stacks are one burst, in the order given. A list of frames holds 2-D files, or 3-D files of one
 * slice, and no stack. Formats are those of FrameFormats(), as far as the
 * program has registered their ImageIO. \a beforeInflating is asked about each compressed file before it is
 * inflated. \a rawLayout: how frames lie in files without a header, see ReadRawLayout(), which throws for what is none;
 * empty: the files say so. \a choice: the channel and the plane, where files have several, see ChooseFrames(). */
SensorNoise_EXPORT FrameList
OpenFrames(const std::vector<std::string> & names,
           const BeforeInflating &          beforeInflating = {},
           const std::string &              rawLayout = {},
           const FrameChoice &              choice = {});

/** Reads \a count frames from the frame \a first on, one after the other, without conversion: \a buffer has room for
 * width x height x count pixels of the list's type. Of stacks that do not stream only all frames can be read.
 *
 * Throws FileError if a file has changed since OpenFrames(), before or while it is read, and where its pixels cannot be
 * read. */
SensorNoise_EXPORT void
ReadFrames(const FrameList & list, std::size_t first, std::size_t count, void * buffer);

/** Returns a sentence on what is odd about the files and no error, or nothing: a file that is there twice, by any
 * names, or the first FrameFile::warning. */
SensorNoise_EXPORT std::string
WarningOf(const FrameList & list);

/** "640 x 480 pixels of type unsigned short" */
SensorNoise_EXPORT std::string
DescribeFrame(const FrameList & list);

} // namespace sensornoise

#endif
