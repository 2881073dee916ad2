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
#ifndef itkSensorNoiseStabiliser_hxx
#define itkSensorNoiseStabiliser_hxx

#include "itkSensorNoiseErrors.h"
#include "sensornoise/NoiseModel.h"
#include "itkImageScanlineIterator.h"

#include <cstddef>
#include <ostream>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
SensorNoiseStabiliser<TInputImage, TOutputImage>::SensorNoiseStabiliser()
{
  this->DynamicMultiThreadingOn();
}

template <typename TInputImage, typename TOutputImage>
void
SensorNoiseStabiliser<TInputImage, TOutputImage>::SetReport(const sensornoise::Report & report)
{
  const sensornoise::NoiseModel model = WithItkErrors(this, [&report] { return sensornoise::NoiseModelOf(report); });
  this->SetVarianceSlope(model.varianceSlopeDn);
  this->SetTotalIntercept(model.totalInterceptDn2);
}

template <typename TInputImage, typename TOutputImage>
void
SensorNoiseStabiliser<TInputImage, TOutputImage>::SetReport(const SensorNoiseResult<sensornoise::Report> * report)
{
  if (report == nullptr)
  {
    itkExceptionMacro("the report is null; expected the report of a SensorNoiseEstimator");
  }
  this->SetReport(report->Get());
}

template <typename TInputImage, typename TOutputImage>
void
SensorNoiseStabiliser<TInputImage, TOutputImage>::VerifyPreconditions() const
{
  Superclass::VerifyPreconditions();
  WithItkErrors(this, [this] { sensornoise::NoiseModel{ m_VarianceSlope, m_TotalIntercept }.Validate(); });
}

template <typename TInputImage, typename TOutputImage>
template <typename TFunction>
SizeValueType
SensorNoiseStabiliser<TInputImage, TOutputImage>::TransformRows(const RegionType & region,
                                                                const TFunction &  transformRow)
{
  const sensornoise::GeneralizedAnscombe transform({ m_VarianceSlope, m_TotalIntercept });
  const TInputImage * const              input = this->GetInput();
  TOutputImage * const                   output = this->GetOutput();
  const auto                             size = static_cast<std::size_t>(region.GetSize(0));
  SizeValueType                          counted = 0;
  for (ImageScanlineConstIterator<TOutputImage> line(output, region); !line.IsAtEnd(); line.NextLine())
  {
    const auto start = line.GetIndex();
    counted += transformRow(transform,
                            input->GetBufferPointer() + input->ComputeOffset(start),
                            size,
                            output->GetBufferPointer() + output->ComputeOffset(start));
  }
  return counted;
}

template <typename TInputImage, typename TOutputImage>
void
SensorNoiseStabiliser<TInputImage, TOutputImage>::UpdateOutputInformation()
{
  ResetAfterError(this, [this] { Superclass::UpdateOutputInformation(); });
}

template <typename TInputImage, typename TOutputImage>
void
SensorNoiseStabiliser<TInputImage, TOutputImage>::UpdateOutputData(DataObject * output)
{
  ResetAfterError(this, [this, output] { Superclass::UpdateOutputData(output); });
}

template <typename TInputImage, typename TOutputImage>
void
SensorNoiseStabiliser<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "VarianceSlope: " << m_VarianceSlope << std::endl;
  os << indent << "TotalIntercept: " << m_TotalIntercept << std::endl;
}

} // namespace itk

#endif
