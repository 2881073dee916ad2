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
#ifndef itkNoiseCorrelationEstimator_h
#define itkNoiseCorrelationEstimator_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/StepResults.h"
#include "itkSensorNoiseResult.h"
#include "itkSensorNoiseStackSink.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace itk
{

/** \class NoiseCorrelationEstimator
 * \brief Whether the noise is that of raw frames: what neighbours and frames share of it, and the gain over all lags.
 *
 * Inputs: 0 the stack, frames of a scene that stands still (flat fields, for instance) along the last axis; of a
 * frame's size 1 "Mean" [DN] and 2 "Mask" (pixels of value 0 are left out: clipped ones should be), as
 * TemporalStatisticsImageFilter gives them. Both are optional: where one is missing, the stack is read once more to
 * find it. Output: a decorated sensornoise::CorrelationEstimate:
 *
 * - the record of the report (sensornoise::NoiseCorrelationRecord): the kind of processing (`white`, `crosstalk`,
 *   `filtered`, `temporal`, `enlarged`, `brighter-fatter`, `not-linear`, `not-measured` where there are fewer than
 *   1024 pixels in 4 tiles), the correlation coefficients by lag [1], the noise of whole rows and columns [DN], all
 * with errors;
 * - the sum over all lags of the covariances, relative to the variance [1]. A camera that smooths its frames lowers
 *   the variance, and a photon transfer of variance against mean then gives too small a gain; variance, or gain, times
 *   this sum is what it was before. For any linear processing whose weights sum to 1. Of all pixels, and for quarters
 *   of them from dark to bright, with their light and variance.
 *
 * What changes from frame to frame must not be taken for noise: the frames' means (flicker, a drifting offset) are
 * taken out by default, series of one's own (FlickerCorrectionImageFilter::GetGamma(), motion) by AddSeries(). Of a
 * scene with contrast that flickers and trembles, SensorNoiseEstimator finds them all, and has this record in its
 * report.
 *
 * Measured on square tiles spread evenly over the frame, at most 131072 pixels and 256 frames, of which those equal to
 * an earlier one are left out. Standard errors are from a jackknife over the tiles. Reads the stack once, or twice, in
 * chunks (see SensorNoiseStackSink). Threaded; the same bits for any number of threads and chunks. Memory, beside one
 * chunk: up to 70 MiB for the sample, and about 20 bytes a pixel of a frame, 60 where it reads twice.
 *
 * P. Astier et al., A&A 629, A36, 2019, https://doi.org/10.1051/0004-6361/201935508, for flats; EMVA 1288 release 4 for
 * the noise of rows and columns.
 *
 * \tparam TStack itk::Image of 3 dimensions (x, y, time) of unsigned char, unsigned short, short, float or double.
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT NoiseCorrelationEstimator : public SensorNoiseStackSink<TStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(NoiseCorrelationEstimator);

  using Self = NoiseCorrelationEstimator;
  using Superclass = SensorNoiseStackSink<TStack>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using typename Superclass::FrameImageType;
  using typename Superclass::MaskImageType;
  using typename Superclass::PixelType;
  using ResultObjectType = SensorNoiseResult<sensornoise::CorrelationEstimate>;
  using DataObjectPointer = DataObject::Pointer;
  using DataObjectPointerArraySizeType = ProcessObject::DataObjectPointerArraySizeType;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "NoiseCorrelationEstimator";
  }

  void
  SetNumberOfStreamDivisions(unsigned int number) override
  {
    Superclass::SetNumberOfStreamDivisions(number);
  }

  /** The stack's mean of every pixel [DN], which tells its light; NaN: the pixel is left out. Default: found. */
  itkSetInputMacro(Mean, FrameImageType);
  itkGetInputMacro(Mean, FrameImageType);

  /** Pixels of value 0 are left out. Default: none but those that attain a clip level or are not finite, which are left
   * out, too, where the mean is not given. */
  itkSetInputMacro(Mask, MaskImageType);
  itkGetInputMacro(Mask, MaskImageType);

  /** Adds a series over time, a finite number a frame, of any unit: what is in proportion to it is taken out of every
   * pixel, each by its own factor. Default: none. */
  void
  AddSeries(const std::vector<double> & series);
  void
  ClearSeries();
  SizeValueType
  GetNumberOfSeries() const
  {
    return m_Series.size();
  }

  /** Whether the means of the frames, plain and weighted with the light, are taken out as series are: flicker and a
   * drifting offset, which all pixels share. Default: on. Off, a fluctuating light is seen as noise that is shared. */
  itkSetMacro(RemoveFrameMeans, bool);
  itkGetConstMacro(RemoveFrameMeans, bool);
  itkBooleanMacro(RemoveFrameMeans);

  /** The level without light [DN]: tells what grows with the light from what does not. NaN (default): not known; the
   * darkest level if that is below 0.3 of the brightest, else 0. */
  itkSetMacro(Offset, double);
  itkGetConstMacro(Offset, double);

  /** Spacing of the codes [DN]: the noise of rounding, step^2/12, has passed no filter. 0 (default): found; where mean
   * and mask are given, 1 for integer pixels and none for floating-point ones. */
  itkSetMacro(QuantisationStep, double);
  itkGetConstMacro(QuantisationStep, double);

  /** The result as a pipeline output, and itself; valid after Update(). */
  ResultObjectType *
  GetResultOutput()
  {
    return static_cast<ResultObjectType *>(this->ProcessObject::GetOutput(0));
  }
  const sensornoise::CorrelationEstimate &
  GetResult() const
  {
    return static_cast<const ResultObjectType *>(this->ProcessObject::GetOutput(0))->Get();
  }

  /** The result as JSON, schema "itk-sensornoise-correlation/1"; noise_correlation in it as in the report's. */
  std::string
  GetResultAsJson() const
  {
    return sensornoise::ToJson(this->GetResult());
  }

  /** The kind of processing: "white", "filtered" ... */
  std::string
  GetKind() const
  {
    return this->GetResult().correlation.kind;
  }

  /** The sum of the covariances over all lags in space and time, relative to the variance [1]: what variance and slope
   * have to be multiplied by where the kind is another than white. NaN where the noise is not linear, or not measured.
   */
  double
  GetSumOverLags() const
  {
    return this->GetResult().sumOverLags.value.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  /** Its standard error [1], with what the lags beyond the last may add; NaN as the sum. */
  double
  GetSumOverLagsStandardError() const
  {
    return this->GetResult().sumOverLags.standardError.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  DataObject *
  GetOutput(unsigned int index)
  {
    return this->ProcessObject::GetOutput(index);
  }

protected:
  NoiseCorrelationEstimator();
  ~NoiseCorrelationEstimator() override;

  using Superclass::MakeOutput;
  DataObjectPointer
  MakeOutput(DataObjectPointerArraySizeType) override
  {
    return ResultObjectType::New().GetPointer();
  }
  void
  VerifyInputInformation() const override;

  unsigned int
  NumberOfPasses() const override;
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
  // What an update gathers.
  struct Measurement;

  void
  FindMeanAndMask();

  std::vector<std::vector<double>> m_Series;
  bool                             m_RemoveFrameMeans{ true };
  double                           m_Offset{ std::numeric_limits<double>::quiet_NaN() };
  double                           m_QuantisationStep{ 0.0 };

  std::unique_ptr<Measurement> m_Measurement;
};

// Instantiated once, in the library.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT NoiseCorrelationEstimator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
