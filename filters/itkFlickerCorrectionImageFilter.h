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
#ifndef itkFlickerCorrectionImageFilter_h
#define itkFlickerCorrectionImageFilter_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Settings.h"
#include "sensornoise/StepResults.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"
#include "itkSimpleDataObjectDecorator.h"

#include <ostream>
#include <string>
#include <vector>

namespace itk
{

/** \class FlickerCorrectionImageFilter
 * \brief Estimates the flicker of every frame and the sensor's offset, and takes the flicker out of the stack.
 *
 * Inputs: 0 the stack, and of a frame's size 1 "Mean" [DN], 2 "Variance" [DN^2] (of the stack itself: it gives the
 * width of the iso-intensity sets), 3 "Mask" (pixels to take the sets from: not clipped, not moved by vibrations).
 *
 * Output: the corrected stack u^ = u - (1 + gamma_t)(ubar - mu) [DN], (3.18), whose temporal mean is mu and whose
 * variance is affine in ubar, (3.24). It is not masked: the mask travels beside it. Rows whose flicker is not known
 * (rolling shutter, and the brightest pixels do not reach them) are NaN rather than extrapolated.
 *
 * Before its first output chunk the filter reads the stack once in chunks of its own for gamma_t and mu, which it keeps
 * until an input or a parameter changes. It then streams: the output's requested frames are asked for again after the
 * other inputs are up to date, so that one reader may feed the whole chain. Threaded. The same bits for any number of
 * threads and chunks.
 *
 * Sections 3.2 and 3.5 of F. Sur, M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035;
 * IsoIntensitySet tells how the sets are read. Remark 3's widening is reported by GetBrightSet() and GetDarkSet().
 *
 * \tparam TStack itk::Image of 3 dimensions (x, y, time).
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT FlickerCorrectionImageFilter : public ImageToImageFilter<TStack, Image<double, 3>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FlickerCorrectionImageFilter);

  using Self = FlickerCorrectionImageFilter;
  using CorrectedStackType = Image<double, 3>;
  using Superclass = ImageToImageFilter<TStack, CorrectedStackType>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using StackType = TStack;
  using FrameImageType = Image<double, 2>;
  using MaskImageType = Image<unsigned char, 2>;
  using RegionType = typename CorrectedStackType::RegionType;
  using RollingShutterEnum = sensornoise::RollingShutter;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "FlickerCorrectionImageFilter";
  }

  itkSetInputMacro(Mean, FrameImageType);
  itkGetInputMacro(Mean, FrameImageType);
  itkSetInputMacro(Variance, FrameImageType);
  itkGetInputMacro(Variance, FrameImageType);
  itkSetInputMacro(Mask, MaskImageType);
  itkGetInputMacro(Mask, MaskImageType);

  /** Quantiles of the mean at which the bright and the dark set lie, 0 to 1. Defaults 0.99 and 0.01. */
  itkSetMacro(BrightQuantile, double);
  itkGetConstMacro(BrightQuantile, double);
  itkSetMacro(DarkQuantile, double);
  itkGetConstMacro(DarkQuantile, double);

  /** Whether the flicker may differ from row to row: Off, Auto (default: found out, and sigma_y chosen by
   * cross-validation) or Fixed (with SigmaRows). */
  void
  SetRollingShutter(RollingShutterEnum mode);
  /** The same by name: "off", "auto" or "fixed". */
  void
  SetRollingShutter(const std::string & name);
  std::string
  GetRollingShutterName() const
  {
    return sensornoise::NameOf(m_RollingShutter);
  }
  RollingShutterEnum
  GetRollingShutter() const
  {
    return m_RollingShutter;
  }

  /** sigma_y of (3.28) for RollingShutter Fixed [rows]. Default 50, the paper's. */
  itkSetMacro(SigmaRows, double);
  itkGetConstMacro(SigmaRows, double);

  /** Axis along which the shutter travels: 1 = y (default); 0 = x, the rows are then columns of the frame. */
  itkSetMacro(ShutterAxis, unsigned int);
  itkGetConstMacro(ShutterAxis, unsigned int);

  /** Flicker, offset, K and the scatter (v^*, v_*); valid after Update(). */
  const sensornoise::FlickerEstimate &
  GetFlicker() const
  {
    return m_Flicker;
  }
  /** Its members one by one: gamma_t of every frame [1]; gamma_t(y), frame by frame, empty if one flicker serves the
   * whole frame; v^*(t) [1] and v_*(t) [DN], the scatter whose slope is K [DN]; the flicker's standard deviation [1];
   * sigma_y [rows], 0 if one flicker serves; and mu [DN] whether or not it is identified. */
  std::vector<double>
  GetGamma() const
  {
    return m_Flicker.gamma;
  }
  std::vector<double>
  GetGammaRows() const
  {
    return m_Flicker.gammaRows;
  }
  std::vector<double>
  GetBrightRatio() const
  {
    return m_Flicker.brightRatio;
  }
  std::vector<double>
  GetDarkResidual() const
  {
    return m_Flicker.darkResidualDn;
  }
  double
  GetSlope() const
  {
    return m_Flicker.slopeDn;
  }
  double
  GetFlickerSd() const
  {
    return m_Flicker.flickerSd;
  }
  double
  GetFoundSigmaRows() const
  {
    return m_Flicker.sigmaRows;
  }
  double
  GetRawOffset() const
  {
    return m_Flicker.offsetDn;
  }

  const sensornoise::IsoIntensitySet &
  GetBrightSet() const
  {
    return m_BrightSet;
  }
  const sensornoise::IsoIntensitySet &
  GetDarkSet() const
  {
    return m_DarkSet;
  }

  /** mu [DN] as a pipeline output; NaN where the flicker is too small to identify it (GetFlicker() holds it raw). */
  using OffsetDecoratorType = SimpleDataObjectDecorator<double>;
  OffsetDecoratorType *
  GetOffsetOutput()
  {
    return static_cast<OffsetDecoratorType *>(this->ProcessObject::GetOutput("Offset"));
  }
  double
  GetOffset() const
  {
    return static_cast<const OffsetDecoratorType *>(this->ProcessObject::GetOutput("Offset"))->Get();
  }

  /** Resets the pipeline when an input could not be updated: ITK would otherwise take the next Update() for one that is
   * under way and return without a word and without a result. */
  void
  UpdateOutputInformation() override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  FlickerCorrectionImageFilter();
  ~FlickerCorrectionImageFilter() override = default;

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(const ProcessObject::DataObjectIdentifierType & name) override;
  void
  VerifyInputInformation() const override;
  void
  GenerateInputRequestedRegion() override;
  void
  GenerateData() override;
  void
  DynamicThreadedGenerateData(const RegionType & region) override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  bool
  IsEstimateUpToDate() const;
  void
  EstimateFlicker();
  void
  UpdateStack(const RegionType & region);
  sensornoise::FrameGeometry
  GetGeometry() const;

  double             m_BrightQuantile{ 0.99 };
  double             m_DarkQuantile{ 0.01 };
  RollingShutterEnum m_RollingShutter{ RollingShutterEnum::Auto };
  double             m_SigmaRows{ 50.0 };
  unsigned int       m_ShutterAxis{ 1 };

  sensornoise::IsoIntensitySet m_BrightSet;
  sensornoise::IsoIntensitySet m_DarkSet;
  sensornoise::FlickerEstimate m_Flicker;
  TimeStamp                    m_EstimateTime;
};

// Instantiated once, in the library.
#define SensorNoise_EXTERN(TPixel) \
  extern template class SensorNoise_EXPORT FlickerCorrectionImageFilter<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
