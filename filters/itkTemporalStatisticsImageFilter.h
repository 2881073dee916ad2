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
#ifndef itkTemporalStatisticsImageFilter_h
#define itkTemporalStatisticsImageFilter_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/StepResults.h"
#include "itkSensorNoiseStackSink.h"

#include <limits>
#include <memory>
#include <ostream>
#include <string>

namespace itk
{

/** \class TemporalStatisticsImageFilter
 * \brief Mean and unbiased variance over time of every pixel of a stack, and the mask of valid pixels.
 *
 * Outputs, of a frame's size: 0 mean [DN], 1 variance [DN^2], 2 valid mask (1: finite in every frame and never at a
 * clip level, else 0). Where a pixel is NaN or infinite once, mean and variance are NaN.
 *
 * A pixel is clipped as soon as one frame holds a clip level. Clip levels are the lowest and highest levels that the
 * sensor attains: given, or found from pile-ups of the pixels' extremes, else the ends of the code range. See
 * GetSummary() for what was found. Floating-point stacks have no codes and no code range: their clip levels are given,
 * found from pile-ups, or none.
 *
 * Reads the stack once, in chunks (see SensorNoiseStackSink); threaded over rows. Integer pixels are summed exactly,
 * floating-point ones by Welford's recurrence in time order: the same bits for any number of threads and chunks.
 * Memory: 21 bytes a pixel for integers, 33 for floating point, outputs included, beside one chunk. At most 2^22 frames
 * of integers.
 *
 * Sections 2.3.1 and 3.1 of F. Sur, M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
 *
 * \tparam TStack itk::Image of 3 dimensions (x, y, time) of unsigned char, unsigned short, short, float or double.
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT TemporalStatisticsImageFilter : public SensorNoiseStackSink<TStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(TemporalStatisticsImageFilter);

  using Self = TemporalStatisticsImageFilter;
  using Superclass = SensorNoiseStackSink<TStack>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using typename Superclass::FrameImageType;
  using typename Superclass::MaskImageType;
  using typename Superclass::PixelType;
  using DataObjectPointer = DataObject::Pointer;
  using DataObjectPointerArraySizeType = ProcessObject::DataObjectPointerArraySizeType;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "TemporalStatisticsImageFilter";
  }

  void
  SetNumberOfStreamDivisions(unsigned int number) override
  {
    Superclass::SetNumberOfStreamDivisions(number);
  }

  FrameImageType *
  GetMean()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(0));
  }
  FrameImageType *
  GetVariance()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(1));
  }
  MaskImageType *
  GetValidMask()
  {
    return static_cast<MaskImageType *>(this->ProcessObject::GetOutput(2));
  }
  /** The mean. */
  FrameImageType *
  GetOutput()
  {
    return this->GetMean();
  }
  DataObject *
  GetOutput(unsigned int index)
  {
    return this->ProcessObject::GetOutput(index);
  }

  /** Bits of the sensor's codes, 1 to 16; 0 (default): found. Data beyond them are refused. */
  itkSetMacro(BitDepth, unsigned int);
  itkGetConstMacro(BitDepth, unsigned int);

  /** Lowest and highest level that the sensor attains [DN]; NaN (default): found. */
  itkSetMacro(ClipLow, double);
  itkGetConstMacro(ClipLow, double);
  itkSetMacro(ClipHigh, double);
  itkGetConstMacro(ClipHigh, double);

  /** Spacing of the codes [DN]; 0 (default): found. */
  itkSetMacro(QuantisationStep, double);
  itkGetConstMacro(QuantisationStep, double);

  /** Codes and clip levels as given or found, and how many pixels were left out; valid after Update(). */
  const sensornoise::StackSummary &
  GetSummary() const
  {
    return m_Summary;
  }

  /** Its members one by one. NaN: no clip level; 0: no codes. */
  double
  GetAttainedLow() const
  {
    return m_Summary.codes.clipLowDn.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  double
  GetAttainedHigh() const
  {
    return m_Summary.codes.clipHighDn.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  std::string
  GetClipSource() const
  {
    return m_Summary.codes.clipSource;
  }
  double
  GetFoundQuantisationStep() const
  {
    return m_Summary.codes.quantisationStepDn;
  }
  int
  GetFoundBitDepth() const
  {
    return m_Summary.codes.bitDepth.value_or(0);
  }
  SizeValueType
  GetNumberOfClippedPixels() const
  {
    return m_Summary.clipped;
  }
  SizeValueType
  GetNumberOfNotFinitePixels() const
  {
    return m_Summary.notFinite;
  }

protected:
  TemporalStatisticsImageFilter();
  ~TemporalStatisticsImageFilter() override;

  using Superclass::MakeOutput;
  DataObjectPointer
  MakeOutput(DataObjectPointerArraySizeType index) override;
  void
  GenerateOutputInformation() override;
  void
  EnlargeOutputRequestedRegion(DataObject * output) override;

  unsigned int
  NumberOfPasses() const override
  {
    return 1;
  }
  void
  StartPasses() override;
  void
  ProcessFrames(unsigned int pass, const PixelType * frames, SizeValueType first, SizeValueType count) override;
  void
  EndPass(unsigned int pass) override;
  void
  DropPasses() override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  unsigned int m_BitDepth{ 0 };
  double       m_ClipLow{ std::numeric_limits<double>::quiet_NaN() };
  double       m_ClipHigh{ std::numeric_limits<double>::quiet_NaN() };
  double       m_QuantisationStep{ 0.0 };

  // The sums over time.
  struct Moments;

  std::unique_ptr<Moments>  m_Moments;
  sensornoise::StackSummary m_Summary;
};

// Instantiated once, in the library.
#define SensorNoise_EXTERN(TPixel) \
  extern template class SensorNoise_EXPORT TemporalStatisticsImageFilter<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
