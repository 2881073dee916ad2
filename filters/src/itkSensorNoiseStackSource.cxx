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
#include "itkSensorNoiseStackSource.h"

#include "itkSensorNoiseErrors.h"
#include "base/FreeMemory.h"
#include "moments/Codes.h"
#include "simulation/FrameProcessing.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "itkImageRegionConstIterator.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace itk
{

namespace
{
/** Least memory of a simulation per pixel, measured [bytes]. */
constexpr double BytesPerPixel = 24.0;
/** Least memory of the temporal components per frame, measured [bytes]. */
constexpr double       BytesPerFrame = 40.0;
constexpr const char * Impossible = "the simulation is not possible: ";
} // namespace

template <typename TOutputStack>
SensorNoiseStackSource<TOutputStack>::SensorNoiseStackSource()
{
  this->SetPrimaryInputName("Reference");
  this->SetNumberOfRequiredInputs(1);
  this->DynamicMultiThreadingOn();
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetInput(unsigned int index, const ReferenceImageType * reference)
{
  if (index != 0)
  {
    itkExceptionMacro("input " << index << " was set; expected input 0, the reference image, only");
  }
  this->SetReference(reference);
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetCamera(char name)
{
  const sensornoise::CameraModel camera =
    WithItkErrors<std::invalid_argument>(this, [name] { return sensornoise::PaperCamera(name); }, Impossible);
  this->SetElectrons(camera.electrons);
  this->SetGain(camera.gainDnPerElectron);
  this->SetOffset(camera.offsetDn);
  this->SetReadNoise(camera.readNoiseDn);
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetConditions(int number)
{
  const sensornoise::SceneConditions conditions =
    WithItkErrors<std::invalid_argument>(this, [number] { return sensornoise::PaperConditions(number); }, Impossible);
  this->SetFlickerSd(conditions.flickerSd);
  this->SetVibrationSdX(conditions.vibrationSdXPixels);
  this->SetVibrationSdY(conditions.vibrationSdYPixels);
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetResponseShape(const std::string & name)
{
  const sensornoise::ResponseShape shape =
    WithItkErrors<std::invalid_argument>(this, [&name] { return sensornoise::ResponseShapeOf(name); }, Impossible);
  if (m_Flaws.response.shape != shape)
  {
    m_Flaws.response.shape = shape;
    this->Modified();
  }
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetBayerPattern(const std::string & name)
{
  std::optional<sensornoise::BayerPattern> pattern;
  if (name != "none")
  {
    pattern =
      WithItkErrors<std::invalid_argument>(this, [&name] { return sensornoise::BayerPatternOf(name); }, Impossible);
  }
  if (m_Flaws.filters.pattern != pattern)
  {
    m_Flaws.filters.pattern = pattern;
    this->Modified();
  }
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetInterpolation(sensornoise::Interpolation & interpolation,
                                                       const std::string &          name)
{
  const sensornoise::Interpolation wanted =
    WithItkErrors<std::invalid_argument>(this, [&name] { return sensornoise::InterpolationOf(name); }, Impossible);
  if (interpolation != wanted)
  {
    interpolation = wanted;
    this->Modified();
  }
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetBinningInterpolation(const std::string & name)
{
  this->SetInterpolation(m_Flaws.binning.interpolation, name);
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetResamplingInterpolation(const std::string & name)
{
  this->SetInterpolation(m_Flaws.resampling.interpolation, name);
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::SetIllumination(const std::string & text)
{
  m_Illumination =
    WithItkErrors<std::invalid_argument>(this, [&text] { return sensornoise::IlluminationOf(text); }, Impossible);
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
SensorNoiseStackSource<TOutputStack>::GenerateOutputInformation()
{
  const ReferenceImageType * reference = this->GetReference();
  OutputStackType *          stack = this->GetOutput();
  const auto                 frame = reference->GetLargestPossibleRegion();

  m_Truth = WithItkErrors(
    this,
    [&] {
      const sensornoise::SimulationSettings settings = this->MakeSettings();
      const double                          pixels = static_cast<double>(frame.GetNumberOfPixels());
      sensornoise::RequireMemory(BytesPerPixel * pixels + BytesPerFrame * static_cast<double>(settings.frames),
                                 "a stack of " + std::to_string(settings.frames) + " frames of " +
                                   std::to_string(frame.GetSize(0)) + " x " + std::to_string(frame.GetSize(1)) +
                                   " pixels");
      sensornoise::SimulationTruth truth = sensornoise::DrawTruth(settings, frame.GetSize(0), frame.GetSize(1));
      sensornoise::StackSimulator::CodeRange<OutputPixelType>(settings);
      return truth;
    },
    Impossible);

  OutputRegionType                        region;
  typename OutputStackType::SpacingType   spacing;
  typename OutputStackType::PointType     origin;
  typename OutputStackType::DirectionType direction;
  spacing.Fill(1.0);
  origin.Fill(0.0);
  direction.SetIdentity();
  for (unsigned int i = 0; i < 2; ++i)
  {
    region.SetIndex(i, frame.GetIndex(i));
    region.SetSize(i, frame.GetSize(i));
    spacing[i] = reference->GetSpacing()[i];
    origin[i] = reference->GetOrigin()[i];
    for (unsigned int j = 0; j < 2; ++j)
    {
      direction(i, j) = reference->GetDirection()(i, j);
    }
  }
  region.SetIndex(2, 0);
  region.SetSize(2, m_NumberOfFrames);
  stack->SetLargestPossibleRegion(region);
  stack->SetSpacing(spacing);
  stack->SetOrigin(origin);
  stack->SetDirection(direction);
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::GenerateInputRequestedRegion()
{
  // The base class of ITK would copy the requested region of the stack.
  const_cast<ReferenceImageType *>(this->GetReference())->SetRequestedRegionToLargestPossibleRegion();
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::UpdateOutputInformation()
{
  ResetAfterError(this, [this] { Superclass::UpdateOutputInformation(); });
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::UpdateOutputData(DataObject * output)
{
  ResetAfterError(this, [this, output] { Superclass::UpdateOutputData(output); });
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::GenerateData()
{
  if (!sensornoise::NeedsWholeFrames(m_Flaws))
  {
    Superclass::GenerateData();
    return;
  }
  this->AllocateOutputs();
  this->BeforeThreadedGenerateData();
  OutputStackType * stack = this->GetOutput();
  const auto        largest = stack->GetLargestPossibleRegion();
  const auto        region = stack->GetRequestedRegion();
  const std::size_t width = m_Simulator->GetWidth();
  const auto        firstColumn = static_cast<std::size_t>(region.GetIndex(0) - largest.GetIndex(0));
  const auto        firstRow = static_cast<std::size_t>(region.GetIndex(1) - largest.GetIndex(1));
  const auto        parallelFor = [this](std::size_t count, const std::function<void(std::size_t)> & function) {
    this->GetMultiThreader()->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
    this->GetMultiThreader()->ParallelizeArray(0, count, [&function](SizeValueType i) { function(i); }, nullptr);
  };
  std::vector<OutputPixelType> frame(width * m_Simulator->GetHeight());
  auto                         index = region.GetIndex();
  for (SizeValueType t = 0; t < region.GetSize(2); ++t, ++index[2])
  {
    m_Simulator->RenderFrame(static_cast<std::size_t>(index[2]), frame.data(), parallelFor);
    index[1] = region.GetIndex(1);
    for (SizeValueType y = 0; y < region.GetSize(1); ++y, ++index[1])
    {
      const OutputPixelType * row = frame.data() + (firstRow + y) * width + firstColumn;
      std::copy_n(row, region.GetSize(0), stack->GetBufferPointer() + stack->ComputeOffset(index));
    }
  }
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::BeforeThreadedGenerateData()
{
  const ReferenceImageType * reference = this->GetReference();
  if (m_Simulator && m_SimulatorTime.GetMTime() > std::max(this->GetMTime(), reference->GetMTime()))
  {
    return;
  }
  const auto          frame = reference->GetLargestPossibleRegion();
  std::vector<double> values;
  values.reserve(frame.GetNumberOfPixels());
  for (ImageRegionConstIterator<ReferenceImageType> it(reference, frame); !it.IsAtEnd(); ++it)
  {
    values.push_back(it.Get());
  }
  m_Simulator.reset();
  m_Simulator = WithItkErrors<std::invalid_argument>(
    this,
    [&] {
      return std::make_unique<const sensornoise::StackSimulator>(
        values, frame.GetSize(0), frame.GetSize(1), this->MakeSettings());
    },
    Impossible);
  m_SimulatorTime.Modified();
}

template <typename TOutputStack>
void
SensorNoiseStackSource<TOutputStack>::DynamicThreadedGenerateData(const OutputRegionType & region)
{
  OutputStackType * stack = this->GetOutput();
  const auto        largest = stack->GetLargestPossibleRegion();
  const auto        firstColumn = static_cast<std::size_t>(region.GetIndex(0) - largest.GetIndex(0));

  std::vector<OutputPixelType> row(m_Simulator->GetWidth());
  auto                         index = region.GetIndex();
  for (SizeValueType t = 0; t < region.GetSize(2); ++t)
  {
    index[2] = region.GetIndex(2) + static_cast<IndexValueType>(t);
    for (SizeValueType y = 0; y < region.GetSize(1); ++y)
    {
      index[1] = region.GetIndex(1) + static_cast<IndexValueType>(y);
      m_Simulator->RenderRow(
        static_cast<std::size_t>(index[2]), static_cast<std::size_t>(index[1] - largest.GetIndex(1)), row.data());
      std::copy_n(row.data() + firstColumn, region.GetSize(0), stack->GetBufferPointer() + stack->ComputeOffset(index));
    }
  }
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

#define SensorNoise_INSTANTIATE(TPixel) template class SensorNoiseStackSource<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
