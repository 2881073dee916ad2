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
#ifndef itkNoiseRegressionEstimator_h
#define itkNoiseRegressionEstimator_h

#include "SensorNoiseExport.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Report.h"
#include "itkImage.h"
#include "itkProcessObject.h"
#include "itkSensorNoiseResult.h"
#include "itkSimpleDataObjectDecorator.h"

#include <ostream>
#include <string>

namespace itk
{

/** \class NoiseRegressionEstimator
 * \brief Gain, intercept and read noise from the line through temporal variance against mean.
 *
 * Inputs, of a frame's size: 0 "Mean" of the stack [DN], 1 "Variance" of the flicker-corrected stack [DN^2], 2 "Mask"
 * (pixels that take part); and 3 "Offset" mu [DN], a decorated number, optional. Pixels whose variance is NaN are left
 * out. Output: a report in which gain, intercept, offset, read noise and, if NumberOfFrames is set, the fit's quality
 * are filled. Without an offset, or where it is NaN, offset and read noise are not-identifiable.
 *
 * Ordinary least squares in the order of the pixels: the same bits each time. Section 3.3 and (3.24) of F. Sur,
 * M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
 *
 * \tparam TFrame Image<double, 2>.
 * \ingroup SensorNoise
 */
template <typename TFrame = Image<double, 2>>
class ITK_TEMPLATE_EXPORT NoiseRegressionEstimator : public ProcessObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(NoiseRegressionEstimator);

  using Self = NoiseRegressionEstimator;
  using Superclass = ProcessObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using FrameImageType = TFrame;
  using MaskImageType = Image<unsigned char, 2>;
  using ReportObjectType = SensorNoiseResult<sensornoise::Report>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "NoiseRegressionEstimator";
  }

  using Superclass::SetInput;
  /** The mean, by the name that filters use. */
  void
  SetInput(const FrameImageType * mean)
  {
    this->SetMean(mean);
  }

  itkSetInputMacro(Mean, FrameImageType);
  itkGetInputMacro(Mean, FrameImageType);
  itkSetInputMacro(Variance, FrameImageType);
  itkGetInputMacro(Variance, FrameImageType);
  itkSetInputMacro(Mask, MaskImageType);
  itkGetInputMacro(Mask, MaskImageType);
  itkSetGetDecoratedInputMacro(Offset, double);

  /** Number of frames T of which the variance was taken; 0 (default): not known, the fit is not judged. */
  itkSetMacro(NumberOfFrames, SizeValueType);
  itkGetConstMacro(NumberOfFrames, SizeValueType);

  /** The result as a pipeline output, and itself; valid after Update(). */
  ReportObjectType *
  GetReportOutput()
  {
    return static_cast<ReportObjectType *>(this->ProcessObject::GetOutput(0));
  }
  const sensornoise::Report &
  GetReport() const
  {
    return static_cast<const ReportObjectType *>(this->ProcessObject::GetOutput(0))->Get();
  }
  /** The report as JSON, schema "itk-sensornoise-report/1". */
  std::string
  GetReportAsJson() const
  {
    return sensornoise::ToJson(this->GetReport());
  }
  /** The report as a table that a person can read, as `estimate-sensor-noise` prints it, and its warnings. */
  std::string
  GetReportAsText() const
  {
    return sensornoise::MakeText(this->GetReport());
  }
  /** The same as a page, as an SVG file and as the numbers of its figures: without a noise curve, which is of a stack.
   * \see SensorNoiseEstimator */
  std::string
  GetReportAsHtml() const;
  std::string
  GetReportAsSvg() const;
  std::string
  GetFigureAsJson() const;

  DataObject *
  GetOutput(unsigned int index)
  {
    return this->ProcessObject::GetOutput(index);
  }

  /** Resets the pipeline when an input could not be updated: ITK would otherwise take the next Update() for one that is
   * under way and return without a word and without a result. */
  void
  UpdateOutputInformation() override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  NoiseRegressionEstimator();
  ~NoiseRegressionEstimator() override = default;

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(DataObjectPointerArraySizeType) override
  {
    return ReportObjectType::New().GetPointer();
  }
  void
  GenerateData() override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  SizeValueType m_NumberOfFrames{ 0 };
};

// Instantiated once, in the library.
extern template class SensorNoise_EXPORT NoiseRegressionEstimator<Image<double, 2>>;

} // namespace itk

#endif
