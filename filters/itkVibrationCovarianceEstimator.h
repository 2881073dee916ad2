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
 * \brief Covariance of the vibration (alpha_t, beta_t) from temporal variance and mean, by multiple regression.
 *
 * Inputs, of a frame's size: 0 "Mean" [DN], 1 "Variance" [DN^2], both of the stack as it is, 2 "ValidMask" (optional:
 * pixels of value 0 are left out; clipped ones should be, those moved by vibrations not; without it, all finite pixels
 * take part). Output: a decorated sensornoise::VibrationCovariance [pixel^2], with sigma_gamma^2 as the regression sees
 * it.
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
  /** The mean, by the name that filters use. */
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

  /** sigma_gamma where it is known from the flicker itself [1], at least 0; below 0 (default): the regression's own. */
  itkSetMacro(FlickerSd, double);
  itkGetConstMacro(FlickerSd, double);

  /** The result as a pipeline output, and itself; valid after Update(). */
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
  /** Its members one by one: Cov(alpha, beta) [pixel^2], sigma_gamma^2 [1], and whether they are determined. */
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
  double
  GetFlickerVariance() const
  {
    return this->GetResult().flickerVariance;
  }
  bool
  GetIsDetermined() const
  {
    return this->GetResult().isDetermined;
  }
  DataObject *
  GetOutput(unsigned int index)
  {
    return this->ProcessObject::GetOutput(index);
  }

  /** Resets the pipeline when an input could not be updated: ITK would otherwise take the next Update() for one that is
   * under way and return without a word and without a result. */
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

// Instantiated once, in the library.
extern template class SensorNoise_EXPORT VibrationCovarianceEstimator<Image<double, 2>>;

} // namespace itk

#endif
