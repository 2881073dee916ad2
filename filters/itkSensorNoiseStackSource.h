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

/** Set and get of one of the sensor's flaws, which the simulator keeps together. */
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
 * The input is a reference image, of any range; the output is a stack whose last axis is time, in digital numbers [DN]:
 *
 *   u(x, y, t) = Gain * Poisson((1 + gamma_t) p(x + alpha_t, y + beta_t)) + Normal(Offset, ReadNoise^2)
 *
 * with p the reference, blurred and then scaled to [0, Electrons]. Integer pixels are rounded and clipped to BitDepth.
 * The model is equation (2.1) of F. Sur and M. Grediac, "Measuring the Noise of Digital Imaging Sensors by Stacking
 * Raw Images Affected by Vibrations and Illumination Flickering", SIAM J. Imaging Sci. 8(1), 2015,
 * https://doi.org/10.1137/140977035, simulated as in section 4.2. The defaults are its camera B in condition 3.
 *
 * What real sensors and cameras do beside can be added (sensornoise::SensorFlaws): a bent response, patterns of gain,
 * read noise that differs from pixel to pixel, noise of rows and columns, coupled charge, processing in the camera.
 *
 * The source streams: it needs the whole reference, but generates no more rows than were asked for (a row is drawn
 * whole, whatever part of it is wanted; with flaws that mix rows, a frame). Rows are shared out among threads; each row
 * of each frame has random numbers of its own, so the same seed gives the same bits for any number of threads and any
 * chunks. It holds a few frames of doubles beside the requested region. */
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

  /** The scene without noise; its values are scaled, so any range will do. Required. */
  itkSetInputMacro(Reference, ReferenceImageType);
  itkGetInputMacro(Reference, ReferenceImageType);

  using Superclass::SetInput;
  /** The reference, by the name that filters use. */
  virtual void
  SetInput(const ReferenceImageType * reference)
  {
    this->SetReference(reference);
  }
  virtual void
  SetInput(unsigned int index, const ReferenceImageType * reference);

  /** Sets Electrons, Gain, Offset and ReadNoise to camera 'A', 'B' or 'C' of the paper's Table 1. */
  void
  SetCamera(char name);

  /** Sets FlickerSd, VibrationSdX and VibrationSdY to condition 1, 2 or 3 of the paper's Table 1. */
  void
  SetConditions(int number);

  /** Electrons of the brightest pixel of the scene [e-], above 0 and at most 1e9. Default 3000. */
  itkSetMacro(Electrons, double);
  itkGetConstMacro(Electrons, double);

  /** Gain g [DN/e-], above 0. Default 1. */
  itkSetMacro(Gain, double);
  itkGetConstMacro(Gain, double);

  /** Offset mu, the level without light [DN]. Default 100. */
  itkSetMacro(Offset, double);
  itkGetConstMacro(Offset, double);

  /** Read noise sigma, the standard deviation without light [DN], 0 or more. Default 8. */
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

  /** Illumination factors of the frames by name, with which 1 + gamma_t is multiplied: "steady", "pulses", "ramp",
   * "decay", "sine", "uniform" or "exponential", then the lowest factor and the period in frames, as in "pulses:0.3:4"
   * (sensornoise::IlluminationShape). Default "steady".
   * \throws ExceptionObject for other text. */
  void
  SetIllumination(const std::string & text);
  std::string
  GetIllumination() const
  {
    return sensornoise::TextOf(m_Illumination);
  }

  /** Illumination factors of the frames [1], one each, 0 or more, instead of a named shape. */
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

  /** Bits of the converter: integer pixels are clipped to [0, 2^BitDepth - 1]. 0: to the range of their type. At most
   * what the type holds, and 32. Default 12, or 8 if the pixels are of 8 bits. Floating-point pixels ignore it. */
  itkSetMacro(BitDepth, unsigned int);
  itkGetConstMacro(BitDepth, unsigned int);

  /** Seed: the same seed gives the same stack. Any value. Default 1. */
  itkSetMacro(Seed, std::uint64_t);
  itkGetConstMacro(Seed, std::uint64_t);

  /** Standard deviation of the Gaussian blur of the reference [pixel], 0 or more. Default 0.5, as in the paper. */
  itkSetMacro(OpticalBlur, double);
  itkGetConstMacro(OpticalBlur, double);

  /** Period of a lamp's pulse in rows of a rolling shutter [row]; 0: global shutter, one flicker number a frame. Above
   * 0: gamma_t(y) = sqrt(2) FlickerSd sin(2 pi y / period + phase_t). Default 0. */
  itkSetMacro(RollingShutterPeriod, double);
  itkGetConstMacro(RollingShutterPeriod, double);

  /** Floor of the sensor [DN]; `NumericTraits<double>::NonpositiveMin()`, the default, is none. */
  itkSetMacro(ClipLow, double);
  itkGetConstMacro(ClipLow, double);

  /** Level at which the sensor saturates [DN]; `NumericTraits<double>::max()`, the default, is none. */
  itkSetMacro(ClipHigh, double);
  itkGetConstMacro(ClipHigh, double);

  /** Photo-response non-uniformity: standard deviation of the pixels' relative sensitivity [1], 0 or more. Default 0.
   */
  itkSetMacro(PrnuSd, double);
  itkGetConstMacro(PrnuSd, double);

  /** Dark-signal non-uniformity: standard deviation of the pixels' offset [DN], 0 or more. Default 0. */
  itkSetMacro(DsnuSd, double);
  itkGetConstMacro(DsnuSd, double);

  /** Fraction of the pixels with excess read noise, 0 to 1. Default 0. */
  itkSetMacro(HotPixelFraction, double);
  itkGetConstMacro(HotPixelFraction, double);

  /** Read noise of those pixels in units of ReadNoise, 0 or more. Default 10. */
  itkSetMacro(HotPixelNoiseFactor, double);
  itkGetConstMacro(HotPixelNoiseFactor, double);

  /** The shutter is closed: frames of the same sensor without light, with the same fixed patterns and other noise.
   * Default off. */
  itkSetMacro(Dark, bool);
  itkGetConstMacro(Dark, bool);
  itkBooleanMacro(Dark);

  /** Mosaic of colour filters: "RGGB", "GRBG", "GBRG" or "BGGR"; "none" (default): no filters. */
  void
  SetBayerPattern(const std::string & name);
  std::string
  GetBayerPattern() const
  {
    return m_Flaws.filters.pattern ? sensornoise::NameOf(*m_Flaws.filters.pattern) : "none";
  }

  /** What the filters let through of the scene's electrons [1], 0 to 1. Defaults 0.6, 1, 0.5. */
  itkSensorFlawMacro(TransmissionR, double, filters.transmissionR);
  itkSensorFlawMacro(TransmissionG, double, filters.transmissionG);
  itkSensorFlawMacro(TransmissionB, double, filters.transmissionB);

  /** Relative standard deviation of the gain from pixel to pixel [1], 0 or more, below 0.2. Default 0. */
  itkSensorFlawMacro(GainSd, double, pattern.gainSd);

  /** The same from column to column. Default 0. */
  itkSensorFlawMacro(ColumnGainSd, double, pattern.columnGainSd);

  /** Relative standard deviation of the expected electrons from column to column [1], 0 or more, below 0.2. Default
   * 0. */
  itkSensorFlawMacro(ColumnEfficiencySd, double, pattern.columnEfficiencySd);

  /** Standard deviation of the offset from column to column [DN], 0 or more. Default 0. */
  itkSensorFlawMacro(ColumnOffsetSd, double, pattern.columnOffsetSdDn);

  /** Brighter-fatter effect: shift of the border between two pixels for each electron of difference [1/e-], 0 or
   * more, times Electrons at most 0.1. Default 0. */
  itkSensorFlawMacro(BrighterFatterPerElectron, double, brighterFatter.perElectron);

  /** Interpixel capacitance: fraction of its signal that a pixel gives to each of its four neighbours [1], 0 to 0.2.
   * Default 0. */
  itkSensorFlawMacro(CouplingFraction, double, coupling.fraction);

  /** Standard deviation of the logarithm of the read noise from pixel to pixel [1], 0 to 3. Default 0. */
  itkSensorFlawMacro(ReadNoiseSpread, double, readNoise.spread);

  /** Fraction of the pixels in the tail of the read noise, 0 to 1. Default 0. */
  itkSensorFlawMacro(ReadNoiseTailFraction, double, readNoise.tailFraction);

  /** In the tail the logarithm is greater by |normal| times this [1], 0 to 3. Default 1. */
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

  /** How far the response is bent [1]: departure of the local gain, or the exponent of gamma, or the weight of the
   * s-curve. Default 0. */
  itkSensorFlawMacro(ResponseSize, double, response.size);

  /** Signal at the end of the response [e-]; 0, the default: Electrons. */
  itkSensorFlawMacro(ResponseFullScale, double, response.fullScaleElectrons);

  /** Standard deviation of a number that the pixels of a row share in a frame [DN], 0 or more. Default 0. */
  itkSensorFlawMacro(RowNoiseSd, double, lineNoise.rowNoiseSdDn);

  /** Standard deviation of a number that the pixels of a column share in a frame [DN], 0 or more. Default 0. */
  itkSensorFlawMacro(ColumnNoiseSd, double, lineNoise.columnNoiseSdDn);

  /** Amplitude of a sine along y with a phase of its own in each frame [DN], 0 or more. Default 0. */
  itkSensorFlawMacro(BandingAmplitude, double, lineNoise.bandingAmplitudeDn);

  /** Its period [row], above 0. Default 64. */
  itkSensorFlawMacro(BandingPeriod, double, lineNoise.bandingPeriodRows);

  /** Correction of defects in the camera: a pixel further from the median of its neighbours than so many of their
   * standard deviations becomes that median; 0, the default: none. */
  itkSensorFlawMacro(DefectThresholdSd, double, defectCorrection.thresholdSd);

  /** Temporal filter in the camera: weight of the last frame [1], 0 to 0.99. Default 0. */
  itkSensorFlawMacro(TemporalFilterWeight, double, temporalFilter.weight);

  /** Median filter in the camera: radius of its square [pixel], 1: 3 x 3, 0 to 10. Default 0: none. */
  itkSensorFlawMacro(MedianRadius, unsigned int, median.radiusPixels);

  /** Smoothing in the camera: standard deviation of its Gaussian kernel [pixel], 0 to 100. Default 0. */
  itkSensorFlawMacro(SmoothingSd, double, smoothing.sdPixels);

  /** Binning in the camera, in the old size: side of the squares whose mean is taken [pixel], 1 to 64. Default 1:
   * none. */
  itkSensorFlawMacro(BinningFactor, unsigned int, binning.factor);

  /** How the old size is made again: nearest, the default, or linear. */
  void
  SetBinningInterpolation(const std::string & name);
  std::string
  GetBinningInterpolation() const
  {
    return sensornoise::NameOf(m_Flaws.binning.interpolation);
  }

  /** Resampling in the camera: horizontal shift [pixel], -1000 to 1000. Default 0. */
  itkSensorFlawMacro(ResamplingShiftX, double, resampling.shiftXPixels);

  /** Vertical shift of the resampling [pixel], -1000 to 1000. Default 0. */
  itkSensorFlawMacro(ResamplingShiftY, double, resampling.shiftYPixels);

  /** How the resampling interpolates: linear, the default, or cubic. */
  void
  SetResamplingInterpolation(const std::string & name);
  std::string
  GetResamplingInterpolation() const
  {
    return sensornoise::NameOf(m_Flaws.resampling.interpolation);
  }

  /** JPEG-like quantisation of blocks of 8 x 8 pixels: libjpeg's quality, 1 to 100; 0, the default: none. Needs a
   * BitDepth above 0. */
  itkSensorFlawMacro(BlockQuality, unsigned int, blocks.quality);

  /** Square-root companding: bits of the stored codes, 2 to 16; 0, the default: none. Needs a BitDepth above 0. */
  itkSensorFlawMacro(CompandingBits, unsigned int, companding.bits);

  /** How often each exposure, or each one of RepeatPeriod, is written, 1 or more. Default 1. */
  itkSensorFlawMacro(RepeatCount, unsigned int, repetition.count);

  /** The last of so many exposures is repeated, 1 or more. Default 1: each. */
  itkSensorFlawMacro(RepeatPeriod, unsigned int, repetition.period);

  /** What an estimator of this stack should find. Up to date after UpdateOutputInformation() or Update(). */
  const sensornoise::SimulationTruth &
  GetTruth() const
  {
    return m_Truth;
  }

  /** The truth as JSON, schema "itk-sensornoise-truth/1". */
  std::string
  GetTruthAsJson() const
  {
    const auto size = this->GetOutput()->GetLargestPossibleRegion().GetSize();
    return sensornoise::ToJson(m_Truth, size[0], size[1]);
  }

  /** The simulator of the last Update(), null before; kept until the filter or the reference is modified. */
  const sensornoise::StackSimulator *
  GetSimulator() const
  {
    return m_Simulator.get();
  }

  /** Resets the pipeline when the reference could not be made: ITK would otherwise take the next Update() for one that
   * is under way and return without a word and without an image. */
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

  /** Draws rows in any order, or whole frames one after the other where flaws mix rows or frames. */
  void
  GenerateData() override;

  void
  BeforeThreadedGenerateData() override;

  void
  DynamicThreadedGenerateData(const OutputRegionType & region) override;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Sets one of the flaws' interpolations by its name. */
  void
  SetInterpolation(sensornoise::Interpolation & interpolation, const std::string & name);

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
// Instantiated once, in the library.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseStackSource<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#undef itkSensorFlawMacro

#endif // itkSensorNoiseStackSource_h
