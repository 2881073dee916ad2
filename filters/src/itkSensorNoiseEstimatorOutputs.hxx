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
#ifndef itkSensorNoiseEstimatorOutputs_hxx
#define itkSensorNoiseEstimatorOutputs_hxx

#include "itkSensorNoiseErrors.h"
#include "itkSensorNoiseEstimation.h"
#include "itkSensorNoiseEstimator.h"
#include "itkSensorNoiseMapContainer.h"
#include "itkSensorNoisePageMaps.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportPage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <variant>

/** \file
 * Outputs of SensorNoiseEstimator, and its report as text and pages. */

namespace itk
{

template <typename TStack>
auto
SensorNoiseEstimator<TStack>::MakeOutput(DataObjectPointerArraySizeType index) -> DataObjectPointer
{
  switch (index)
  {
    case 0:
      return ReportObjectType::New().GetPointer();
    case 4:
      return MaskImageType::New().GetPointer();
    case ChannelReportsOutput:
      return ChannelReportsObjectType::New().GetPointer();
    default:
      return FrameImageType::New().GetPointer();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::GenerateOutputInformation()
{
  this->CopyFrameInformation(this->GetMean());
  this->CopyFrameInformation(this->GetVariance());
  this->CopyFrameInformation(this->GetCorrectedVariance());
  this->CopyFrameInformation(this->GetPixelUse());
  const TStack * dark = this->GetDark();
  const bool     isCalibrated = dark != nullptr && dark->GetLargestPossibleRegion().GetSize(2) > 1;
  for (DataObjectPointerArraySizeType i = 0; i < 6; ++i)
  {
    auto * map = static_cast<FrameImageType *>(this->ProcessObject::GetOutput(FirstPixelOutput + i));
    this->CopyFrameInformation(map);
    if (!isCalibrated)
    {
      map->SetRegions(typename FrameImageType::RegionType{});
    }
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::EnlargeOutputRequestedRegion(DataObject *)
{
  for (DataObjectPointerArraySizeType i = 1; i < ChannelReportsOutput; ++i)
  {
    this->ProcessObject::GetOutput(i)->SetRequestedRegionToLargestPossibleRegion();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::FillOutputs()
{
  const auto allocate = [](auto * image) {
    image->SetBufferedRegion(image->GetLargestPossibleRegion());
    image->Allocate();
    return image->GetBufferPointer();
  };
  auto report = m_Estimation->GetReport(this->GetSource(), this->GetCamera());
  std::visit([this](auto & any) { any.input = this->GetInputRecord(); }, report);
  if (auto * const channels = std::get_if<sensornoise::ChannelReports>(&report))
  {
    this->GetChannelReportsOutput()->Set(std::move(*channels));
  }
  else
  {
    this->GetReportOutput()->Set(std::move(std::get<sensornoise::Report>(report)));
  }
  const std::size_t pixels = this->GetMean()->GetLargestPossibleRegion().GetNumberOfPixels();
  const auto        fill = [&](auto * image, auto missing, const auto & mapOf) {
    GiveToImage(image, m_Estimation->TakeMap(mapOf, missing, pixels));
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  fill(this->GetMean(), nan, [](auto & method) { return method.TakeMean(); });
  fill(this->GetVariance(), nan, [](auto & method) { return method.TakeVariance(); });
  fill(this->GetCorrectedVariance(), nan, [](auto & method) { return method.TakeCorrectedVariance(); });
  fill(this->GetPixelUse(), static_cast<unsigned char>(sensornoise::PixelUse::Border), [](auto & method) {
    return method.TakePixelUse();
  });
  if (const auto calibration = m_Estimation->MakeCalibration(this->GetParallelFor()))
  {
    const auto copy = [&](auto * image, const auto & values) {
      std::copy(values.begin(), values.end(), allocate(image));
    };
    copy(this->GetPixelOffset(), calibration->offset.value);
    copy(this->GetPixelOffsetLow(), calibration->offset.low);
    copy(this->GetPixelOffsetHigh(), calibration->offset.high);
    copy(this->GetPixelReadNoise(), calibration->readNoise.value);
    copy(this->GetPixelReadNoiseLow(), calibration->readNoise.low);
    copy(this->GetPixelReadNoiseHigh(), calibration->readNoise.high);
  }
}

template <typename TStack>
const sensornoise::Report &
SensorNoiseEstimator<TStack>::GetChannelReport(const std::string & channel) const
{
  const auto plane = WithItkErrors(this, [&channel] { return sensornoise::BayerPlaneOf(channel); });
  return this->GetChannelReports().Of(plane);
}

template <typename TStack>
std::string
SensorNoiseEstimator<TStack>::GetReportAsHtml() const
{
  const bool         isMosaic = this->HasChannelReports();
  const auto * const mean = static_cast<const FrameImageType *>(this->ProcessObject::GetOutput(1));
  const auto * const pixelUse = static_cast<const MaskImageType *>(this->ProcessObject::GetOutput(4));
  const auto         maps = PageMapsOf(mean, pixelUse);
  return isMosaic ? sensornoise::ToHtml(this->GetChannelReports(), maps) : sensornoise::ToHtml(this->GetReport(), maps);
}

template <typename TStack>
std::string
SensorNoiseEstimator<TStack>::GetReportAsSvg() const
{
  return sensornoise::ToSvg(this->HasChannelReports() ? this->GetChannelReport("G1") : this->GetReport());
}

template <typename TStack>
std::string
SensorNoiseEstimator<TStack>::GetChannelReportAsHtml(const std::string & channel) const
{
  return sensornoise::ToHtml(this->GetChannelReport(channel));
}

template <typename TStack>
std::string
SensorNoiseEstimator<TStack>::GetChannelReportAsSvg(const std::string & channel) const
{
  return sensornoise::ToSvg(this->GetChannelReport(channel));
}

template <typename TStack>
std::string
SensorNoiseEstimator<TStack>::GetFigureAsJson() const
{
  return this->HasChannelReports() ? sensornoise::FigureAsJson(this->GetChannelReports())
                                   : sensornoise::FigureAsJson(this->GetReport());
}

template <typename TStack>
sensornoise::NoiseModelCheck
SensorNoiseEstimator<TStack>::CheckModel(double varianceSlope,
                                         double totalIntercept,
                                         double readNoiseElectrons,
                                         double quantisationStep) const
{
  sensornoise::Report of;
  of.varianceSlope = sensornoise::Quantity::Identified(varianceSlope);
  of.totalIntercept = sensornoise::Quantity::Identified(totalIntercept);
  if (!std::isnan(readNoiseElectrons))
  {
    of.readNoiseElectrons = sensornoise::Quantity::Identified(readNoiseElectrons);
  }
  if (!std::isnan(quantisationStep))
  {
    of.quantisationStepDn = quantisationStep;
  }
  return WithItkErrors(this, [&] { return sensornoise::CheckReport(this->GetReport(), of); });
}

template <typename TStack>
std::string
SensorNoiseEstimator<TStack>::GetNoiseModelCheckAsJson(double varianceSlope,
                                                       double totalIntercept,
                                                       double readNoiseElectrons,
                                                       double quantisationStep) const
{
  return sensornoise::ToJson(this->CheckModel(varianceSlope, totalIntercept, readNoiseElectrons, quantisationStep));
}

template <typename TStack>
std::string
SensorNoiseEstimator<TStack>::GetNoiseModelCheckAsText(double varianceSlope,
                                                       double totalIntercept,
                                                       double readNoiseElectrons,
                                                       double quantisationStep) const
{
  return sensornoise::MakeTable(this->CheckModel(varianceSlope, totalIntercept, readNoiseElectrons, quantisationStep));
}

} // namespace itk

#endif
