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
#ifndef itkSensorNoiseMapContainer_h
#define itkSensorNoiseMapContainer_h

#include "itkImportImageContainer.h"
#include "itkIntTypes.h"
#include "itkMacro.h"
#include "itkObjectFactory.h"

#include <utility>
#include <vector>

namespace itk
{

/** \class SensorNoiseMapContainer
 * \brief Container of the pixels of an image that owns a vector of pixels, without a copy.
 * \ingroup SensorNoise
 */
template <typename TElement>
class SensorNoiseMapContainer : public ImportImageContainer<SizeValueType, TElement>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseMapContainer);

  using Self = SensorNoiseMapContainer;
  using Superclass = ImportImageContainer<SizeValueType, TElement>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseMapContainer";
  }

  void
  TakeOver(std::vector<TElement> && values)
  {
    m_Values = std::move(values);
    this->SetImportPointer(m_Values.data(), static_cast<SizeValueType>(m_Values.size()), false);
  }

protected:
  SensorNoiseMapContainer() = default;
  ~SensorNoiseMapContainer() override = default;

private:
  std::vector<TElement> m_Values;
};

/** Moves \a values, the pixels of the largest possible region of \a image, into the image. */
template <typename TImage>
void
GiveToImage(TImage * image, std::vector<typename TImage::PixelType> && values)
{
  const auto pixels = SensorNoiseMapContainer<typename TImage::PixelType>::New();
  pixels->TakeOver(std::move(values));
  image->SetBufferedRegion(image->GetLargestPossibleRegion());
  image->SetPixelContainer(pixels);
}

} // namespace itk

#endif
