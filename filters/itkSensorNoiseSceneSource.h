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
#ifndef itkSensorNoiseSceneSource_h
#define itkSensorNoiseSceneSource_h

#include "SensorNoiseExport.h"
#include "sensornoise/Simulator.h"
#include "itkImage.h"
#include "itkImageSource.h"
#include "itkSensorNoiseErrors.h"

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace itk
{

/** \class SensorNoiseSceneSource
 * \brief Draws a reference image for SensorNoiseStackSource: values from 0 to 1.
 *
 * There are four scenes. "target" has 4 x 4 uniform patches (MakeTargetScene). "bars" has vertical bars, so that every
 * row holds every level (MakeBarsScene). "texture" resembles a natural image (MakeTextureScene). "flat" is 1 everywhere
 * (MakeFlatScene). The same parameters give the same image.
 *
 * \tparam TOutputImage Image<double, 2>.
 * \ingroup SensorNoise
 */
template <typename TOutputImage = Image<double, 2>>
class ITK_TEMPLATE_EXPORT SensorNoiseSceneSource : public ImageSource<TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseSceneSource);

  using Self = SensorNoiseSceneSource;
  using Superclass = ImageSource<TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseSceneSource";
  }

  /** Name of the scene: "target" (default), "bars", "texture" or "flat". */
  itkSetStringMacro(Scene);
  itkGetStringMacro(Scene);

  /** Width and height of the image [pixel]. Default 512 each. The smallest sizes are 32 x 32 for a target, 16 x 1 for
   * bars, 16 x 16 for a texture and 1 x 1 for a flat. */
  itkSetMacro(Width, SizeValueType);
  itkGetConstMacro(Width, SizeValueType);
  itkSetMacro(Height, SizeValueType);
  itkGetConstMacro(Height, SizeValueType);

protected:
  SensorNoiseSceneSource() = default;
  ~SensorNoiseSceneSource() override = default;

  void
  GenerateOutputInformation() override
  {
    const typename TOutputImage::SizeType size{ { m_Width, m_Height } };
    this->GetOutput()->SetLargestPossibleRegion(typename TOutputImage::RegionType(size));
  }

  /** Enlarges the requested region to the whole image, because scenes are drawn as a whole. */
  void
  EnlargeOutputRequestedRegion(DataObject * output) override
  {
    output->SetRequestedRegionToLargestPossibleRegion();
  }

  void
  GenerateData() override
  {
    const std::vector<double> scene = WithItkErrors(this, [this] {
      return m_Scene == "target"    ? sensornoise::MakeTargetScene(m_Width, m_Height)
             : m_Scene == "bars"    ? sensornoise::MakeBarsScene(m_Width, m_Height)
             : m_Scene == "texture" ? sensornoise::MakeTextureScene(m_Width, m_Height)
             : m_Scene == "flat"    ? sensornoise::MakeFlatScene(m_Width, m_Height)
                                    : std::vector<double>();
    });
    if (scene.empty())
    {
      itkExceptionMacro("the scene is \"" << m_Scene << "\"; expected target, bars, texture or flat");
    }
    this->AllocateOutputs();
    std::copy(scene.begin(), scene.end(), this->GetOutput()->GetBufferPointer());
  }

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "Scene: " << m_Scene << std::endl;
    os << indent << "Width: " << m_Width << std::endl;
    os << indent << "Height: " << m_Height << std::endl;
  }

private:
  std::string   m_Scene{ "target" };
  SizeValueType m_Width{ 512 };
  SizeValueType m_Height{ 512 };
};

// The library instantiates this class once.
extern template class SensorNoise_EXPORT SensorNoiseSceneSource<Image<double, 2>>;

} // namespace itk

#endif
