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
#include "sensornoise/Report.h"
#include "sensornoise/NoiseModel.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"
#include "itkSensorNoiseResult.h"

#include <atomic>
#include <limits>
#include <ostream>
#include <string>

namespace itk
{

/** \class InverseGeneralizedAnscombeImageFilter
 * \brief Leads from stabilised values, denoised or averaged, back to levels.
 *
 * By default the closed-form approximation of the exact unbiased inverse, for what was denoised or averaged: the root
 * is concave, and the algebraic inverse of a mean therefore too low. Its departure from the exact inverse, found by
 * numerical integration for 0 to 10,000 electrons and a read noise of 0 to 30: at most 0.05 electrons in the dark, 0.02
 * from 3 electrons on, 0.002 at 10,000. SetInverse() gives the algebraic one, for single values, and the asymptotic
 * one.
 *
 * Input: stabilised values [1], float or double; negative ones count as 0. Output: levels [DN], of unsigned char,
 * unsigned short, short, float or double. Integers are rounded to the nearest (half up) and kept within the range of
 * the type; the lowest level is the zero level -b/a of the model, 3/8 electrons lower with the algebraic inverse. NaN
 * stays NaN; for integers it is an error that says how many pixels are NaN.
 *
 * Any dimension. Streams and is threaded. Computed in double; the same bits for any number of threads and any region.
 *
 * M. M\"akitalo, A. Foi, Optimal inversion of the generalized Anscombe transformation for Poisson-Gaussian noise,
 * IEEE Trans. Image Process. 22(1), 2013, https://doi.org/10.1109/TIP.2012.2202675.
 *
 * \tparam TInputImage image of stabilised values.
 * \tparam TOutputImage image of the same dimension.
 * \ingroup SensorNoise
 */
template <typename TInputImage, typename TOutputImage = TInputImage>
class ITK_TEMPLATE_EXPORT InverseGeneralizedAnscombeImageFilter : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(InverseGeneralizedAnscombeImageFilter);

  using Self = InverseGeneralizedAnscombeImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using RegionType = typename TOutputImage::RegionType;
  using InverseEnum = sensornoise::AnscombeInverse;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "InverseGeneralizedAnscombeImageFilter";
  }

  /** The noise model: `variance_slope` a [DN/e-], above 0, and `total_intercept` b [DN^2], of either sign, of a report.
   * Both must be set, here or by SetReport(). */
  itkSetMacro(VarianceSlope, double);
  itkGetConstMacro(VarianceSlope, double);
  itkSetMacro(TotalIntercept, double);
  itkGetConstMacro(TotalIntercept, double);

  /** Takes both from a report, as SensorNoiseEstimator::GetReport() or GetReportOutput() give it. Throws
   * ExceptionObject where one of them has no value, or the slope is not above 0; nothing else of the report is asked
   * for. */
  void
  SetReport(const sensornoise::Report & report);
  void
  SetReport(const SensorNoiseResult<sensornoise::Report> * report);

  /** Which inverse: ExactUnbiased (default), Algebraic or Asymptotic. */
  void
  SetInverse(InverseEnum inverse);
  /** The same by name: "exact-unbiased", "algebraic" or "asymptotic". */
  void
  SetInverse(const std::string & name);
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

  /** Resets the pipeline when an input could not be updated: ITK would otherwise take the next Update() for one that is
   * under way and return without a word and without a result. */
  void
  UpdateOutputInformation() override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  InverseGeneralizedAnscombeImageFilter();
  ~InverseGeneralizedAnscombeImageFilter() override = default;

  void
  VerifyPreconditions() const override;
  void
  BeforeThreadedGenerateData() override;
  void
  DynamicThreadedGenerateData(const RegionType & region) override;
  void
  AfterThreadedGenerateData() override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  double                     m_VarianceSlope{ 0.0 };
  double                     m_TotalIntercept{ std::numeric_limits<double>::quiet_NaN() };
  InverseEnum                m_Inverse{ InverseEnum::ExactUnbiased };
  std::atomic<SizeValueType> m_NumberOfNotNumbers{ 0 };
};

// Instantiated once, in the library.
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
