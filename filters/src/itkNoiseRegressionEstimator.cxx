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
#include "itkNoiseRegressionEstimator.h"

#include "itkSensorNoiseErrors.h"
#include "base/PolynomialFit.h"
#include "published/PublishedPasses.h"
#include "sensornoise/ReportPage.h"
#include "sensornoise/Report.h"

#include <cmath>
#include <optional>
#include <ostream>
#include <string>

namespace itk
{

template <typename TFrame>
NoiseRegressionEstimator<TFrame>::NoiseRegressionEstimator()
{
  this->SetPrimaryInputName("Mean");
  this->AddRequiredInputName("Variance", 1);
  this->AddRequiredInputName("Mask", 2);
  this->AddOptionalInputName("Offset", 3);
  this->SetNumberOfRequiredOutputs(1);
  this->ProcessObject::SetNthOutput(0, this->MakeOutput(0));
}

template <typename TFrame>
void
NoiseRegressionEstimator<TFrame>::GenerateData()
{
  const FrameImageType * mean = this->GetMean();
  const auto             region = mean->GetLargestPossibleRegion();
  if (this->GetVariance()->GetLargestPossibleRegion() != region ||
      this->GetMask()->GetLargestPossibleRegion() != region)
  {
    itkExceptionMacro("mean, variance and mask have the regions "
                      << region << this->GetVariance()->GetLargestPossibleRegion()
                      << this->GetMask()->GetLargestPossibleRegion() << "; expected the same");
  }
  const sensornoise::RegressionData data{ mean->GetBufferPointer(),
                                          this->GetVariance()->GetBufferPointer(),
                                          this->GetMask()->GetBufferPointer(),
                                          region.GetNumberOfPixels() };
  const auto *                      offsetInput = this->GetOffsetInput();
  std::optional<double>             offset;
  if (offsetInput != nullptr && std::isfinite(offsetInput->Get()))
  {
    offset = offsetInput->Get();
  }

  const sensornoise::PolynomialFit       line = sensornoise::FitLine(data);
  std::optional<sensornoise::FitQuality> quality;
  if (m_NumberOfFrames > 1)
  {
    quality = sensornoise::EvaluateLineFit(data, line, m_NumberOfFrames);
  }
  sensornoise::Report report;
  sensornoise::FileParameters(report, sensornoise::EstimateParameters(line, offset, std::nullopt, quality));
  report.method = "published";
  report.frames = m_NumberOfFrames;
  report.width = region.GetSize(0);
  report.height = region.GetSize(1);
  report.pixels.total = data.pixels;
  report.pixels.used = line.pixels;
  this->GetReportOutput()->Set(report);
}

template <typename TFrame>
std::string
NoiseRegressionEstimator<TFrame>::GetReportAsHtml() const
{
  return sensornoise::ToHtml(this->GetReport());
}

template <typename TFrame>
std::string
NoiseRegressionEstimator<TFrame>::GetReportAsSvg() const
{
  return sensornoise::ToSvg(this->GetReport());
}

template <typename TFrame>
std::string
NoiseRegressionEstimator<TFrame>::GetFigureAsJson() const
{
  return sensornoise::FigureAsJson(this->GetReport());
}

template <typename TFrame>
void
NoiseRegressionEstimator<TFrame>::UpdateOutputInformation()
{
  ResetAfterError(this, [this] { Superclass::UpdateOutputInformation(); });
}

template <typename TFrame>
void
NoiseRegressionEstimator<TFrame>::UpdateOutputData(DataObject * output)
{
  ResetAfterError(this, [this, output] { Superclass::UpdateOutputData(output); });
}

template <typename TFrame>
void
NoiseRegressionEstimator<TFrame>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfFrames: " << m_NumberOfFrames << std::endl;
}

template class NoiseRegressionEstimator<Image<double, 2>>;

} // namespace itk
