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
 * \brief Estimates the flicker of every frame and the dark offset, and removes the flicker from the stack.
 *
 * Input 0 is the stack. The other inputs have the size of a frame: 1 "Mean" [DN], 2 "Variance" [DN^2], 3 "Mask". The
 * variance belongs to the uncorrected stack and gives the width of the iso-intensity sets. The mask selects the pixels
 * for these sets: not clipped, and not moved by vibrations.
 *
 * The output is the corrected stack u^ = u - (1 + gamma_t)(ubar - mu) [DN], (3.18). Its temporal mean is mu, and its
 * variance is affine in ubar, (3.24). The mask is not applied to it. Rows whose flicker is not known are NaN and are
 * not extrapolated. This happens with a rolling shutter if the brightest pixels do not reach a row.
 *
 * Before its first output chunk the filter reads the stack once, in its own chunks, to estimate gamma_t and mu. It
 * keeps them until an input or a parameter changes. It then streams: the frames of the requested output are requested
 * again after the other inputs are up to date, so that one reader can feed the whole chain. The filter is threaded. The
 * result has the same bits for any number of threads and chunks.
 *
 * Sections 3.2 and 3.5 of F. Sur, M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
 * sensornoise::IsoIntensitySet describes how the sets are read. GetBrightSet() and GetDarkSet() report the widening of
 * Remark 3.
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

  /** Mode of the flicker estimate: Off, Auto or Fixed. Off estimates one flicker value for each frame. Auto, the
   * default, finds out whether the flicker differs from row to row, and chooses sigma_y by cross-validation. Fixed uses
   * SigmaRows. */
  void
  SetRollingShutter(RollingShutterEnum mode);
  /** Name of the mode: "off", "auto" or "fixed". */
  void
  SetRollingShutter(const std::string & name);
  /** Returns the mode, by its name or as a value. */
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

  /** Standard deviation sigma_y of (3.28) for the RollingShutter mode Fixed [rows]. Default 50, as in the paper. */
  itkSetMacro(SigmaRows, double);
  itkGetConstMacro(SigmaRows, double);

  /** Axis along which the shutter travels: 1 = y (default), or 0 = x. With 0, the rows are the columns of the frame. */
  itkSetMacro(ShutterAxis, unsigned int);
  itkGetConstMacro(ShutterAxis, unsigned int);

  /** Returns the flicker, the offset, K and the scatter (v^*, v_*). Valid after Update(). */
  const sensornoise::FlickerEstimate &
  GetFlicker() const
  {
    return m_Flicker;
  }
  /** Returns gamma_t, the relative flicker of every frame [1]. */
  std::vector<double>
  GetGamma() const
  {
    return m_Flicker.gamma;
  }
  /** Returns gamma_t(y), the relative flicker of every row [1], frame by frame. Empty if each frame has a single
   * flicker value. */
  std::vector<double>
  GetGammaRows() const
  {
    return m_Flicker.gammaRows;
  }
  /** Returns v^*(t), (3.8), one value for each frame [1]. */
  std::vector<double>
  GetBrightRatio() const
  {
    return m_Flicker.brightRatio;
  }
  /** Returns v_*(t), (3.14), one value for each frame [DN]. */
  std::vector<double>
  GetDarkResidual() const
  {
    return m_Flicker.darkResidualDn;
  }
  /** Returns K, the slope of v_* against v^* - 1 [DN]. */
  double
  GetSlope() const
  {
    return m_Flicker.slopeDn;
  }
  /** Returns the standard deviation of gamma_t over time [1]. For gamma_t(y) it is the root mean square. */
  double
  GetFlickerSd() const
  {
    return m_Flicker.flickerSd;
  }
  /** Returns sigma_y [rows]. It is 0 if each frame has a single flicker value. */
  double
  GetFoundSigmaRows() const
  {
    return m_Flicker.sigmaRows;
  }
  /** Returns the dark offset mu [DN], even if it is not identifiable. */
  double
  GetRawOffset() const
  {
    return m_Flicker.offsetDn;
  }

  /** Returns the bright or the dark iso-intensity set. Valid after Update(). */
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

  /** Dark offset mu [DN] as a pipeline output. It is NaN if the flicker is too small to identify it; GetFlicker() has
   * the raw value. */
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

  /** Resets the pipeline if an input cannot be updated. ITK would otherwise assume that the failed update is still in
   * progress, and the next Update() would return without an error and without a result. */
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

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) \
  extern template class SensorNoise_EXPORT FlickerCorrectionImageFilter<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
