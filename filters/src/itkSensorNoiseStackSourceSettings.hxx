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
#ifndef itkSensorNoiseStackSourceSettings_hxx
#define itkSensorNoiseStackSourceSettings_hxx

#include "itkSensorNoiseErrors.h"
#include "itkSensorNoiseStackSource.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"

#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

/** \file Settings of SensorNoiseStackSource, and the settings of the simulation that follow from them. */

namespace itk
{

/** Begin of the messages of settings with which no stack can be simulated. */
constexpr const char * ImpossibleSimulation = "the simulation is not possible: ";

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetCamera(char name)
{
  const sensornoise::CameraModel camera =
    WithItkErrors<std::invalid_argument>(this, [name] { return sensornoise::PaperCamera(name); }, ImpossibleSimulation);
  this->SetElectrons(camera.electrons);
  this->SetGain(camera.gainDnPerElectron);
  this->SetOffset(camera.offsetDn);
  this->SetReadNoise(camera.readNoiseDn);
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetConditions(int number)
{
  const sensornoise::SceneConditions conditions = WithItkErrors<std::invalid_argument>(
    this, [number] { return sensornoise::PaperConditions(number); }, ImpossibleSimulation);
  this->SetFlickerSd(conditions.flickerSd);
  this->SetVibrationSdX(conditions.vibrationSdXPixels);
  this->SetVibrationSdY(conditions.vibrationSdYPixels);
}

template <typename TOutputStack>
template <typename TValue, typename TParse>
void
SensorNoiseStackSource<TOutputStack>::SetParsed(TValue & member, TParse parse)
{
  const TValue value = WithItkErrors<std::invalid_argument>(this, parse, ImpossibleSimulation);
  if (member != value)
  {
    member = value;
    this->Modified();
  }
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetResponseShape(const std::string & name)
{
  this->SetParsed(m_Flaws.response.shape, [&name] { return sensornoise::ResponseShapeOf(name); });
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetBayerPattern(const std::string & name)
{
  using Pattern = std::optional<sensornoise::BayerPattern>;
  this->SetParsed(m_Flaws.filters.pattern,
                  [&name] { return name == "none" ? Pattern() : Pattern(sensornoise::BayerPatternOf(name)); });
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetBinningInterpolation(const std::string & name)
{
  this->SetParsed(m_Flaws.binning.interpolation, [&name] { return sensornoise::InterpolationOf(name); });
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetResamplingInterpolation(const std::string & name)
{
  this->SetParsed(m_Flaws.resampling.interpolation, [&name] { return sensornoise::InterpolationOf(name); });
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetIllumination(const std::string & text)
{
  m_Illumination = WithItkErrors<std::invalid_argument>(
    this, [&text] { return sensornoise::IlluminationOf(text); }, ImpossibleSimulation);
  this->Modified();
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetIlluminationFactors(const std::vector<double> & factors)
{
  m_Illumination = {};
  m_Illumination.shape = sensornoise::IlluminationShape::Factors;
  m_Illumination.factors = factors;
  this->Modified();
}

template <typename TOutputStack>
sensornoise::SimulationSettings
SensorNoiseStackSource<TOutputStack>::MakeSettings() const
{
  sensornoise::SimulationSettings settings;
  settings.camera = { m_Electrons, m_Gain, m_Offset, m_ReadNoise };
  settings.conditions = { m_FlickerSd, m_VibrationSdX, m_VibrationSdY };
  settings.illumination = m_Illumination;
  settings.frames = m_NumberOfFrames;
  settings.bitDepth = m_BitDepth;
  settings.seed = m_Seed;
  settings.opticalBlurPixels = m_OpticalBlur;
  settings.rollingShutterPeriodRows = m_RollingShutterPeriod;
  if (m_ClipLow != NumericTraits<double>::NonpositiveMin())
  {
    settings.clipLowDn = m_ClipLow;
  }
  if (m_ClipHigh != NumericTraits<double>::max())
  {
    settings.clipHighDn = m_ClipHigh;
  }
  settings.prnuSd = m_PrnuSd;
  settings.dsnuSdDn = m_DsnuSd;
  settings.hotPixelFraction = m_HotPixelFraction;
  settings.hotPixelNoiseFactor = m_HotPixelNoiseFactor;
  settings.flaws = m_Flaws;
  settings.isDark = m_Dark;
  return settings;
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Electrons: " << m_Electrons << std::endl;
  os << indent << "Gain: " << m_Gain << std::endl;
  os << indent << "Offset: " << m_Offset << std::endl;
  os << indent << "ReadNoise: " << m_ReadNoise << std::endl;
  os << indent << "FlickerSd: " << m_FlickerSd << std::endl;
  os << indent << "VibrationSdX: " << m_VibrationSdX << std::endl;
  os << indent << "VibrationSdY: " << m_VibrationSdY << std::endl;
  os << indent << "Illumination: " << this->GetIllumination() << std::endl;
  os << indent << "NumberOfFrames: " << m_NumberOfFrames << std::endl;
  os << indent << "BitDepth: " << m_BitDepth << std::endl;
  os << indent << "Seed: " << m_Seed << std::endl;
  os << indent << "OpticalBlur: " << m_OpticalBlur << std::endl;
  os << indent << "RollingShutterPeriod: " << m_RollingShutterPeriod << std::endl;
  os << indent << "ClipLow: " << m_ClipLow << std::endl;
  os << indent << "ClipHigh: " << m_ClipHigh << std::endl;
  os << indent << "PrnuSd: " << m_PrnuSd << std::endl;
  os << indent << "DsnuSd: " << m_DsnuSd << std::endl;
  os << indent << "HotPixelFraction: " << m_HotPixelFraction << std::endl;
  os << indent << "HotPixelNoiseFactor: " << m_HotPixelNoiseFactor << std::endl;
  os << indent << "Dark: " << m_Dark << std::endl;
  os << indent << "BayerPattern: " << this->GetBayerPattern() << std::endl;
  os << indent << "TransmissionR: " << this->GetTransmissionR() << std::endl;
  os << indent << "TransmissionG: " << this->GetTransmissionG() << std::endl;
  os << indent << "TransmissionB: " << this->GetTransmissionB() << std::endl;
  os << indent << "GainSd: " << this->GetGainSd() << std::endl;
  os << indent << "ColumnGainSd: " << this->GetColumnGainSd() << std::endl;
  os << indent << "ColumnEfficiencySd: " << this->GetColumnEfficiencySd() << std::endl;
  os << indent << "ColumnOffsetSd: " << this->GetColumnOffsetSd() << std::endl;
  os << indent << "BrighterFatterPerElectron: " << this->GetBrighterFatterPerElectron() << std::endl;
  os << indent << "CouplingFraction: " << this->GetCouplingFraction() << std::endl;
  os << indent << "ReadNoiseSpread: " << this->GetReadNoiseSpread() << std::endl;
  os << indent << "ReadNoiseTailFraction: " << this->GetReadNoiseTailFraction() << std::endl;
  os << indent << "ReadNoiseTailSpread: " << this->GetReadNoiseTailSpread() << std::endl;
  os << indent << "ResponseShape: " << this->GetResponseShape() << std::endl;
  os << indent << "ResponseSize: " << this->GetResponseSize() << std::endl;
  os << indent << "ResponseFullScale: " << this->GetResponseFullScale() << std::endl;
  os << indent << "RowNoiseSd: " << this->GetRowNoiseSd() << std::endl;
  os << indent << "ColumnNoiseSd: " << this->GetColumnNoiseSd() << std::endl;
  os << indent << "BandingAmplitude: " << this->GetBandingAmplitude() << std::endl;
  os << indent << "BandingPeriod: " << this->GetBandingPeriod() << std::endl;
  os << indent << "DefectThresholdSd: " << this->GetDefectThresholdSd() << std::endl;
  os << indent << "TemporalFilterWeight: " << this->GetTemporalFilterWeight() << std::endl;
  os << indent << "MedianRadius: " << this->GetMedianRadius() << std::endl;
  os << indent << "SmoothingSd: " << this->GetSmoothingSd() << std::endl;
  os << indent << "BinningFactor: " << this->GetBinningFactor() << std::endl;
  os << indent << "BinningInterpolation: " << this->GetBinningInterpolation() << std::endl;
  os << indent << "ResamplingShiftX: " << this->GetResamplingShiftX() << std::endl;
  os << indent << "ResamplingShiftY: " << this->GetResamplingShiftY() << std::endl;
  os << indent << "ResamplingInterpolation: " << this->GetResamplingInterpolation() << std::endl;
  os << indent << "BlockQuality: " << this->GetBlockQuality() << std::endl;
  os << indent << "CompandingBits: " << this->GetCompandingBits() << std::endl;
  os << indent << "RepeatCount: " << this->GetRepeatCount() << std::endl;
  os << indent << "RepeatPeriod: " << this->GetRepeatPeriod() << std::endl;
  os << indent << "Simulator: " << (m_Simulator ? "built" : "none") << std::endl;
}

} // namespace itk

#endif
