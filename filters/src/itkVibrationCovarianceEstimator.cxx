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
#include "itkVibrationCovarianceEstimator.h"

#include "itkSensorNoiseErrors.h"
#include "published/PublishedScene.h"

#include <ostream>

namespace itk
{

template <typename TFrame>
VibrationCovarianceEstimator<TFrame>::VibrationCovarianceEstimator()
{
  this->SetPrimaryInputName("Mean");
  this->AddRequiredInputName("Variance", 1);
  this->AddOptionalInputName("ValidMask", 2);
  this->SetNumberOfRequiredOutputs(1);
  this->ProcessObject::SetNthOutput(0, this->MakeOutput(0));
}

template <typename TFrame>
void
VibrationCovarianceEstimator<TFrame>::GenerateData()
{
  const FrameImageType * mean = this->GetMean();
  const MaskImageType *  mask = this->GetValidMask();
  const auto             region = mean->GetLargestPossibleRegion();
  if (this->GetVariance()->GetLargestPossibleRegion() != region ||
      (mask != nullptr && mask->GetLargestPossibleRegion() != region))
  {
    itkExceptionMacro("mean, variance and valid mask have different regions, the mean's is " << region
                                                                                             << "; expected the same");
  }
  this->GetResultOutput()->Set(sensornoise::FitVibrationCovariance(mean->GetBufferPointer(),
                                                                   this->GetVariance()->GetBufferPointer(),
                                                                   mask == nullptr ? nullptr : mask->GetBufferPointer(),
                                                                   region.GetSize(0),
                                                                   region.GetSize(1),
                                                                   m_FlickerSd));
}

template <typename TFrame>
void
VibrationCovarianceEstimator<TFrame>::UpdateOutputInformation()
{
  ResetAfterError(this, [this] { Superclass::UpdateOutputInformation(); });
}

template <typename TFrame>
void
VibrationCovarianceEstimator<TFrame>::UpdateOutputData(DataObject * output)
{
  ResetAfterError(this, [this, output] { Superclass::UpdateOutputData(output); });
}

template <typename TFrame>
void
VibrationCovarianceEstimator<TFrame>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "FlickerSd: " << m_FlickerSd << std::endl;
}

template class VibrationCovarianceEstimator<Image<double, 2>>;

} // namespace itk
