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
#ifndef itkInverseGeneralizedAnscombeImageFilter_h
#define itkInverseGeneralizedAnscombeImageFilter_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/NoiseModel.h"
#include "itkImage.h"
#include "itkSensorNoiseStabiliser.h"

#include <atomic>
#include <ostream>
#include <string>

namespace itk
{

/** \class InverseGeneralizedAnscombeImageFilter
 * \brief Transforms stabilised values, denoised or averaged, back to grey values.
 *
 * The default is the closed-form approximation of the exact unbiased inverse, for denoised or averaged values. The root
 * is concave, and the algebraic inverse of a mean is therefore too low. The deviation of the approximation from the
 * exact inverse was found by numerical integration for 0 to 10,000 electrons and a read noise of 0 to 30. It is at most
 * 0.05 electrons in the dark, 0.02 from 3 electrons on, and 0.002 at 10,000. SetInverse() selects the algebraic
 * inverse, for single values, or the asymptotic inverse.
 *
 * Input: stabilised values [1], float or double; negative values are treated as 0. Output: grey values [DN], of
 * unsigned char, unsigned short, short, float or double. Integers are rounded to the nearest (half up) and clamped to
 * the range of their type. The lowest output is the zero level -b/a of the model; with the algebraic inverse it is 3/8
 * electrons lower. NaN stays NaN. If the output is integer, NaN is an error that gives the number of NaN pixels.
 *
 * The images have any dimension. The filter streams and is threaded. It computes in double. The result has the same
 * bits for any number of threads and any region.
 *
 * M. M\"akitalo, A. Foi, Optimal inversion of the generalized Anscombe transformation for Poisson-Gaussian noise, IEEE
 * Trans. Image Process. 22(1), 2013, https://doi.org/10.1109/TIP.2012.2202675.
 *
 * \tparam TInputImage image of stabilised values.
 * \tparam TOutputImage image of the same dimension.
 * \ingroup SensorNoise
 */
template <typename TInputImage, typename TOutputImage = TInputImage>
class ITK_TEMPLATE_EXPORT InverseGeneralizedAnscombeImageFilter
  : public SensorNoiseStabiliser<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(InverseGeneralizedAnscombeImageFilter);

  using Self = InverseGeneralizedAnscombeImageFilter;
  using Superclass = SensorNoiseStabiliser<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using typename Superclass::RegionType;
  using InverseEnum = sensornoise::AnscombeInverse;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "InverseGeneralizedAnscombeImageFilter";
  }

  /** Inverse that is applied: ExactUnbiased (default), Algebraic or Asymptotic. */
  void
  SetInverse(InverseEnum inverse);
  /** Name of the inverse: "exact-unbiased", "algebraic" or "asymptotic". */
  void
  SetInverse(const std::string & name);
  /** Returns the inverse, as a value or by its name. */
  InverseEnum
  GetInverse() const
  {
    return m_Inverse;
  }
  std::string
  GetInverseName() const
  {
    return sensornoise::NameOf(m_Inverse);
  }

protected:
  InverseGeneralizedAnscombeImageFilter() = default;
  ~InverseGeneralizedAnscombeImageFilter() override = default;

  void
  BeforeThreadedGenerateData() override;
  void
  DynamicThreadedGenerateData(const RegionType & region) override;
  void
  AfterThreadedGenerateData() override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  InverseEnum                m_Inverse{ InverseEnum::ExactUnbiased };
  std::atomic<SizeValueType> m_NumberOfNotNumbers{ 0 };
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel)                                                                                    \
  extern template class SensorNoise_EXPORT InverseGeneralizedAnscombeImageFilter<Image<float, 2>, Image<TPixel, 2>>;  \
  extern template class SensorNoise_EXPORT InverseGeneralizedAnscombeImageFilter<Image<double, 2>, Image<TPixel, 2>>; \
  extern template class SensorNoise_EXPORT InverseGeneralizedAnscombeImageFilter<Image<float, 3>, Image<TPixel, 3>>;  \
  extern template class SensorNoise_EXPORT InverseGeneralizedAnscombeImageFilter<Image<double, 3>, Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

// For images of other dimensions.
#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkInverseGeneralizedAnscombeImageFilter.hxx"
#endif

#endif
