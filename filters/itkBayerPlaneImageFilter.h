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
#ifndef itkBayerPlaneImageFilter_h
#define itkBayerPlaneImageFilter_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"

#include <ostream>
#include <string>

namespace itk
{

/** \class BayerPlaneImageFilter
 * \brief Extracts one colour plane of a Bayer mosaic, R, G1, G2 or B, as an image of half the width and height.
 *
 * No value is interpolated. G1 holds the green pixels in the rows of red, and G2 holds the green pixels in the rows of
 * blue. The pattern begins at the first pixel of the input's largest possible region. If the width or height is odd,
 * the last column or row is in no plane. The spacing is twice the spacing of the input along x and y, and the origin is
 * the position of the first pixel of the plane. The region of the output begins at index 0 along x and y. Further axes,
 * for example the time axis of a stack, are unchanged.
 *
 * The filter streams: it requests only the rows, columns and frames that are needed. It is threaded.
 *
 * \tparam TImage itk::Image of 2 or 3 dimensions of unsigned char, unsigned short, short, float or double.
 * \ingroup SensorNoise
 */
template <typename TImage>
class ITK_TEMPLATE_EXPORT BayerPlaneImageFilter : public ImageToImageFilter<TImage, TImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(BayerPlaneImageFilter);

  using Self = BayerPlaneImageFilter;
  using Superclass = ImageToImageFilter<TImage, TImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using RegionType = typename TImage::RegionType;

  static_assert(TImage::ImageDimension >= 2, "a mosaic has two dimensions of space");

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "BayerPlaneImageFilter";
  }

  /** Colours of the upper left 2 x 2 pixels of the input, row by row: "RGGB" (default), "GRBG", "GBRG" or "BGGR". Any
   * other name throws an ExceptionObject. */
  void
  SetPattern(const std::string & name);
  std::string
  GetPattern() const
  {
    return sensornoise::NameOf(m_Pattern);
  }

  /** Plane that is extracted: "R" (default), "G1", "G2" or "B". Any other name throws an ExceptionObject. */
  void
  SetPlane(const std::string & name);
  std::string
  GetPlane() const
  {
    return sensornoise::NameOf(m_Plane);
  }

protected:
  BayerPlaneImageFilter();
  ~BayerPlaneImageFilter() override = default;

  void
  GenerateOutputInformation() override;
  void
  GenerateInputRequestedRegion() override;
  void
  DynamicThreadedGenerateData(const RegionType & region) override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Returns the smallest region of the input that contains all pixels of the plane for a region of the output. */
  RegionType
  InputRegionOf(const RegionType & output) const;

  sensornoise::BayerPattern m_Pattern{ sensornoise::BayerPattern::RGGB };
  sensornoise::BayerPlane   m_Plane{ sensornoise::BayerPlane::R };
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT BayerPlaneImageFilter<Image<TPixel, 2>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT BayerPlaneImageFilter<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
