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
 * \brief The pixels behind one colour of a Bayer mosaic, R, G1, G2 or B, as an image of half the width and height.
 *
 * No value is interpolated. G1 is the green in the rows of red, G2 that in the rows of blue. The pattern begins at the
 * first pixel of the input's largest possible region; of an odd width or height the last column or row is in no plane.
 * Spacing is twice the input's along x and y; the origin is where the plane's first pixel was. The output's region
 * begins at index 0 along x and y; further axes, as a stack's time, stay as they are.
 *
 * Streams: asks its input for no more than the rows, columns and frames that are needed. Threaded.
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

  /** Colours of the input's upper left 2 x 2 pixels, row by row: "RGGB" (default), "GRBG", "GBRG" or "BGGR". Any other
   * name is an ExceptionObject. */
  void
  SetPattern(const std::string & name);
  std::string
  GetPattern() const
  {
    return sensornoise::NameOf(m_Pattern);
  }

  /** The plane: "R" (default), "G1", "G2" or "B". Any other name is an ExceptionObject. */
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
  /** What of the input has the plane's pixels of an output region, from the first to the last. */
  RegionType
  InputRegionOf(const RegionType & output) const;

  sensornoise::BayerPattern m_Pattern{ sensornoise::BayerPattern::RGGB };
  sensornoise::BayerPlane   m_Plane{ sensornoise::BayerPlane::R };
};

// Instantiated once, in the library.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT BayerPlaneImageFilter<Image<TPixel, 2>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT BayerPlaneImageFilter<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
