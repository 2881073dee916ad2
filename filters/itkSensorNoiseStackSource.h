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
#include "sensornoise/simulation/SimulationTruth.h"
#include "sensornoise/simulation/SimulationSettings.h"
#include "sensornoise/simulation/TruthJson.h"
#include "sensornoise/simulation/Simulator.h"
#include "itkImage.h"
#include "itkImageSource.h"
#include "itkNumericTraits.h"

#include <cstdint>
#include <memory>
#include <ostream>
#include <string>

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
 * The source streams: it needs the whole reference, but generates no more rows than were asked for (a row is drawn
 * whole, whatever part of it is wanted). Rows are shared out among threads; each row of each frame has random numbers
 * of its own, so the same seed gives the same bits for any number of threads and any chunks. It holds a few frames of
 * doubles beside the requested region. */
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

  void
  BeforeThreadedGenerateData() override;

  void
  DynamicThreadedGenerateData(const OutputRegionType & region) override;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
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
  double        m_ClipLow{ NumericTraits<double>::NonpositiveMin() };
  double        m_ClipHigh{ NumericTraits<double>::max() };
  double        m_PrnuSd{ 0.0 };
  double        m_DsnuSd{ 0.0 };
  double        m_HotPixelFraction{ 0.0 };
  double        m_HotPixelNoiseFactor{ 10.0 };

  sensornoise::SimulationTruth                       m_Truth;
  std::unique_ptr<const sensornoise::StackSimulator> m_Simulator;
  TimeStamp                                          m_SimulatorTime;
};
// Instantiated once, in the library.
extern template class SensorNoise_EXPORT SensorNoiseStackSource<Image<unsigned char, 3>>;
extern template class SensorNoise_EXPORT SensorNoiseStackSource<Image<unsigned short, 3>>;
extern template class SensorNoise_EXPORT SensorNoiseStackSource<Image<short, 3>>;
extern template class SensorNoise_EXPORT SensorNoiseStackSource<Image<float, 3>>;
extern template class SensorNoise_EXPORT SensorNoiseStackSource<Image<double, 3>>;

} // namespace itk

#endif // itkSensorNoiseStackSource_h
