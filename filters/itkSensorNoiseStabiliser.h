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
#ifndef itkSensorNoiseStabiliser_h
#define itkSensorNoiseStabiliser_h

#include "SensorNoiseExport.h"
#include "sensornoise/NoiseModel.h"
#include "sensornoise/Report.h"
#include "itkImageToImageFilter.h"
#include "itkSensorNoiseResult.h"

#include <limits>
#include <ostream>

namespace itk
{

/** \class SensorNoiseStabiliser
 * \brief Base class of the filters that transform each pixel by a noise model, to stabilised values or back.
 *
 * The filters stream and are threaded over rows.
 *
 * \tparam TInputImage image of the values.
 * \tparam TOutputImage image of the same dimension.
 * \ingroup SensorNoise
 */
template <typename TInputImage, typename TOutputImage>
class ITK_TEMPLATE_EXPORT SensorNoiseStabiliser : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseStabiliser);

  using Self = SensorNoiseStabiliser;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using RegionType = typename TOutputImage::RegionType;

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseStabiliser";
  }

  /** Noise model, from a report: `variance_slope` a [DN/e-], above 0, and `total_intercept` b [DN^2], positive or
   * negative. Both must be set, here or by SetReport(). */
  itkSetMacro(VarianceSlope, double);
  itkGetConstMacro(VarianceSlope, double);
  itkSetMacro(TotalIntercept, double);
  itkGetConstMacro(TotalIntercept, double);

  /** Sets the slope and the intercept from a report, as SensorNoiseEstimator::GetReport() or GetReportOutput() return
   * it. Throws an ExceptionObject if one of them has no value or the slope is not above 0. Other quantities of the
   * report are not used. */
  void
  SetReport(const sensornoise::Report & report);
  void
  SetReport(const SensorNoiseResult<sensornoise::Report> * report);

  /** Resets the pipeline if an input cannot be updated. ITK would otherwise assume that the failed update is still in
   * progress, and the next Update() would return without an error and without a result. */
  void
  UpdateOutputInformation() override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  SensorNoiseStabiliser();
  ~SensorNoiseStabiliser() override = default;

  void
  VerifyPreconditions() const override;

  /** Transforms the rows of a region by \a transformRow(transform, input, number of pixels, output), and returns the
   * sum of the numbers that it returns. */
  template <typename TFunction>
  SizeValueType
  TransformRows(const RegionType & region, const TFunction & transformRow);

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  double m_VarianceSlope{ 0.0 };
  double m_TotalIntercept{ std::numeric_limits<double>::quiet_NaN() };
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkSensorNoiseStabiliser.hxx"
#endif

#endif
