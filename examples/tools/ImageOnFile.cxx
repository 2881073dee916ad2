// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ImageOnFile.h"

#include "files/FrameReader.h"

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
  CallWithPixelType(list.pixel, [&](auto pixel) { return ReadAs<decltype(pixel)>(list, values); });
  return image;
}

} // namespace sensornoise::tools
