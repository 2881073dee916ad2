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
#include "itkBayerPlaneImageFilter.h"

#include "itkSensorNoiseErrors.h"
#include "itkImageScanlineIterator.h"

#include <ostream>
#include <string>

namespace itk
{

template <typename TImage>
BayerPlaneImageFilter<TImage>::BayerPlaneImageFilter()
{
  this->DynamicMultiThreadingOn();
}

template <typename TImage>
void
BayerPlaneImageFilter<TImage>::SetPattern(const std::string & name)
{
  const auto pattern = WithItkErrors(this, [&name] { return sensornoise::BayerPatternOf(name); });
  if (m_Pattern != pattern)
  {
    m_Pattern = pattern;
    this->Modified();
  }
}

template <typename TImage>
void
BayerPlaneImageFilter<TImage>::SetPlane(const std::string & name)
{
  const auto plane = WithItkErrors(this, [&name] { return sensornoise::BayerPlaneOf(name); });
  if (m_Plane != plane)
  {
    m_Plane = plane;
    this->Modified();
  }
}

template <typename TImage>
auto
BayerPlaneImageFilter<TImage>::InputRegionOf(const RegionType & output) const -> RegionType
{
  const RegionType whole = this->GetInput()->GetLargestPossibleRegion();
  const auto       corner = sensornoise::CornerOf(m_Pattern, m_Plane);
  RegionType       input = output;
  for (unsigned int axis = 0; axis < 2; ++axis)
  {
    input.SetIndex(axis, whole.GetIndex(axis) + 2 * output.GetIndex(axis) + static_cast<IndexValueType>(corner[axis]));
    input.SetSize(axis, output.GetSize(axis) == 0 ? 0 : 2 * output.GetSize(axis) - 1);
  }
  return input;
}

template <typename TImage>
void
BayerPlaneImageFilter<TImage>::GenerateOutputInformation()
{
  Superclass::GenerateOutputInformation();
  const TImage * const input = this->GetInput();
  TImage * const       output = this->GetOutput();
  RegionType           region = input->GetLargestPossibleRegion();
  auto                 spacing = input->GetSpacing();
  for (unsigned int axis = 0; axis < 2; ++axis)
  {
    if (region.GetSize(axis) < 2)
    {
      itkExceptionMacro("the mosaic has " << region.GetSize(0) << " x " << region.GetSize(1)
                                          << " pixels; expected 2 x 2 at least");
    }
    region.SetIndex(axis, 0);
    region.SetSize(axis, region.GetSize(axis) / 2);
    spacing[axis] *= 2.0;
  }
  // Index 0 of the plane is the pixel at its corner. Along the other axes the position of index 0 does not change.
  typename TImage::IndexType first = this->InputRegionOf(region).GetIndex();
  for (unsigned int axis = 2; axis < TImage::ImageDimension; ++axis)
  {
    first[axis] = 0;
  }
  typename TImage::PointType origin;
  input->TransformIndexToPhysicalPoint(first, origin);
  output->SetSpacing(spacing);
  output->SetOrigin(origin);
  output->SetLargestPossibleRegion(region);
}

template <typename TImage>
void
BayerPlaneImageFilter<TImage>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  auto * const input = const_cast<TImage *>(this->GetInput());
  input->SetRequestedRegion(this->InputRegionOf(this->GetOutput()->GetRequestedRegion()));
}

template <typename TImage>
void
BayerPlaneImageFilter<TImage>::DynamicThreadedGenerateData(const RegionType & region)
{
  const TImage * const input = this->GetInput();
  for (ImageScanlineIterator<TImage> line(this->GetOutput(), region); !line.IsAtEnd(); line.NextLine())
  {
    RegionType pixel = region;
    pixel.SetIndex(line.GetIndex());
    const auto * from = input->GetBufferPointer() + input->ComputeOffset(this->InputRegionOf(pixel).GetIndex());
    for (; !line.IsAtEndOfLine(); ++line, from += 2)
    {
      line.Set(*from);
    }
  }
}

template <typename TImage>
void
BayerPlaneImageFilter<TImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Pattern: " << this->GetPattern() << std::endl;
  os << indent << "Plane: " << this->GetPlane() << std::endl;
}

#define SensorNoise_INSTANTIATE(TPixel) template class BayerPlaneImageFilter<Image<TPixel, 2>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE
#define SensorNoise_INSTANTIATE(TPixel) template class BayerPlaneImageFilter<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
