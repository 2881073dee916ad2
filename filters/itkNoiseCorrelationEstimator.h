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
 * \brief Tests whether frames are raw: spatial and temporal noise correlation, and total covariance over lags.
 *
 * Input 0 is the stack: frames of a static scene, for example flat fields, along the last axis. Inputs 1 "Mean" [DN]
 * and 2 "Mask" have the size of a frame. Pixels whose mask is 0 are left out; clipped pixels should be. Both are
 * optional, and TemporalStatisticsImageFilter gives them. If one is missing, the stack is read once more to find it.
 *
 * The output is a decorated sensornoise::CorrelationEstimate:
 *
 * - The record of the report (sensornoise::NoiseCorrelationRecord): the noise class, the correlation coefficients by
 *   lag [1], and the noise of whole rows and columns [DN], all with errors. The noise class is `white`, `crosstalk`,
 *   `filtered`, `temporal`, `enlarged`, `brighter-fatter`, `not-linear`, or `not-measured`. It is `not-measured` if
 *   there are fewer than 1024 pixels in 4 tiles.
 * - The total covariance over lags, relative to the variance [1]. A camera that smooths its frames lowers the variance,
 *   and a photon transfer curve of variance against mean then gives a gain that is too small. The variance or the gain,
 *   multiplied by the total covariance, is its value before the smoothing. This holds for any linear processing whose
 *   weights sum to 1. The total is given for all pixels, and for quarters of them from dark to bright, each with its
 *   signal and variance.
 *
 * Changes from frame to frame must not be counted as noise. The means of the frames (flicker, a drifting offset) are
 * removed by default. AddSeries() removes other series, for example FlickerCorrectionImageFilter::GetGamma() or motion.
 * If the scene has contrast, and illumination or camera position vary, use SensorNoiseEstimator. It finds all these
 * series and has this record in its report.
 *
 * The correlation is measured on square tiles that are distributed evenly over the frame, at most 131072 pixels and 256
 * frames. Frames that are equal to an earlier frame are left out. Standard errors are from a jackknife over the tiles.
 * The filter reads the stack once or twice, in chunks (see SensorNoiseStackSink). It is threaded. The result has the
 * same bits for any number of threads and chunks. Memory, in addition to one chunk: up to 70 MiB for the sample, and
 * about 20 bytes for each pixel of a frame, or 60 if the stack is read twice.
 *
 * P. Astier et al., A&A 629, A36, 2019, https://doi.org/10.1051/0004-6361/201935508, for flats; EMVA 1288 Release 4 for
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

  /** Temporal mean of every pixel of the stack [DN], which determines its signal. A pixel whose mean is NaN is left
   * out. Default: computed from the stack. */
  itkSetInputMacro(Mean, FrameImageType);
  itkGetInputMacro(Mean, FrameImageType);

  /** Mask of the pixels: pixels of value 0 are left out. By default the pixels that reach a clip level or are not
   * finite are left out. If the mask is given but the mean is not, these pixels are left out, too. */
  itkSetInputMacro(Mask, MaskImageType);
  itkGetInputMacro(Mask, MaskImageType);

  /** Adds a series over time, with a finite number in any unit for each frame. The component of every pixel that is
   * proportional to the series is removed; each pixel has its own factor. Default: no series. */
  void
  AddSeries(const std::vector<double> & series);
  /** Removes all series that were added. */
  void
  ClearSeries();
  /** Returns the number of series that were added. */
  SizeValueType
  GetNumberOfSeries() const
  {
    return m_Series.size();
  }

  /** Whether the means of the frames, plain and weighted with the signal, are removed in the same way as series. They
   * contain flicker and a drifting offset, which are common to all pixels. Default: on. If it is off, fluctuating
   * illumination appears as noise correlation. */
  itkSetMacro(RemoveFrameMeans, bool);
  itkGetConstMacro(RemoveFrameMeans, bool);
  itkBooleanMacro(RemoveFrameMeans);

  /** Dark offset [DN], which separates the component that grows with the signal from the constant component. Default
   * NaN: not known. The darkest level is then used if it is below 0.3 of the brightest level, else 0. */
  itkSetMacro(Offset, double);
  itkGetConstMacro(Offset, double);

  /** Quantization step [DN]. Quantization noise, step^2/12, has passed through no filter. Default 0: the step is found
   * from the stack. If the mean and the mask are given, the default is 1 for integer pixels and no step for
   * floating-point pixels. */
  itkSetMacro(QuantisationStep, double);
  itkGetConstMacro(QuantisationStep, double);

  /** Returns the result, as a pipeline output or as a struct. Valid after Update(). */
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

  /** Returns the result as JSON, schema "itk-sensornoise-correlation/1". Its member noise_correlation is the same as in
   * the report. */
  std::string
  GetResultAsJson() const
  {
    return sensornoise::ToJson(this->GetResult());
  }

  /** Returns the noise class: "white", "filtered" ... */
  std::string
  GetKind() const
  {
    return this->GetResult().correlation.kind;
  }

  /** Returns the total covariance over lags in space and time, relative to the variance [1]. If the noise class is not
   * white, multiply the variance and the slope by this number. NaN if the noise is not linear or not measured. */
  double
  GetSumOverLags() const
  {
    return this->GetResult().sumOverLags.value.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  /** Returns the standard error of GetSumOverLags() [1], including what lags beyond the last lag may add. NaN if the
   * total is NaN. */
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
  // Data that an update collects.
  struct Measurement;

  void
  FindMeanAndMask();

  std::vector<std::vector<double>> m_Series;
  bool                             m_RemoveFrameMeans{ true };
  double                           m_Offset{ std::numeric_limits<double>::quiet_NaN() };
  double                           m_QuantisationStep{ 0.0 };

  std::unique_ptr<Measurement> m_Measurement;
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT NoiseCorrelationEstimator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
