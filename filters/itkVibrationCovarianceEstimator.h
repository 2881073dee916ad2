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
#ifndef itkVibrationCovarianceEstimator_h
#define itkVibrationCovarianceEstimator_h

#include "SensorNoiseExport.h"
#include "sensornoise/StepResults.h"
#include "itkImage.h"
#include "itkProcessObject.h"
#include "itkSensorNoiseResult.h"

#include <ostream>

namespace itk
{

/** \class VibrationCovarianceEstimator
 * \brief Estimates the covariance of the vibration (alpha_t, beta_t) from temporal variance and mean, by regression.
 *
 * Inputs of the size of a frame: 0 "Mean" [DN] and 1 "Variance" [DN^2], both of the uncorrected stack, and 2
 * "ValidMask" (optional). Pixels whose mask is 0 are left out. Clipped pixels should be left out, but pixels that
 * vibrations move should not. Without a mask all finite pixels are used. The output is a decorated
 * sensornoise::VibrationCovariance [pixel^2], with the sigma_gamma^2 that the multiple regression estimates.
 *
 * (2.20) and section 3.4 of F. Sur, M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
 *
 * \tparam TFrame Image<double, 2>.
 * \ingroup SensorNoise
 */
template <typename TFrame = Image<double, 2>>
class ITK_TEMPLATE_EXPORT VibrationCovarianceEstimator : public ProcessObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(VibrationCovarianceEstimator);

  using Self = VibrationCovarianceEstimator;
  using Superclass = ProcessObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using FrameImageType = TFrame;
  using MaskImageType = Image<unsigned char, 2>;
  using ResultObjectType = SensorNoiseResult<sensornoise::VibrationCovariance>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "VibrationCovarianceEstimator";
  }

  using Superclass::SetInput;
  /** Sets the mean, by the name that filters use. */
  void
  SetInput(const FrameImageType * mean)
  {
    this->SetMean(mean);
  }

  itkSetInputMacro(Mean, FrameImageType);
  itkGetInputMacro(Mean, FrameImageType);
  itkSetInputMacro(Variance, FrameImageType);
  itkGetInputMacro(Variance, FrameImageType);
  itkSetInputMacro(ValidMask, MaskImageType);
  itkGetInputMacro(ValidMask, MaskImageType);

  /** Standard deviation of the flicker, sigma_gamma [1], if it is known from the flicker itself; 0 or more. Any value
   * below 0 (default) means that the regression estimates it. */
  itkSetMacro(FlickerSd, double);
  itkGetConstMacro(FlickerSd, double);

  /** Returns the result, as a pipeline output or as a struct. Valid after Update(). */
  ResultObjectType *
  GetResultOutput()
  {
    return static_cast<ResultObjectType *>(this->ProcessObject::GetOutput(0));
  }
  const sensornoise::VibrationCovariance &
  GetResult() const
  {
    return static_cast<const ResultObjectType *>(this->ProcessObject::GetOutput(0))->Get();
  }
  /** Returns an element of the covariance matrix Cov(alpha, beta) [pixel^2]. A negative variance along x means that no
   * vibration is visible. */
  double
  GetVarianceX() const
  {
    return this->GetResult().varianceXPixels2;
  }
  double
  GetVarianceY() const
  {
    return this->GetResult().varianceYPixels2;
  }
  double
  GetCovariance() const
  {
    return this->GetResult().covariancePixels2;
  }
  /** Returns sigma_gamma^2, the variance of the flicker [1]. */
  double
  GetFlickerVariance() const
  {
    return this->GetResult().flickerVariance;
  }
  /** Returns whether the data determine the result. They do not if there are too few pixels or the scene has no
   * gradients. */
  bool
  GetIsDetermined() const
  {
    return this->GetResult().isDetermined;
  }
  /** Returns an output by its index. */
  DataObject *
  GetOutput(unsigned int index)
  {
    return this->ProcessObject::GetOutput(index);
  }

  /** Resets the pipeline if an input cannot be updated. ITK would otherwise assume that the failed update is still in
   * progress, and the next Update() would return without an error and without a result. */
  void
  UpdateOutputInformation() override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  VibrationCovarianceEstimator();
  ~VibrationCovarianceEstimator() override = default;

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(DataObjectPointerArraySizeType) override
  {
    return ResultObjectType::New().GetPointer();
  }
  void
  GenerateData() override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  double m_FlickerSd{ -1.0 };
};

// The library instantiates this class once.
extern template class SensorNoise_EXPORT VibrationCovarianceEstimator<Image<double, 2>>;

} // namespace itk

#endif
