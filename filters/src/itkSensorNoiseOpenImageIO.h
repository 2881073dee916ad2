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
#ifndef itkSensorNoiseOpenImageIO_h
#define itkSensorNoiseOpenImageIO_h

#include "sensornoise/FrameFile.h"
#include "itkImageIOBase.h"

#include <exception>
#include <string>

namespace sensornoise
{

/** ITK's reader of a file that InspectFrameFile() has found good, its header read, no pixel.
 *
 * A file of a known format is given to the reader of that format alone, no other library looks at it. Throws FileError
 * where the file has changed since, where the program has no reader for it, where ITK cannot read its header, and
 * unless it has one grey value of a supported type a pixel and, if its format is known, the size and type found before.
 */
itk::ImageIOBase::Pointer
OpenImageIO(const FrameFile & file);

/** One sentence about pixels that an ImageIO could not read, from an error of ITK or another one. */
FileError
PixelErrorOf(const std::string & file, const std::exception & error);

} // namespace sensornoise

#endif
