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
 * \brief Estimates gain, intercept and read noise from the line through temporal variance against mean.
 *
 * Inputs of the size of a frame: 0 "Mean" of the stack [DN], 1 "Variance" of the flicker-corrected stack [DN^2], 2
 * "Mask" (pixels that are used). Input 3 "Offset" is mu [DN], a decorated number, and is optional. Pixels whose
 * variance is NaN are left out. The output is a report with gain, intercept, offset, read noise and, if NumberOfFrames
 * is set, the quality of the fit. Without an offset, or if it is NaN, offset and read noise are not-identifiable.
 *
 * The fit is ordinary least squares in the order of the pixels, and gives the same bits each time. Section 3.3 and
 * (3.24) of F. Sur, M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
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
  /** Sets the mean, by the name that filters use. */
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

  /** Number of frames T from which the variance was computed. Default 0: not known, and the quality of the fit is not
   * tested. */
  itkSetMacro(NumberOfFrames, SizeValueType);
  itkGetConstMacro(NumberOfFrames, SizeValueType);

  /** Returns the report, as a pipeline output or as a struct. Valid after Update(). */
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
  /** Returns the report as JSON, schema "itk-sensornoise-report/1". */
  std::string
  GetReportAsJson() const
  {
    return sensornoise::ToJson(this->GetReport());
  }
  /** Returns the report as a readable table with its warnings, as `estimate-sensor-noise` prints it. */
  std::string
  GetReportAsText() const
  {
    return sensornoise::MakeText(this->GetReport());
  }
  /** Returns the report as an HTML page, as an SVG file, and as JSON with the numbers of its figures. There is no noise
   * curve, because it needs a stack. \see SensorNoiseEstimator */
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

  /** Resets the pipeline if an input cannot be updated. ITK would otherwise assume that the failed update is still in
   * progress, and the next Update() would return without an error and without a result. */
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

// The library instantiates this class once.
extern template class SensorNoise_EXPORT NoiseRegressionEstimator<Image<double, 2>>;

} // namespace itk

#endif
