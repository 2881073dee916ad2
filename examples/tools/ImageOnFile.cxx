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
#include "tools/ImageOnFile.h"

#include <algorithm>
#include <vector>

namespace sensornoise::tools
{
namespace
{
using ImageType = itk::Image<double, 2>;

template <typename TPixel>
void
ReadAs(const FrameList & list, double * values)
{
  std::vector<TPixel> pixels(list.width * list.height);
  ReadFrames(list, 0, 1, pixels.data());
  std::copy(pixels.begin(), pixels.end(), values);
}
} // namespace

itk::Image<double, 2>::Pointer
ReadImage(const FrameList & list)
{
  const auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType{ { list.width, list.height } });
  image->Allocate();
  double * const values = image->GetBufferPointer();
  switch (list.pixel)
  {
    case FramePixel::UnsignedChar:
      ReadAs<unsigned char>(list, values);
      break;
    case FramePixel::UnsignedShort:
      ReadAs<unsigned short>(list, values);
      break;
    case FramePixel::Short:
      ReadAs<short>(list, values);
      break;
    case FramePixel::Float:
      ReadAs<float>(list, values);
      break;
    default:
      ReadAs<double>(list, values);
  }
  return image;
}

} // namespace sensornoise::tools
