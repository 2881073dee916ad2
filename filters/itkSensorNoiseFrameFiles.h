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

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** Positions of the pixels of a stack in space. For a list of frames, the header of the first file gives x and y. */
using FrameListGeometry = StackGeometry;

/** Frames in files, in time order: stacks, or one frame in each file. All headers have been checked. */
struct SensorNoise_EXPORT FrameList
{
  std::vector<FrameFile> files;
  bool                   isStack{ false }; // one stack, or several stacks in time order
  FramePixel             pixel{ FramePixel::UnsignedShort };
  std::size_t            width{ 0 };  // pixels
  std::size_t            height{ 0 }; // pixels
  std::size_t            frames{ 0 };
  std::uint64_t          bytes{ 0 }; // bytes of the pixels of all frames, uncompressed
  FrameListGeometry      geometry;
  CameraSettings         camera; // settings of the camera, from the first file

  std::vector<std::string>
  Names() const;
};

/** Checks every file (InspectFrameFile()). No pixel is kept.
 *
 * Each file must be a complete image with one grey value of type unsigned char, unsigned short, short, float or double
 * for each pixel. All files must have the same size and type. A 3-D file is a stack. Several stacks are one burst, in
 * the given order. A list of frames holds 2-D files, or 3-D files of one slice, and no stack. The formats are the list
 * of FrameFormats(). A program has to register no ImageIO.
 *
 * The function \a beforeInflating is called for each compressed file before the file is inflated. The text \a rawLayout
 * is the layout of the frames in files without a header. ReadRawLayout() describes it, and throws if the text is not a
 * layout. An empty text means that the files give their layout. The parameter \a choice is the channel and the plane if
 * files have several, see ChooseFrames().
 *
 * Throws std::invalid_argument if \a names is empty, and FileError if a file does not meet the conditions above. */
SensorNoise_EXPORT FrameList
OpenFrames(const std::vector<std::string> & names,
           const BeforeInflating &          beforeInflating = {},
           const std::string &              rawLayout = {},
           const FrameChoice &              choice = {});

/** Reads \a count consecutive frames, beginning with the frame \a first, without conversion. The \a buffer has room for
 * width x height x count pixels of the type of the list.
 *
 * Throws FileError if a file has changed since OpenFrames(), before or during the reading, or if its pixels cannot be
 * read. */
SensorNoise_EXPORT void
ReadFrames(const FrameList & list, std::size_t first, std::size_t count, void * buffer);

/** Returns a warning about the files, as one sentence, or an empty text. It reports a file that is listed twice, under
 * any names, or the first FrameFile::warning. These are not errors. */
SensorNoise_EXPORT std::string
WarningOf(const FrameList & list);

/** Returns a description of the frames, for example "640 x 480 pixels of type unsigned short". */
SensorNoise_EXPORT std::string
DescribeFrame(const FrameList & list);

} // namespace sensornoise

#endif
