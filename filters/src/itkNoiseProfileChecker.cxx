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
#include "itkNoiseProfileChecker.h"

#include "itkSensorNoiseErrors.h"
#include "itkSensorNoiseProfileFile.h"
#include "exports/NoiseProfile.h"

#include <ostream>
#include <string>
#include <vector>

namespace itk
{

void
NoiseProfileChecker::SetReport(const std::string & name)
{
  m_Report = this->EndReport(name);
  this->Modified();
}

void
NoiseProfileChecker::SetProfileValues(const std::string & name)
{
  m_Profile = this->EndReport(name);
  m_ProfileFile.clear();
  this->Modified();
}

void
NoiseProfileChecker::SetProfileFile(const std::string & name)
{
  m_ProfileFile = name;
  this->Modified();
}

std::vector<NoiseProfileChecker::Result>
NoiseProfileChecker::MakeResults() const
{
  const sensornoise::NoiseProfile profile =
    m_ProfileFile.empty() ? sensornoise::ReadNoiseProfile(m_Profile)
                          : sensornoise::ReadNoiseProfile(m_ProfileFile, sensornoise::ReadProfileBytes(m_ProfileFile));
  sensornoise::CameraNoise noise = sensornoise::ReadCameraNoise(m_Report, this->MakeExportSettings());
  sensornoise::FillProfileLevels(profile, noise);
  std::vector<Result> results;
  for (const auto & [channel, check, reason] : sensornoise::CheckStoredFrames(profile, m_Report, noise))
  {
    results.push_back({ channel,
                        reason,
                        check ? sensornoise::ToJson(*check) : std::string(),
                        check ? sensornoise::MakeTable(*check) : std::string() });
  }
  return results;
}

void
NoiseProfileChecker::Check()
{
  m_Results.clear();
  m_Results = WithItkErrors(this, [&] { return this->MakeResults(); });
}

void
NoiseProfileChecker::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Report: " << m_Report.name << '\n';
  os << indent << "Profile: " << (m_ProfileFile.empty() ? m_Profile.name : m_ProfileFile) << '\n';
  os << indent << "Channels: " << m_Results.size() << '\n';
}

} // namespace itk
