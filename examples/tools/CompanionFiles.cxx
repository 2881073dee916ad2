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
#include "tools/CompanionFiles.h"

#include "input/ErrorText.h"
#include "input/FrameHeader.h"
#include "input/InputError.h"
#include "itkImageFileReader.h"

#include <algorithm>
#include <string>
#include <vector>

namespace sensornoise::tools
{

itk::Image<unsigned char, 2>::Pointer
ReadMask(const std::string & file, const FrameInput & input)
{
  const FrameInput header = OpenFrames({ file });
  if (header.isStack)
  {
    throw InputError("the mask " + file + " has " + std::to_string(header.frames) + " frames; expected one image");
  }
  if (header.width != input.width || header.height != input.height)
  {
    throw InputError("the mask " + file + " has " + std::to_string(header.width) + " x " +
                     std::to_string(header.height) + " pixels, but the frames have " + std::to_string(input.width) +
                     " x " + std::to_string(input.height));
  }
  // Nonzero means use, whatever the type: a double holds them all.
  auto reader = itk::ImageFileReader<itk::Image<double, 2>>::New();
  reader->SetFileName(file);
  try
  {
    reader->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    throw InputError("the mask " + PixelErrorOf(file, error));
  }
  auto mask = itk::Image<unsigned char, 2>::New();
  mask->SetRegions(reader->GetOutput()->GetLargestPossibleRegion());
  mask->Allocate();
  const double * values = reader->GetOutput()->GetBufferPointer();
  std::transform(values, values + input.width * input.height, mask->GetBufferPointer(), [](double value) {
    return value != 0.0 ? 1 : 0;
  });
  return mask;
}

FrameInput
OpenDark(const std::vector<std::string> & files, const FrameInput & input)
{
  const auto describe = [](const FrameInput & frames) {
    return SizeOf(frames.width, frames.height) + " pixels of type " + NameOf(frames.component);
  };
  FrameInput dark = OpenFrames(files);
  if (describe(dark) != describe(input))
  {
    throw InputError("the dark frames have " + describe(dark) + " (" + files.front() + "), but the frames have " +
                     describe(input));
  }
  return dark;
}

} // namespace sensornoise::tools
