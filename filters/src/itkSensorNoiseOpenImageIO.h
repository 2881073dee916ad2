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

/** Returns the reader of ITK for a file that InspectFrameFile() has inspected. Its header is read, but no pixel.
 *
 * The file is given to the reader of its format alone; no other library opens it. Throws FileError if the file has
 * changed since the inspection, if the program has no reader for the format, or if ITK cannot read the header. Throws
 * FileError, too, if ITK finds another size, type or number of frames, or more than one value per pixel. */
itk::ImageIOBase::Pointer
OpenImageIO(const FrameFile & file);

/** Returns the error for pixels that an ImageIO could not read, with the cause from \a error in one sentence. */
FileError
PixelErrorOf(const std::string & file, const std::exception & error);

} // namespace sensornoise

#endif
