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
#ifndef itkSensorNoiseEstimatorSettings_hxx
#define itkSensorNoiseEstimatorSettings_hxx

#include "itkSensorNoiseErrors.h"
#include "itkSensorNoiseEstimator.h"
#include "itkSensorNoiseMetaData.h"
#include "base/FreeMemory.h"
#include "sensornoise/Settings.h"
#include "moments/Exposures.h"
#include "report/StackReport.h"

#include <cmath>
#include <optional>
#include <ostream>
#include <string>

/** \file Settings of SensorNoiseEstimator, their checks against the inputs, and the settings of the methods that follow
 * from them. */

namespace itk
{

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetMethod(MethodEnum method)
{
  if (m_Method != method)
  {
    m_Method = method;
    this->Modified();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetMethod(const std::string & name)
{
  if (name != "refined" && name != "published")
  {
    itkExceptionMacro("the method is \"" << name << "\"; expected refined or published");
  }
  this->SetMethod(name == "refined" ? MethodEnum::Refined : MethodEnum::Published);
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetRollingShutter(const std::string & name)
{
  this->SetRollingShutter(WithItkErrors(this, [&name] { return sensornoise::RollingShutterOf(name); }));
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetRollingShutter(RollingShutterEnum mode)
{
  if (m_RollingShutter != mode)
  {
    m_RollingShutter = mode;
    this->Modified();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetBayerPattern(const std::string & name)
{
  if (name != "none" && name != "auto")
  {
    WithItkErrors(this, [&name] { return sensornoise::BayerPatternOf(name); });
  }
  m_BayerSource = sensornoise::BayerSource::Given;
  if (m_BayerPattern != name)
  {
    m_BayerPattern = name;
    this->Modified();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetExposures(const std::vector<double> & exposures)
{
  WithItkErrors(this, [&] { sensornoise::ValidateExposures(exposures); });
  if (m_Exposures != exposures)
  {
    m_Exposures = exposures;
    this->Modified();
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetDarkHash(const std::string & sha256, SizeValueType files, SizeValueType bytes)
{
  m_DarkHash = WithItkErrors(this, [&] { return sensornoise::InputFilesOf(sha256, files, bytes); });
  this->Modified();
}

template <typename TStack>
std::optional<sensornoise::InputRecord>
SensorNoiseEstimator<TStack>::GetInputRecord() const
{
  std::optional<sensornoise::InputRecord> record = Superclass::GetInputRecord();
  if (record && this->GetDark() != nullptr && !m_DarkHash.sha256.empty())
  {
    record->dark = m_DarkHash;
  }
  return record;
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::VerifyInputInformation() const
{
  Superclass::VerifyInputInformation();
  const auto   region = this->GetInput()->GetLargestPossibleRegion();
  const double pixels = static_cast<double>(region.GetSize(0)) * static_cast<double>(region.GetSize(1));
  const double bytesPerPixel = m_Method == MethodEnum::Refined ? 56.0 : 40.0; // plus 8 per temporal component
  WithItkErrors(this, [&] {
    sensornoise::RequireMemory(bytesPerPixel * pixels,
                               "the estimate of frames of " + std::to_string(region.GetSize(0)) + " x " +
                                 std::to_string(region.GetSize(1)) + " pixels");
  });
  WithItkErrors(this, [&] {
    this->RequireUsedSettings();
    if (m_Method == MethodEnum::Refined)
    {
      this->MakeRefinedSettings().Validate();
    }
    else
    {
      this->MakePublishedSettings().Validate();
    }
    sensornoise::RequireExposuresOfFrames(m_Exposures, region.GetSize(2));
  });
  if (m_Method == MethodEnum::Published && m_MemoryLimit > 0 &&
      static_cast<double>(m_MemoryLimit) < bytesPerPixel * pixels)
  {
    itkExceptionMacro("the memory limit is "
                      << sensornoise::TextOfBytes(static_cast<double>(m_MemoryLimit)) << "; expected at least "
                      << sensornoise::TextOfBytes(bytesPerPixel * pixels) << " for the method published");
  }
  const TStack * dark = this->GetDark();
  if (dark == nullptr)
  {
    return;
  }
  if (!std::isnan(m_Offset))
  {
    itkExceptionMacro("the offset " << m_Offset << " DN and dark frames were given; expected one of them");
  }
  const auto size = dark->GetLargestPossibleRegion().GetSize();
  const auto frame = this->GetFrameRegion().GetSize();
  if (size[0] != frame[0] || size[1] != frame[1])
  {
    itkExceptionMacro("the dark frames have " << size[0] << " x " << size[1] << " pixels, but the frames have "
                                              << frame[0] << " x " << frame[1]);
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::RequireUsedSettings() const
{
  const std::string method = this->GetMethodName();
  if (!std::isnan(m_Offset))
  {
    sensornoise::RequireUsed(method, "offset", "the offset");
  }
  if (this->GetDark() != nullptr)
  {
    sensornoise::RequireUsed(method, "dark", "dark frames");
  }
  if (this->HasLevelRange())
  {
    sensornoise::RequireUsed(method, "level_range", "a range of levels");
  }
  if (!m_Exposures.empty())
  {
    sensornoise::RequireUsed(method, "exposures", "exposures");
  }
}

template <typename TStack>
std::string
SensorNoiseEstimator<TStack>::ReasonUnused(const std::string & method, const std::string & setting)
{
  return sensornoise::ReasonUnused(method, setting);
}

template <typename TStack>
bool
SensorNoiseEstimator<TStack>::HasLevelRange() const
{
  return m_LevelRangeLow != NumericTraits<double>::NonpositiveMin() || m_LevelRangeHigh != NumericTraits<double>::max();
}

template <typename TStack>
sensornoise::PublishedSettings
SensorNoiseEstimator<TStack>::MakePublishedSettings() const
{
  sensornoise::PublishedSettings settings;
  settings.level = m_Level;
  settings.brightQuantile = m_BrightQuantile;
  settings.darkQuantile = m_DarkQuantile;
  settings.rollingShutter = m_RollingShutter;
  settings.sigmaRows = m_SigmaRows;
  settings.shutterAxis = m_ShutterAxis;
  settings.excessNoiseFactor = this->GetExcessNoiseFactor();
  settings.dnSettings = this->MakeDnSettings();
  return settings;
}

template <typename TStack>
sensornoise::CameraSettings
SensorNoiseEstimator<TStack>::GetCamera() const
{
  return sensornoise::CameraSettingsOf(this->GetInput()->GetMetaDataDictionary());
}

template <typename TStack>
sensornoise::DnSettings
SensorNoiseEstimator<TStack>::MakeDnSettings() const
{
  const sensornoise::CameraSettings camera = this->GetCamera();
  const unsigned int                bitDepth = this->GetBitDepth();
  const double                      clipHigh = this->GetClipHigh();
  return sensornoise::MakeDnSettings(bitDepth > 0 ? bitDepth : camera.bitDepth,
                                     this->GetClipLow(),
                                     std::isnan(clipHigh) ? camera.whiteLevelDn : clipHigh,
                                     this->GetQuantisationStep());
}

template <typename TStack>
sensornoise::RefinedSettings
SensorNoiseEstimator<TStack>::MakeRefinedSettings() const
{
  sensornoise::RefinedSettings settings;
  settings.rollingShutter = m_RollingShutter;
  settings.dnSettings = this->MakeDnSettings();
  if (this->HasLevelRange())
  {
    settings.levelRangeDn = sensornoise::LevelRange{ m_LevelRangeLow, m_LevelRangeHigh };
  }
  settings.exposures = m_Exposures;
  settings.excessNoiseFactor = this->GetExcessNoiseFactor();
  if (m_MemoryLimit > 0)
  {
    settings.memoryLimitBytes = static_cast<double>(m_MemoryLimit);
  }
  return settings;
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethodName() << std::endl;
  os << indent << "Offset: " << m_Offset << std::endl;
  os << indent << "OffsetStandardError: " << m_OffsetStandardError << std::endl;
  os << indent << "Level: " << m_Level << std::endl;
  os << indent << "BrightQuantile: " << m_BrightQuantile << std::endl;
  os << indent << "DarkQuantile: " << m_DarkQuantile << std::endl;
  os << indent << "RollingShutter: " << sensornoise::NameOf(m_RollingShutter) << std::endl;
  os << indent << "SigmaRows: " << m_SigmaRows << std::endl;
  os << indent << "ShutterAxis: " << m_ShutterAxis << std::endl;
  os << indent << "LevelRangeLow: " << m_LevelRangeLow << std::endl;
  os << indent << "LevelRangeHigh: " << m_LevelRangeHigh << std::endl;
  os << indent << "Exposures: " << m_Exposures.size() << std::endl;
  os << indent << "MemoryLimit: " << m_MemoryLimit << std::endl;
  os << indent << "BayerPattern: " << m_BayerPattern << std::endl;
  os << indent << "DarkHash: " << m_DarkHash.sha256 << std::endl;
}

} // namespace itk

#endif
