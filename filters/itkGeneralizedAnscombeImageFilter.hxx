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
#ifndef itkGeneralizedAnscombeImageFilter_hxx
#define itkGeneralizedAnscombeImageFilter_hxx

#include <cstddef>
#include <ostream>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
void
GeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::BeforeThreadedGenerateData()
{
  m_NumberOfNegativeArguments = m_IsNewUpdate ? 0 : m_NumberOfNegativeArguments.load();
  m_IsNewUpdate = false;
}

template <typename TInputImage, typename TOutputImage>
void
GeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::DynamicThreadedGenerateData(const RegionType & region)
{
  m_NumberOfNegativeArguments +=
    this->TransformRows(region, [](const auto & transform, const auto * input, std::size_t size, auto * output) {
      return transform.Stabilise(input, size, output);
    });
}

template <typename TInputImage, typename TOutputImage>
void
GeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::UpdateOutputInformation()
{
  m_IsNewUpdate = true;
  Superclass::UpdateOutputInformation();
}

template <typename TInputImage, typename TOutputImage>
void
GeneralizedAnscombeImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfNegativeArguments: " << m_NumberOfNegativeArguments << std::endl;
}

} // namespace itk

#endif
