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
#include "itkSingleImageNoiseEstimator.h"

#include "itkSensorNoiseMetaData.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/SingleImageMethod.h"
#include "moments/StackMaps.h"
#include "report/StackReport.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace itk
{

/** Data that an update collects. */
template <typename TStack>
struct SingleImageNoiseEstimator<TStack>::Measurement
{
  std::vector<std::uint8_t>                                mask;
  sensornoise::CameraSettings                              camera;
  std::optional<sensornoise::BayerPattern>                 pattern;
  sensornoise::BayerSource                                 source{ sensornoise::BayerSource::Given };
  std::optional<sensornoise::SingleImageMethod<PixelType>> method; ///< none before the first frame
};

template <typename TStack>
SingleImageNoiseEstimator<TStack>::SingleImageNoiseEstimator()
{
  this->SetNumberOfRequiredOutputs(1);
  this->ProcessObject::SetNthOutput(0, this->MakeOutput(0));
}

template <typename TStack>
SingleImageNoiseEstimator<TStack>::~SingleImageNoiseEstimator() = default;

template <typename TStack>
void
SingleImageNoiseEstimator<TStack>::StartPasses()
{
  m_Measurement = std::make_unique<Measurement>();
  m_Measurement->camera = sensornoise::CameraSettingsOf(this->GetInput()->GetMetaDataDictionary());
  m_Measurement->mask = this->ReadMask();
}

template <typename TStack>
void
SingleImageNoiseEstimator<TStack>::StartMeasurement(const PixelType * firstFrame)
{
  using sensornoise::BayerSource;
  const auto                       size = this->GetFrameRegion().GetSize();
  const sensornoise::FrameGeometry frame{ size[0], size[1], 1 };
  const std::string &              inFile = m_Measurement->camera.bayerPattern;
  if (m_BayerPattern == "auto" && inFile.empty())
  {
    m_Measurement->pattern =
      sensornoise::RecogniseMosaic(firstFrame, frame.width, frame.height, this->GetParallelFor());
    m_Measurement->source = BayerSource::Levels;
  }
  else if (m_BayerPattern != "none")
  {
    m_Measurement->pattern = sensornoise::BayerPatternOf(m_BayerPattern == "auto" ? inFile : m_BayerPattern);
    m_Measurement->source = m_BayerPattern == "auto" ? BayerSource::File : BayerSource::Given;
  }
  sensornoise::SingleImageSettings settings;
  settings.bayerPattern = m_Measurement->pattern;
  settings.excessNoiseFactor = this->GetExcessNoiseFactor();
  settings.dnSettings = sensornoise::MakeDnSettings(
    this->GetBitDepth(), this->GetClipLow(), this->GetClipHigh(), this->GetQuantisationStep());
  m_Measurement->method.emplace(
    settings, frame, this->GetNumberOfFrames(), m_Measurement->mask, this->GetParallelFor());
}

template <typename TStack>
void
SingleImageNoiseEstimator<TStack>::ProcessFrames(unsigned int,
                                                 const PixelType * frames,
                                                 SizeValueType     first,
                                                 SizeValueType     count)
{
  if (first == 0)
  {
    this->StartMeasurement(frames);
  }
  m_Measurement->method->AddFrames(frames, count);
}

template <typename TStack>
void
SingleImageNoiseEstimator<TStack>::EndPass(unsigned int)
{
  std::vector<sensornoise::Report> reports = m_Measurement->method->GetReports();
  for (sensornoise::Report & report : reports)
  {
    report.camera = m_Measurement->camera;
    sensornoise::NoteSelection(report, this->GetSource());
  }
  if (m_Measurement->pattern)
  {
    std::array<sensornoise::Report, 4> channels;
    std::move(reports.begin(), reports.end(), channels.begin());
    auto result = sensornoise::MakeChannelReports(*m_Measurement->pattern, m_Measurement->source, std::move(channels));
    result.input = this->GetInputRecord();
    this->GetResultOutput()->Set(std::move(result));
  }
  else
  {
    reports.front().input = this->GetInputRecord();
    this->GetResultOutput()->Set(std::move(reports.front()));
  }
  m_Measurement.reset();
}

template <typename TStack>
void
SingleImageNoiseEstimator<TStack>::DropPasses()
{
  m_Measurement.reset();
}

template <typename TStack>
std::string
SingleImageNoiseEstimator<TStack>::GetReportAsJson() const
{
  return std::visit([](const auto & report) { return sensornoise::ToJson(report); }, this->GetResult());
}

template <typename TStack>
std::string
SingleImageNoiseEstimator<TStack>::GetReportAsText() const
{
  return std::visit([](const auto & report) { return sensornoise::MakeText(report); }, this->GetResult());
}

template <typename TStack>
void
SingleImageNoiseEstimator<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "BayerPattern: " << m_BayerPattern << std::endl;
}

#define SensorNoise_INSTANTIATE(TPixel) template class SingleImageNoiseEstimator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
