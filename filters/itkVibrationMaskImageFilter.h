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
#ifndef itkVibrationMaskImageFilter_h
#define itkVibrationMaskImageFilter_h

#include "SensorNoiseExport.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"

#include <ostream>

namespace itk
{

/** \class VibrationMaskImageFilter
 * \brief Mask of the pixels whose gradient noise alone explains, so that vibrations leave their variance alone.
 *
 * Inputs, of a frame's size: 0 mean [DN], 1 "Variance" [DN^2], 2 "ValidMask" (optional: pixels of value 0 are not
 * kept). Output: 1 where 2 T |grad mean|^2 / variance is below the chi-square quantile of Level for 2 degrees of
 * freedom (1 % gives 9.21), else 0; 0 on the border, where there is no centred difference, and where the variance is 0
 * or NaN.
 *
 * Gradients are in DN per pixel: the spacing does not matter. Streams and is threaded.
 *
 * Section 3.1 of F. Sur, M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
 *
 * \tparam TFrame Image<double, 2>, as TemporalStatisticsImageFilter gives it.
 * \ingroup SensorNoise
 */
template <typename TFrame = Image<double, 2>>
class ITK_TEMPLATE_EXPORT VibrationMaskImageFilter : public ImageToImageFilter<TFrame, Image<unsigned char, 2>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(VibrationMaskImageFilter);

  using Self = VibrationMaskImageFilter;
  using MaskImageType = Image<unsigned char, 2>;
  using Superclass = ImageToImageFilter<TFrame, MaskImageType>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using FrameImageType = TFrame;
  using RegionType = typename MaskImageType::RegionType;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "VibrationMaskImageFilter";
  }

  itkSetInputMacro(Variance, FrameImageType);
  itkGetInputMacro(Variance, FrameImageType);
  itkSetInputMacro(ValidMask, MaskImageType);
  itkGetInputMacro(ValidMask, MaskImageType);

  /** Number of frames T of which mean and variance were taken, at least 2. Must be set. */
  itkSetMacro(NumberOfFrames, SizeValueType);
  itkGetConstMacro(NumberOfFrames, SizeValueType);

  /** Level of the test, a probability: the share of still pixels that is left out. Default 0.01. */
  itkSetMacro(Level, double);
  itkGetConstMacro(Level, double);

  /** Resets the pipeline when an input could not be updated: ITK would otherwise take the next Update() for one that is
   * under way and return without a word and without a result. */
  void
  UpdateOutputInformation() override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  VibrationMaskImageFilter();
  ~VibrationMaskImageFilter() override = default;

  void
  VerifyPreconditions() const override;
  void
  VerifyInputInformation() const override;
  void
  GenerateInputRequestedRegion() override;
  void
  DynamicThreadedGenerateData(const RegionType & region) override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  SizeValueType m_NumberOfFrames{ 0 };
  double        m_Level{ 0.01 };
};

// Instantiated once, in the library.
extern template class SensorNoise_EXPORT VibrationMaskImageFilter<Image<double, 2>>;

} // namespace itk

#endif
