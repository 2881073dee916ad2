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
#ifndef itkSingleImageNoiseEstimator_h
#define itkSingleImageNoiseEstimator_h

#include "SensorNoiseExport.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "itkSensorNoiseReportSink.h"
#include "itkSensorNoiseResult.h"

#include <memory>
#include <ostream>
#include <string>
#include <variant>

namespace itk
{

/** \class SingleImageNoiseEstimator
 * \brief Measures the noise variance of a single image as a line of the level, from flat and smooth areas.
 *
 * Input 0 is a stack of one or more frames along the last axis. Input 1 "Mask" has the size of a frame and is optional:
 * pixels of value 0 are left out.
 *
 * The output is a decorated sensornoise::Report, or for a Bayer mosaic sensornoise::ChannelReports. Slope of the
 * variance, gain [DN/e-] and intercepts [DN^2] are identified, with standard errors. Offset and read noise are not
 * identifiable from a single image. One line is fitted to all frames, and the report has the line of each
 * frame and of their mean image. Texture as fine as a pixel and fixed-pattern noise count as noise; the warning
 * `texture-dominates` says where that was noticed. See sensornoise::SingleImageMethod for the method and its reference.
 * For a burst of a static scene use SensorNoiseEstimator.
 *
 * Clip levels that are not given are found from the first frame.
 *
 * The filter reads the stack once, in chunks (see SensorNoiseStackSink), and is threaded. The result has the same bits
 * for any number of threads and chunks. Memory, in addition to one chunk: 8 bytes for each pixel of a frame if there
 * are several frames.
 *
 * \tparam TStack itk::Image of 3 dimensions (x, y, time) of unsigned char, unsigned short, short, float or double.
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT SingleImageNoiseEstimator : public SensorNoiseReportSink<TStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SingleImageNoiseEstimator);

  using Self = SingleImageNoiseEstimator;
  using Superclass = SensorNoiseReportSink<TStack>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using typename Superclass::PixelType;
  using ResultType = std::variant<sensornoise::Report, sensornoise::ChannelReports>;
  using ResultObjectType = SensorNoiseResult<ResultType>;
  using DataObjectPointer = DataObject::Pointer;
  using DataObjectPointerArraySizeType = ProcessObject::DataObjectPointerArraySizeType;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SingleImageNoiseEstimator";
  }

  /** Colour filters of the sensor from the upper left pixel on: "RGGB", "GRBG", "GBRG" or "BGGR", whose planes are
   * measured each by itself; "none": a monochrome sensor; "auto" (default): the pattern of the metadata, or the one
   * that the levels of the first frame show. Other names are an error in Update(). */
  itkSetStringMacro(BayerPattern);
  itkGetStringMacro(BayerPattern);

  /** Returns the result, as a pipeline output or as a variant. Valid after Update(). */
  ResultObjectType *
  GetResultOutput()
  {
    return static_cast<ResultObjectType *>(this->ProcessObject::GetOutput(0));
  }
  const ResultType &
  GetResult() const
  {
    return static_cast<const ResultObjectType *>(this->ProcessObject::GetOutput(0))->Get();
  }

  /** Returns whether the result is of the four planes of a mosaic. */
  bool
  HasChannelReports() const
  {
    return std::holds_alternative<sensornoise::ChannelReports>(this->GetResult());
  }

  /** Returns the result as JSON: the schema of the reports of SensorNoiseEstimator, with the member single_image. */
  std::string
  GetReportAsJson() const;

  /** Returns the result as a table, with its warnings. */
  std::string
  GetReportAsText() const;

  DataObject *
  GetOutput(unsigned int index)
  {
    return this->ProcessObject::GetOutput(index);
  }

protected:
  SingleImageNoiseEstimator();
  ~SingleImageNoiseEstimator() override;

  using Superclass::MakeOutput;
  DataObjectPointer
  MakeOutput(DataObjectPointerArraySizeType) override
  {
    return ResultObjectType::New().GetPointer();
  }

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
  // Data that an update collects.
  struct Measurement;

  void
  StartMeasurement(const PixelType * firstFrame);

  std::string                  m_BayerPattern{ "auto" };
  std::unique_ptr<Measurement> m_Measurement;
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SingleImageNoiseEstimator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
