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
#ifndef FrameReader_h
#define FrameReader_h

#include "input/FrameInput.h"

#include "itkImage.h"
#include "itkImageSource.h"

namespace sensornoise::tools
{

/** The source of the stack (x, y, time). TPixel must be the component type of the files: nothing is converted.
 * Streams where the files allow it, and throws if a file has changed since OpenFrames(). */
template <typename TPixel>
typename itk::ImageSource<itk::Image<TPixel, 3>>::Pointer
MakeReader(const FrameInput & input);

extern template itk::ImageSource<itk::Image<unsigned char, 3>>::Pointer
MakeReader<unsigned char>(const FrameInput &);
extern template itk::ImageSource<itk::Image<unsigned short, 3>>::Pointer
MakeReader<unsigned short>(const FrameInput &);
extern template itk::ImageSource<itk::Image<short, 3>>::Pointer
MakeReader<short>(const FrameInput &);
extern template itk::ImageSource<itk::Image<float, 3>>::Pointer
MakeReader<float>(const FrameInput &);
extern template itk::ImageSource<itk::Image<double, 3>>::Pointer
MakeReader<double>(const FrameInput &);

} // namespace sensornoise::tools

#endif
