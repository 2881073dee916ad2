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
#ifndef itkInverseGeneralizedAnscombeImageFilter_hxx
#define itkInverseGeneralizedAnscombeImageFilter_hxx

#include "itkSensorNoiseErrors.h"

#include <cstddef>
#include <ostream>
#include <string>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
void
InverseGeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::SetInverse(InverseEnum inverse)
{
  if (m_Inverse != inverse)
  {
    m_Inverse = inverse;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
InverseGeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::SetInverse(const std::string & name)
{
  this->SetInverse(WithItkErrors(this, [&name] { return sensornoise::AnscombeInverseOf(name); }));
}

template <typename TInputImage, typename TOutputImage>
void
InverseGeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::BeforeThreadedGenerateData()
{
  m_NumberOfNotNumbers = 0;
}

template <typename TInputImage, typename TOutputImage>
void
InverseGeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::DynamicThreadedGenerateData(const RegionType & region)
{
  m_NumberOfNotNumbers +=
    this->TransformRows(region, [this](const auto & transform, const auto * input, std::size_t size, auto * output) {
      return transform.Invert(input, size, output, m_Inverse);
    });
}

template <typename TInputImage, typename TOutputImage>
void
InverseGeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::AfterThreadedGenerateData()
{
  if (m_NumberOfNotNumbers > 0)
  {
    itkExceptionMacro(<< m_NumberOfNotNumbers
                      << " stabilised value(s) are NaN, which integers cannot hold; expected "
                         "numbers, or an output of float or double");
  }
}

template <typename TInputImage, typename TOutputImage>
void
InverseGeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Inverse: " << sensornoise::NameOf(m_Inverse) << std::endl;
}

} // namespace itk

#endif
