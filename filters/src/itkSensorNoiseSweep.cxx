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
#include "itkSensorNoiseSweep.h"

#include "itkSensorNoiseErrors.h"
#include "report/JsonWriter.h"
#include "sweep/Setting.h"
#include "sweep/SweepSummary.h"


namespace itk
{
namespace
{
/** Returns the noise of the measured settings. */
template <typename TEntries>
sensornoise::MeasuredRange
RangeOfEntries(const TEntries & entries, const std::string & kind, const sensornoise::ExportSettings & settings)
{
  sensornoise::MeasuredRange range;
  range.kind = sensornoise::SettingKindOf(kind);
  for (const auto & entry : entries)
  {
    if (entry.reason.empty())
    {
      sensornoise::AddSetting(range, sensornoise::ReadCameraNoise(entry.report, settings), entry.setting);
    }
    else if (entry.setting > 0.0)
    {
      range.unmeasured[entry.setting] = entry.reason;
    }
  }
  return range;
}
} // namespace

void
SensorNoiseSweep::AddReport(const std::string & name, double setting)
{
  m_Entries.push_back({ name, setting, "", this->EndReport(name) });
  this->Modified();
}

void
SensorNoiseSweep::AddUnmeasured(const std::string & name, double setting, const std::string & reason)
{
  m_Entries.push_back({ name, setting, reason.empty() ? "no reason is known" : reason, {} });
  this->Modified();
}

void
SensorNoiseSweep::Summarise()
{
  WithItkErrors(this, [&] {
    std::vector<sensornoise::UnmeasuredSetting> unmeasured;
    for (const Entry & entry : m_Entries)
    {
      if (!entry.reason.empty())
      {
        unmeasured.push_back({ entry.name, IfKnown(entry.setting), entry.reason });
      }
    }
    const sensornoise::SweepSummary summary =
      sensornoise::SummariseSweep(RangeOfEntries(m_Entries, m_SettingKind, {}), unmeasured);
    m_SummaryAsJson = sensornoise::ToJson(summary);
    m_SummaryAsText = sensornoise::MakeText(summary);
    m_SummaryAsHtml = sensornoise::ToHtml(summary);
  });
}

sensornoise::NoiseExport
SensorNoiseSweep::MakeExport(const std::string & format, double setting) const
{
  sensornoise::ExportSettings settings = this->MakeExportSettings();
  settings.channel = m_Channel;
  settings.maxAnalogueIso = IfKnown(m_MaxAnalogueIso);
  sensornoise::MeasuredRange      range = RangeOfEntries(m_Entries, m_SettingKind, settings);
  const sensornoise::SweepSummary summary = sensornoise::SummariseSweep(RangeOfEntries(m_Entries, m_SettingKind, {}));
  if (summary.conversionSwitch)
  {
    range.switchBetween = { summary.conversionSwitch->below, summary.conversionSwitch->above };
  }
  range.offLine = sensornoise::SettingsOffLine(summary);
  std::string              note;
  const auto               chosen = sensornoise::ChooseSettings(range, format, IfKnown(setting), "of this sweep", note);
  sensornoise::NoiseExport made = sensornoise::ExportNoise(format, chosen);
  made.note += (made.note.empty() || note.empty() ? "" : " ") + note;
  return made;
}

void
SensorNoiseSweep::Export(const std::string & format, double setting)
{
  m_Export = {};
  m_Export = WithItkErrors(this, [&] { return this->MakeExport(format, setting); });
}

std::string
SensorNoiseSweep::GetSettingInNameAsJson(const std::string & name)
{
  const auto found = sensornoise::SettingInName(name);
  if (!found)
  {
    return "null";
  }
  std::string             text;
  sensornoise::JsonWriter json(text);
  json.Object([&] { json.Member("kind", sensornoise::NameOf(found->kind)).Member("value", found->value); });
  return text;
}

void
SensorNoiseSweep::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Settings: " << m_Entries.size() << '\n';
  os << indent << "SettingKind: " << m_SettingKind << '\n';
  os << indent << "Channel: " << m_Channel << '\n';
  os << indent << "MaxAnalogueIso: " << m_MaxAnalogueIso << '\n';
  os << indent << "Files: " << m_Export.files.size() << '\n';
}

} // namespace itk
