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
#ifndef itkGeneralizedAnscombeImageFilter_h
#define itkGeneralizedAnscombeImageFilter_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "itkImage.h"
#include "itkSensorNoiseStabiliser.h"

#include <atomic>
#include <ostream>

namespace itk
{

/** \class GeneralizedAnscombeImageFilter
 * \brief Transforms noise whose variance grows with the signal to noise of variance 1, for denoisers of Gaussian noise.
 *
 *   f(x) = (2/a) sqrt(max(0, a x + 3/8 a^2 + b)),
 *
 * where a is the slope and b the intercept of the variance against the mean, as SensorNoiseEstimator reports them. The
 * variance of f is 1 within 0.02 above 10 electrons. It falls to 0 in the dark if the sensor has no read noise.
 * InverseGeneralizedAnscombeImageFilter is the inverse.
 *
 * Input: grey values [DN], of unsigned char, unsigned short, short, float or double. Output: f [1], float or double. If
 * the argument of the root is negative, f is 0 and the pixel is counted. NaN stays NaN and is not counted.
 *
 * The images have any dimension, because each pixel is transformed by itself. The filter streams and is threaded. It
 * computes in double. The result has the same bits for any number of threads and any region.
 *
 * F. Murtagh, J.-L. Starck, A. Bijaoui, Image restoration with noise suppression using a multiresolution support,
 * Astron. Astrophys. Suppl. Ser. 112, 1995.
 *
 * \tparam TInputImage image of grey values.
 * \tparam TOutputImage image of the same dimension.
 * \ingroup SensorNoise
 */
template <typename TInputImage, typename TOutputImage = Image<float, TInputImage::ImageDimension>>
class ITK_TEMPLATE_EXPORT GeneralizedAnscombeImageFilter : public SensorNoiseStabiliser<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(GeneralizedAnscombeImageFilter);

  using Self = GeneralizedAnscombeImageFilter;
  using Superclass = SensorNoiseStabiliser<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using typename Superclass::RegionType;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "GeneralizedAnscombeImageFilter";
  }

  /** Returns the number of pixels whose argument of the root was negative and whose output is 0. It counts all regions
   * that the last Update() computed; a region that was computed several times is counted each time. A large number
   * means that the noise model belongs to another camera or setting. */
  SizeValueType
  GetNumberOfNegativeArguments() const
  {
    return m_NumberOfNegativeArguments;
  }

  /** Begins to count anew. \see SensorNoiseStabiliser::UpdateOutputInformation */
  void
  UpdateOutputInformation() override;

protected:
  GeneralizedAnscombeImageFilter() = default;
  ~GeneralizedAnscombeImageFilter() override = default;

  void
  BeforeThreadedGenerateData() override;
  void
  DynamicThreadedGenerateData(const RegionType & region) override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  std::atomic<SizeValueType> m_NumberOfNegativeArguments{ 0 };
  bool                       m_IsNewUpdate{ true };
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel)                                                                             \
  extern template class SensorNoise_EXPORT GeneralizedAnscombeImageFilter<Image<TPixel, 2>, Image<float, 2>>;  \
  extern template class SensorNoise_EXPORT GeneralizedAnscombeImageFilter<Image<TPixel, 2>, Image<double, 2>>; \
  extern template class SensorNoise_EXPORT GeneralizedAnscombeImageFilter<Image<TPixel, 3>, Image<float, 3>>;  \
  extern template class SensorNoise_EXPORT GeneralizedAnscombeImageFilter<Image<TPixel, 3>, Image<double, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

// For images of other dimensions.
#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkGeneralizedAnscombeImageFilter.hxx"
#endif

#endif
