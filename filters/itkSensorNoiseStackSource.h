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
#ifndef itkSensorNoiseStackSource_h
#define itkSensorNoiseStackSource_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/SensorFlaws.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "itkImage.h"
#include "itkImageSource.h"
#include "itkNumericTraits.h"

#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

/** Defines the methods that set and return one of the sensor's flaws, which the simulator keeps in one struct. */
#define itkSensorFlawMacro(name, type, member) \
  virtual void Set##name(type value)           \
  {                                            \
    if (m_Flaws.member != value)               \
    {                                          \
      m_Flaws.member = value;                  \
      this->Modified();                        \
    }                                          \
  }                                            \
  virtual type Get##name() const               \
  {                                            \
    return static_cast<type>(m_Flaws.member);  \
  }                                            \
  ITK_MACROEND_NOOP_STATEMENT

namespace itk
{
/** \class SensorNoiseStackSource
 * \brief Simulates a burst of raw frames with known gain, offset, read noise, flicker and vibration.
 *
 * The input is a reference image with any range. The output is a stack whose last axis is time, in digital numbers
 * [DN]:
 *
 *   u(x, y, t) = Gain * Poisson((1 + gamma_t) p(x + alpha_t, y + beta_t)) + Normal(Offset, ReadNoise^2)
 *
 * where p is the reference, blurred and then scaled to [0, Electrons]. Integer pixels are rounded and clipped to
 * BitDepth. The model is equation (2.1) of F. Sur and M. Grediac, "Measuring the Noise of Digital Imaging Sensors by
 * Stacking Raw Images Affected by Vibrations and Illumination Flickering", SIAM J. Imaging Sci. 8(1), 2015,
 * https://doi.org/10.1137/140977035, simulated as in section 4.2. The defaults are its camera B in condition 3.
 *
 * Further effects of real sensors and cameras can be added (sensornoise::SensorFlaws): a non-linear response, gain
 * patterns, read noise that differs from pixel to pixel, noise of rows and columns, coupled charge, and processing in
 * the camera.
 *
 * The source streams. It needs the whole reference, but generates only the requested rows. A row is always drawn
 * completely, even if only a part is requested; with flaws that mix rows, a frame is always drawn completely. Rows are
 * distributed over threads. Each row of each frame has its own random numbers, so the same seed gives the same bits for
 * any number of threads and any chunks. The source holds a few frames of doubles in addition to the requested region.
 */
template <typename TOutputStack>
class ITK_TEMPLATE_EXPORT SensorNoiseStackSource : public ImageSource<TOutputStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseStackSource);

  using Self = SensorNoiseStackSource;
  using Superclass = ImageSource<TOutputStack>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using OutputStackType = TOutputStack;
  using OutputPixelType = typename OutputStackType::PixelType;
  using OutputRegionType = typename OutputStackType::RegionType;
  using ReferenceImageType = Image<double, 2>;

  static_assert(TOutputStack::ImageDimension == 3, "a stack has two dimensions of space and one of time");

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseStackSource";
  }

  /** Reference image: the scene without noise. Its values are scaled, so it may have any range. Required. */
  itkSetInputMacro(Reference, ReferenceImageType);
  itkGetInputMacro(Reference, ReferenceImageType);

  using Superclass::SetInput;
  /** Sets the reference, by the name that filters use. */
  virtual void
  SetInput(const ReferenceImageType * reference)
  {
    this->SetReference(reference);
  }
  virtual void
  SetInput(unsigned int index, const ReferenceImageType * reference);

  /** Sets Electrons, Gain, Offset and ReadNoise to the camera 'A', 'B' or 'C' of Table 1 of the paper. */
  void
  SetCamera(char name);

  /** Sets FlickerSd, VibrationSdX and VibrationSdY to the condition 1, 2 or 3 of Table 1 of the paper. */
  void
  SetConditions(int number);

  /** Number of electrons of the brightest pixel of the scene [e-], above 0 and at most 1e9. Default 3000. */
  itkSetMacro(Electrons, double);
  itkGetConstMacro(Electrons, double);

  /** System gain g [DN/e-], above 0. Default 1. */
  itkSetMacro(Gain, double);
  itkGetConstMacro(Gain, double);

  /** Dark offset mu, the mean dark signal [DN]. Default 100. */
  itkSetMacro(Offset, double);
  itkGetConstMacro(Offset, double);

  /** Read noise sigma, the standard deviation in the dark [DN], 0 or more. Default 8. */
  itkSetMacro(ReadNoise, double);
  itkGetConstMacro(ReadNoise, double);

  /** Standard deviation of the flicker gamma_t [1], 0 or more. Default 0.05. */
  itkSetMacro(FlickerSd, double);
  itkGetConstMacro(FlickerSd, double);

  /** Standard deviation of the horizontal shift alpha_t [pixel], 0 or more. Default 0.01. */
  itkSetMacro(VibrationSdX, double);
  itkGetConstMacro(VibrationSdX, double);

  /** Standard deviation of the vertical shift beta_t [pixel], 0 or more. Default 0.02. */
  itkSetMacro(VibrationSdY, double);
  itkGetConstMacro(VibrationSdY, double);

  /** Illumination factors of the frames, by name; 1 + gamma_t is multiplied by them. The names are "steady", "pulses",
   * "ramp", "decay", "sine", "uniform" and "exponential". The lowest factor and the period in frames may follow, as in
   * "pulses:0.3:4" (sensornoise::IlluminationShape). Default "steady".
   * \throws ExceptionObject for other text. */
  void
  SetIllumination(const std::string & text);
  std::string
  GetIllumination() const
  {
    return sensornoise::TextOf(m_Illumination);
  }

  /** Illumination factors of the frames [1], one for each frame, 0 or more. They replace a named shape. */
  void
  SetIlluminationFactors(const std::vector<double> & factors);
  std::vector<double>
  GetIlluminationFactors() const
  {
    return m_Illumination.factors;
  }

  /** Number of frames T, at least 1. Default 100. */
  itkSetMacro(NumberOfFrames, unsigned int);
  itkGetConstMacro(NumberOfFrames, unsigned int);

  /** Bit depth of the converter [bit]: integer pixels are clipped to [0, 2^BitDepth - 1]. With 0 they are clipped to
   * the range of their type. At most the number of bits of the type, and 32. Default 12, or 8 if the pixels have 8
   * bits. Floating-point pixels ignore it. */
  itkSetMacro(BitDepth, unsigned int);
  itkGetConstMacro(BitDepth, unsigned int);

  /** Seed of the random numbers: the same seed gives the same stack. Any value. Default 1. */
  itkSetMacro(Seed, std::uint64_t);
  itkGetConstMacro(Seed, std::uint64_t);

  /** Standard deviation of the Gaussian blur of the reference [pixel], 0 or more. Default 0.5, as in the paper. */
  itkSetMacro(OpticalBlur, double);
  itkGetConstMacro(OpticalBlur, double);

  /** Period of pulsed illumination in rows of a rolling shutter [row]. Default 0: global shutter, one flicker value for
   * each frame. Above 0: gamma_t(y) = sqrt(2) FlickerSd sin(2 pi y / period + phase_t). */
  itkSetMacro(RollingShutterPeriod, double);
  itkGetConstMacro(RollingShutterPeriod, double);

  /** Lowest value of the sensor [DN]. Default `NumericTraits<double>::NonpositiveMin()`: no lower limit. */
  itkSetMacro(ClipLow, double);
  itkGetConstMacro(ClipLow, double);

  /** Level at which the sensor saturates [DN]. Default `NumericTraits<double>::max()`: no saturation. */
  itkSetMacro(ClipHigh, double);
  itkGetConstMacro(ClipHigh, double);

  /** Photo-response non-uniformity (PRNU): standard deviation of the relative sensitivity of the pixels [1], 0 or more.
   * Default 0. */
  itkSetMacro(PrnuSd, double);
  itkGetConstMacro(PrnuSd, double);

  /** Dark-signal non-uniformity (DSNU): standard deviation of the offset of the pixels [DN], 0 or more. Default 0. */
  itkSetMacro(DsnuSd, double);
  itkGetConstMacro(DsnuSd, double);

  /** Fraction of the pixels with excess read noise, 0 to 1. Default 0. */
  itkSetMacro(HotPixelFraction, double);
  itkGetConstMacro(HotPixelFraction, double);

  /** Read noise of the pixels of HotPixelFraction, in units of ReadNoise [1], 0 or more. Default 10. */
  itkSetMacro(HotPixelNoiseFactor, double);
  itkGetConstMacro(HotPixelNoiseFactor, double);

  /** Whether the shutter is closed: the output is dark frames of the same sensor, with the same fixed-pattern noise and
   * different temporal noise. Default off. */
  itkSetMacro(Dark, bool);
  itkGetConstMacro(Dark, bool);
  itkBooleanMacro(Dark);

  /** Pattern of the colour filters: "RGGB", "GRBG", "GBRG" or "BGGR". Default "none": no filters. */
  void
  SetBayerPattern(const std::string & name);
  std::string
  GetBayerPattern() const
  {
    return m_Flaws.filters.pattern ? sensornoise::NameOf(*m_Flaws.filters.pattern) : "none";
  }

  /** Transmission of the colour filters, the fraction of the scene's electrons that remains [1], 0 to 1. Defaults 0.6
   * (R), 1 (G) and 0.5 (B). */
  itkSensorFlawMacro(TransmissionR, double, filters.transmissionR);
  itkSensorFlawMacro(TransmissionG, double, filters.transmissionG);
  itkSensorFlawMacro(TransmissionB, double, filters.transmissionB);

  /** Relative standard deviation of the gain from pixel to pixel [1], 0 or more, below 0.2. Default 0. */
  itkSensorFlawMacro(GainSd, double, pattern.gainSd);

  /** Relative standard deviation of the gain from column to column [1], 0 or more, below 0.2. Default 0. */
  itkSensorFlawMacro(ColumnGainSd, double, pattern.columnGainSd);

  /** Relative standard deviation of the expected electrons from column to column [1], 0 or more, below 0.2. Default 0.
   */
  itkSensorFlawMacro(ColumnEfficiencySd, double, pattern.columnEfficiencySd);

  /** Standard deviation of the offset from column to column [DN], 0 or more. Default 0. */
  itkSensorFlawMacro(ColumnOffsetSd, double, pattern.columnOffsetSdDn);

  /** Brighter-fatter effect: shift of the border between two pixels for each electron of difference [1/e-], 0 or more.
   * Its product with Electrons is at most 0.1. Default 0. */
  itkSensorFlawMacro(BrighterFatterPerElectron, double, brighterFatter.perElectron);

  /** Interpixel capacitance: fraction of its signal that a pixel gives to each of its four neighbours [1], 0 to 0.2.
   * Default 0. */
  itkSensorFlawMacro(CouplingFraction, double, coupling.fraction);

  /** Standard deviation of the logarithm of the read noise from pixel to pixel [1], 0 to 3. Default 0. */
  itkSensorFlawMacro(ReadNoiseSpread, double, readNoise.spread);

  /** Fraction of the pixels in the tail of the read noise, 0 to 1. Default 0. */
  itkSensorFlawMacro(ReadNoiseTailFraction, double, readNoise.tailFraction);

  /** Factor of the tail of the read noise [1], 0 to 3. In the tail the logarithm is greater by |normal| times this
   * factor. Default 1. */
  itkSensorFlawMacro(ReadNoiseTailSpread, double, readNoise.tailSpread);

  /** Shape of the response: straight, quadratic, wave, shoulder, gamma or s-curve (sensornoise::ResponseShape). Default
   * straight. */
  void
  SetResponseShape(const std::string & name);
  std::string
  GetResponseShape() const
  {
    return sensornoise::NameOf(m_Flaws.response.shape);
  }

  /** Size of the non-linearity [1]: deviation of the local gain, or the exponent of gamma, or the weight of the
   * s-curve. Default 0. */
  itkSensorFlawMacro(ResponseSize, double, response.size);

  /** Signal at the end of the response [e-]. Default 0: the value of Electrons. */
  itkSensorFlawMacro(ResponseFullScale, double, response.fullScaleElectrons);

  /** Standard deviation of the row noise, a random number that is common to the pixels of a row in a frame [DN], 0 or
   * more. Default 0. */
  itkSensorFlawMacro(RowNoiseSd, double, lineNoise.rowNoiseSdDn);

  /** Standard deviation of the column noise, a random number that is common to the pixels of a column in a frame [DN],
   * 0 or more. Default 0. */
  itkSensorFlawMacro(ColumnNoiseSd, double, lineNoise.columnNoiseSdDn);

  /** Amplitude of the banding, a sine along y with a different phase in each frame [DN], 0 or more. Default 0. */
  itkSensorFlawMacro(BandingAmplitude, double, lineNoise.bandingAmplitudeDn);

  /** Period of the banding [row], above 0. Default 64. */
  itkSensorFlawMacro(BandingPeriod, double, lineNoise.bandingPeriodRows);

  /** Threshold of the defect correction in the camera, in standard deviations of the neighbours of a pixel. A pixel
   * that is further from the median of its neighbours is replaced by this median. Default 0: no correction. */
  itkSensorFlawMacro(DefectThresholdSd, double, defectCorrection.thresholdSd);

  /** Weight of the last frame in the temporal filter of the camera [1], 0 to 0.99. Default 0. */
  itkSensorFlawMacro(TemporalFilterWeight, double, temporalFilter.weight);

  /** Radius of the square of the median filter in the camera [pixel], 0 to 10; 1 means 3 x 3. Default 0: no filter. */
  itkSensorFlawMacro(MedianRadius, unsigned int, median.radiusPixels);

  /** Standard deviation of the Gaussian smoothing in the camera [pixel], 0 to 100. Default 0. */
  itkSensorFlawMacro(SmoothingSd, double, smoothing.sdPixels);

  /** Binning in the camera at unchanged size: side of the square tiles whose mean is taken [pixel], 1 to 64. Default 1:
   * no binning. */
  itkSensorFlawMacro(BinningFactor, unsigned int, binning.factor);

  /** Interpolation that restores the original size after binning: nearest (default) or linear. */
  void
  SetBinningInterpolation(const std::string & name);
  std::string
  GetBinningInterpolation() const
  {
    return sensornoise::NameOf(m_Flaws.binning.interpolation);
  }

  /** Horizontal shift of the resampling in the camera [pixel], -1000 to 1000. Default 0. */
  itkSensorFlawMacro(ResamplingShiftX, double, resampling.shiftXPixels);

  /** Vertical shift of the resampling in the camera [pixel], -1000 to 1000. Default 0. */
  itkSensorFlawMacro(ResamplingShiftY, double, resampling.shiftYPixels);

  /** Interpolation of the resampling: linear (default) or cubic. */
  void
  SetResamplingInterpolation(const std::string & name);
  std::string
  GetResamplingInterpolation() const
  {
    return sensornoise::NameOf(m_Flaws.resampling.interpolation);
  }

  /** JPEG-like quantization of blocks of 8 x 8 pixels: quality as in libjpeg, 1 to 100. Default 0: no quantization of
   * blocks. Needs a BitDepth above 0. */
  itkSensorFlawMacro(BlockQuality, unsigned int, blocks.quality);

  /** Square-root companding: number of bits of the stored values [bit], 2 to 16. Default 0: no companding. Needs a
   * BitDepth above 0. */
  itkSensorFlawMacro(CompandingBits, unsigned int, companding.bits);

  /** Number of times that an exposure is written, 1 or more: each exposure, or one in every RepeatPeriod. Default 1. */
  itkSensorFlawMacro(RepeatCount, unsigned int, repetition.count);

  /** Period of the repetition [exposures], 1 or more: the last exposure of each period is repeated. Default 1: each
   * exposure. */
  itkSensorFlawMacro(RepeatPeriod, unsigned int, repetition.period);

  /** Returns the true values that an estimator should find in this stack. Up to date after UpdateOutputInformation() or
   * Update(). */
  const sensornoise::SimulationTruth &
  GetTruth() const
  {
    return m_Truth;
  }

  /** Returns the true values as JSON, schema "itk-sensornoise-truth/1". */
  std::string
  GetTruthAsJson() const
  {
    const auto size = this->GetOutput()->GetLargestPossibleRegion().GetSize();
    return sensornoise::ToJson(m_Truth, size[0], size[1]);
  }

  /** Returns the simulator of the last Update(), or null before it. It is kept until the filter or the reference is
   * modified. */
  const sensornoise::StackSimulator *
  GetSimulator() const
  {
    return m_Simulator.get();
  }

  /** Resets the pipeline if the reference cannot be made. ITK would otherwise assume that the failed update is still in
   * progress, and the next Update() would return without an error and without an image. */
  void
  UpdateOutputInformation() override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  SensorNoiseStackSource();
  ~SensorNoiseStackSource() override = default;

  void
  GenerateOutputInformation() override;

  void
  GenerateInputRequestedRegion() override;

  /** Draws rows in any order, or whole frames one after the other if flaws mix rows or frames. */
  void
  GenerateData() override;

  void
  BeforeThreadedGenerateData() override;

  void
  DynamicThreadedGenerateData(const OutputRegionType & region) override;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Sets \a member to the value that \a parse makes of a name. Throws an ExceptionObject if there is no such name. */
  template <typename TValue, typename TParse>
  void
  SetParsed(TValue & member, TParse parse);

  sensornoise::SimulationSettings
  MakeSettings() const;

  double        m_Electrons{ 3000.0 };
  double        m_Gain{ 1.0 };
  double        m_Offset{ 100.0 };
  double        m_ReadNoise{ 8.0 };
  double        m_FlickerSd{ 0.05 };
  double        m_VibrationSdX{ 0.01 };
  double        m_VibrationSdY{ 0.02 };
  unsigned int  m_NumberOfFrames{ 100 };
  unsigned int  m_BitDepth{ sizeof(OutputPixelType) == 1 ? 8u : 12u };
  std::uint64_t m_Seed{ 1 };
  double        m_OpticalBlur{ 0.5 };
  double        m_RollingShutterPeriod{ 0.0 };

  sensornoise::IlluminationSettings m_Illumination;

  double m_ClipLow{ NumericTraits<double>::NonpositiveMin() };
  double m_ClipHigh{ NumericTraits<double>::max() };
  double m_PrnuSd{ 0.0 };
  double m_DsnuSd{ 0.0 };
  double m_HotPixelFraction{ 0.0 };
  double m_HotPixelNoiseFactor{ 10.0 };
  bool   m_Dark{ false };

  sensornoise::SensorFlaws m_Flaws;

  sensornoise::SimulationTruth                       m_Truth;
  std::unique_ptr<const sensornoise::StackSimulator> m_Simulator;
  TimeStamp                                          m_SimulatorTime;
};
// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseStackSource<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#undef itkSensorFlawMacro

#endif // itkSensorNoiseStackSource_h
