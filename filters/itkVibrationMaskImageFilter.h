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
 * \brief Finds the pixels whose gradient is explained by noise alone, so that vibrations do not change their variance.
 *
 * Inputs of the size of a frame: 0 mean [DN], 1 "Variance" [DN^2], 2 "ValidMask" (optional: pixels of value 0 get 0).
 * The output is 1 if 2 T |grad mean|^2 / variance is below the chi-square quantile of Level for 2 degrees of freedom,
 * else 0. A Level of 1 % gives the quantile 9.21. The output is also 0 on the border, where there is no centred
 * difference, and where the variance is 0 or NaN.
 *
 * Gradients are in DN per pixel and do not depend on the spacing. The filter streams and is threaded.
 *
 * Section 3.1 of F. Sur, M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
 *
 * \tparam TFrame Image<double, 2>, the output type of TemporalStatisticsImageFilter.
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

  /** Number of frames T from which mean and variance were computed, at least 2. Must be set. */
  itkSetMacro(NumberOfFrames, SizeValueType);
  itkGetConstMacro(NumberOfFrames, SizeValueType);

  /** Level of the test, a probability: the fraction of unmoved pixels that is left out. Default 0.01. */
  itkSetMacro(Level, double);
  itkGetConstMacro(Level, double);

  /** Resets the pipeline if an input cannot be updated. ITK would otherwise assume that the failed update is still in
   * progress, and the next Update() would return without an error and without a result. */
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

// The library instantiates this class once.
extern template class SensorNoise_EXPORT VibrationMaskImageFilter<Image<double, 2>>;

} // namespace itk

#endif
