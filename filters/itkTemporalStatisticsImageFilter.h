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
 * \brief Computes the temporal mean and unbiased variance of every pixel of a stack, and the mask of valid pixels.
 *
 * Outputs of the size of a frame: 0 mean [DN], 1 variance [DN^2], 2 valid mask. The mask is 1 if the pixel is finite in
 * every frame and never at a clip level, else 0. If a pixel is NaN or infinite in any frame, its mean and variance are
 * NaN.
 *
 * A pixel is clipped if it has a clip level in at least one frame. Clip levels are the lowest and highest levels that
 * the sensor reaches. They are given, or found from repeated extreme values of the pixels, else they are the ends of
 * the DN range. GetSummary() returns what was found. Floating-point stacks have no quantization step and no DN range:
 * their clip levels are given, found from repeated extreme values, or absent.
 *
 * The filter reads the stack once, in chunks (see SensorNoiseStackSink), and is threaded over rows. Integer pixels are
 * summed exactly, and floating-point pixels by Welford's recurrence in time order. The result has the same bits for any
 * number of threads and chunks. Memory, in addition to one chunk and including the outputs: 21 bytes for each pixel if
 * integer, 33 if floating-point. A stack of integers has at most 2^22 frames.
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

  /** Returns a map of the size of a frame: mean [DN], variance [DN^2], or the mask of valid pixels (1: valid, else 0).
   */
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
  /** Returns the mean. */
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

  /** Bit depth of the sensor's digital numbers [bit], 1 to 16. Default 0: found from the data. Data that exceed the bit
   * depth are an error. */
  itkSetMacro(BitDepth, unsigned int);
  itkGetConstMacro(BitDepth, unsigned int);

  /** Lowest and highest level that the sensor reaches [DN]. Default NaN: found from the data. */
  itkSetMacro(ClipLow, double);
  itkGetConstMacro(ClipLow, double);
  itkSetMacro(ClipHigh, double);
  itkGetConstMacro(ClipHigh, double);

  /** Quantization step [DN]. Default 0: found from the data. */
  itkSetMacro(QuantisationStep, double);
  itkGetConstMacro(QuantisationStep, double);

  /** Returns the quantization and the clip levels, given or found, and the numbers of pixels that were left out. Valid
   * after Update(). */
  const sensornoise::StackSummary &
  GetSummary() const
  {
    return m_Summary;
  }

  /** Returns the lowest level that the sensor reaches [DN], given or found. NaN: no clip level. */
  double
  GetAttainedLow() const
  {
    return m_Summary.dnRange.clipLowDn.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  /** Returns the highest level that the sensor reaches [DN], given or found. NaN: no clip level. */
  double
  GetAttainedHigh() const
  {
    return m_Summary.dnRange.clipHighDn.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  /** Returns the source of the clip levels: `given`, `pile-up`, `code range`, `none`, or `low: ..., high: ...`. */
  std::string
  GetClipSource() const
  {
    return m_Summary.dnRange.clipSource;
  }
  /** Returns the quantization step [DN], given or found. 0: no quantization. */
  double
  GetFoundQuantisationStep() const
  {
    return m_Summary.dnRange.quantisationStepDn;
  }
  /** Returns the bit depth [bit], given or found. 0: floating-point data. */
  int
  GetFoundBitDepth() const
  {
    return m_Summary.dnRange.bitDepth.value_or(0);
  }
  /** Returns the number of pixels that reach a clip level. */
  SizeValueType
  GetNumberOfClippedPixels() const
  {
    return m_Summary.clipped;
  }
  /** Returns the number of pixels that are NaN or infinite in any frame. */
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

  // Sums over time.
  struct Moments;

  std::unique_ptr<Moments>  m_Moments;
  sensornoise::StackSummary m_Summary;
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) \
  extern template class SensorNoise_EXPORT TemporalStatisticsImageFilter<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
