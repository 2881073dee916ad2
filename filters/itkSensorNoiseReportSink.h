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
#ifndef itkSensorNoiseReportSink_h
#define itkSensorNoiseReportSink_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "itkSensorNoiseStackSink.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace itk
{

/** \class SensorNoiseReportSink
 * \brief Base class of the filters that make a report of a stack: its mask, its digital numbers, and where it is from.
 *
 * The properties of the digital numbers are found from the data unless they are given. The report records the region,
 * the frames and the hash of the source, so that the measurement can be repeated.
 *
 * \tparam TStack itk::Image of 3 dimensions: x, y, time.
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT SensorNoiseReportSink : public SensorNoiseStackSink<TStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseReportSink);

  using Self = SensorNoiseReportSink;
  using Superclass = SensorNoiseStackSink<TStack>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using typename Superclass::MaskImageType;

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseReportSink";
  }

  /** Mask of the size of a frame: pixels of value 0 are left out. Default: no mask. */
  itkSetInputMacro(Mask, MaskImageType);
  itkGetInputMacro(Mask, MaskImageType);

  /** Bit depth of the sensor's digital numbers [bit], 1 to 16. Default 0: found from the data. */
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

  /** Excess noise factor F of the sensor, 1 or more [1]: the gain is the slope of the variance divided by F. It is
   * about 2 in an EMCCD. Default 1: no excess noise. Update() throws an ExceptionObject if it is less than 1. */
  itkSetMacro(ExcessNoiseFactor, double);
  itkGetConstMacro(ExcessNoiseFactor, double);

  /** Region of the recording from which the stack was cut out: a rectangle of each frame, and the frames from \a first
   * up to, but not including, \a end. The report's settings record them, so that the measurement can be repeated.
   * Nothing is cut here, and no number changes. Default: nothing is recorded. Update() throws if the rectangle or the
   * range does not have the size of the stack. */
  void
  SetSourceRegion(SizeValueType x, SizeValueType y, SizeValueType width, SizeValueType height);
  void
  SetSourceFrames(SizeValueType first, SizeValueType end);
  const sensornoise::StackSelection &
  GetSource() const
  {
    return m_Source;
  }

  /** SHA-256 hash of the frames, 64 hexadecimal digits. It identifies the frames of the report, which records it as its
   * input. The number of files is \a files, and their total size is \a bytes. If both are 0, the hash is the hash of
   * the pixels (see sensornoise::InputFiles, which defines the bytes). The caller has to make sure that these bytes are
   * the bytes that are measured. Default: empty, nothing is recorded. */
  void
  SetFramesHash(const std::string & sha256, SizeValueType files, SizeValueType bytes);

protected:
  SensorNoiseReportSink();
  ~SensorNoiseReportSink() override = default;

  /** Throws an ExceptionObject if the mask or the source does not have the size of the stack. */
  void
  VerifyInputInformation() const override;

  /** Updates the mask and returns its pixels; without a mask, an empty vector. */
  std::vector<std::uint8_t>
  ReadMask() const;
  /** Returns the record of the input, with the hash that was given; null if there is none. */
  virtual std::optional<sensornoise::InputRecord>
  GetInputRecord() const;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  unsigned int                m_BitDepth{ 0 };
  double                      m_ClipLow{ std::numeric_limits<double>::quiet_NaN() };
  double                      m_ClipHigh{ std::numeric_limits<double>::quiet_NaN() };
  double                      m_QuantisationStep{ 0.0 };
  double                      m_ExcessNoiseFactor{ 1.0 };
  sensornoise::StackSelection m_Source;
  sensornoise::InputFiles     m_FramesHash;
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseReportSink<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
