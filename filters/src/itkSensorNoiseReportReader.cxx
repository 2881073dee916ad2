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
#include "itkSensorNoiseReportReader.h"

#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

namespace itk
{

void
SensorNoiseReportReader::SetNumber(const std::string & pointer, double number)
{
  m_Values.numbers[pointer] = number;
}

void
SensorNoiseReportReader::SetText(const std::string & pointer, const std::string & text)
{
  m_Values.texts[pointer] = text;
}

sensornoise::StoredReport
SensorNoiseReportReader::EndReport(const std::string & name)
{
  m_Values.name = name;
  return std::exchange(m_Values, {});
}

std::optional<double>
SensorNoiseReportReader::IfKnown(double number)
{
  return std::isnan(number) ? std::nullopt : std::optional<double>(number);
}

sensornoise::ExportSettings
SensorNoiseReportReader::MakeExportSettings() const
{
  sensornoise::ExportSettings settings;
  settings.blackLevelDn = IfKnown(m_BlackLevel);
  settings.whiteLevelDn = IfKnown(m_WhiteLevel);
  settings.analogueGain = m_AnalogueGain;
  return settings;
}

void
SensorNoiseReportReader::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "BlackLevel: " << m_BlackLevel << '\n';
  os << indent << "WhiteLevel: " << m_WhiteLevel << '\n';
  os << indent << "AnalogueGain: " << m_AnalogueGain << '\n';
}

} // namespace itk
