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
#ifndef itkSensorNoisePageMaps_h
#define itkSensorNoisePageMaps_h

#include "page/PageSections.h"

namespace itk
{

/** Returns the maps of the page of a report, which refer to the images of the mean and of the pixel use. The images
 * must outlive them. There are no maps if the sizes of the buffers differ, as after the release of the data. */
template <typename TMean, typename TPixelUse>
sensornoise::PageMaps
PageMapsOf(const TMean * mean, const TPixelUse * pixelUse)
{
  const auto size = mean->GetBufferedRegion().GetSize();
  if (pixelUse->GetBufferedRegion().GetSize() != size)
  {
    return {};
  }
  return { size[0], size[1], mean->GetBufferPointer(), pixelUse->GetBufferPointer() };
}

} // namespace itk

#endif
