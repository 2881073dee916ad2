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
#include "itkVibrationMaskImageFilter.h"

#include "itkSensorNoiseErrors.h"
#include "published/PublishedScene.h"

#include <algorithm>
#include <cstddef>
#include <ostream>

namespace itk
{

template <typename TFrame>
VibrationMaskImageFilter<TFrame>::VibrationMaskImageFilter()
{
  this->AddRequiredInputName("Variance", 1);
  this->AddOptionalInputName("ValidMask", 2);
  this->DynamicMultiThreadingOn();
}

template <typename TFrame>
void
VibrationMaskImageFilter<TFrame>::VerifyPreconditions() const
{
  Superclass::VerifyPreconditions();
  if (m_NumberOfFrames < 2)
  {
    itkExceptionMacro("NumberOfFrames is " << m_NumberOfFrames << "; expected the number of frames, at least 2");
  }
  WithItkErrors(this, [this] { sensornoise::ChiSquare2Quantile(m_Level); });
}

template <typename TFrame>
void
VibrationMaskImageFilter<TFrame>::VerifyInputInformation() const
{
  const RegionType & mean = this->GetInput()->GetLargestPossibleRegion();
  const auto         verify = [this, &mean](const char * name, const ImageBase<2> * image) {
    if (image != nullptr && image->GetLargestPossibleRegion() != mean)
    {
      itkExceptionMacro("the " << name << " has the region " << image->GetLargestPossibleRegion() << "but the mean has "
                               << mean);
    }
  };
  verify("variance", this->GetVariance());
  verify("valid mask", this->GetValidMask());
}

template <typename TFrame>
void
VibrationMaskImageFilter<TFrame>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  auto *     mean = const_cast<FrameImageType *>(this->GetInput());
  RegionType region = this->GetOutput()->GetRequestedRegion();
  region.PadByRadius(1);
  region.Crop(mean->GetLargestPossibleRegion());
  mean->SetRequestedRegion(region);
}

template <typename TFrame>
void
VibrationMaskImageFilter<TFrame>::DynamicThreadedGenerateData(const RegionType & region)
{
  const FrameImageType * mean = this->GetInput();
  const FrameImageType * variance = this->GetVariance();
  const MaskImageType *  valid = this->GetValidMask();
  MaskImageType *        output = this->GetOutput();
  const RegionType &     frame = mean->GetLargestPossibleRegion();
  const double           quantile = sensornoise::ChiSquare2Quantile(m_Level);
  const auto             stride = static_cast<std::ptrdiff_t>(mean->GetBufferedRegion().GetSize(0));

  const auto lastOf = [](const RegionType & r, unsigned int axis) {
    return r.GetIndex(axis) + static_cast<IndexValueType>(r.GetSize(axis)) - 1;
  };
  for (IndexValueType y = region.GetIndex(1); y <= lastOf(region, 1); ++y)
  {
    unsigned char * const row = output->GetBufferPointer() + output->ComputeOffset({ { region.GetIndex(0), y } });
    std::fill_n(row, region.GetSize(0), static_cast<unsigned char>(0));
    const IndexValueType first = std::max(region.GetIndex(0), frame.GetIndex(0) + 1);
    const IndexValueType last = std::min(lastOf(region, 0), lastOf(frame, 0) - 1);
    if (first <= last && y > frame.GetIndex(1) && y < lastOf(frame, 1))
    {
      const Index<2> start = { { first, y } };
      sensornoise::TestVibrationOfRow(mean->GetBufferPointer() + mean->ComputeOffset(start),
                                      stride,
                                      variance->GetBufferPointer() + variance->ComputeOffset(start),
                                      valid != nullptr ? valid->GetBufferPointer() + valid->ComputeOffset(start)
                                                       : nullptr,
                                      static_cast<std::size_t>(last - first + 1),
                                      m_NumberOfFrames,
                                      quantile,
                                      row + (first - region.GetIndex(0)));
    }
  }
}

template <typename TFrame>
void
VibrationMaskImageFilter<TFrame>::UpdateOutputInformation()
{
  ResetAfterError(this, [this] { Superclass::UpdateOutputInformation(); });
}

template <typename TFrame>
void
VibrationMaskImageFilter<TFrame>::UpdateOutputData(DataObject * output)
{
  ResetAfterError(this, [this, output] { Superclass::UpdateOutputData(output); });
}

template <typename TFrame>
void
VibrationMaskImageFilter<TFrame>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfFrames: " << m_NumberOfFrames << std::endl;
  os << indent << "Level: " << m_Level << std::endl;
}

template class VibrationMaskImageFilter<Image<double, 2>>;

} // namespace itk
