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
#ifndef itkSensorNoiseEstimator_hxx
#define itkSensorNoiseEstimator_hxx

#include "itkSensorNoiseDarkSink.h"
#include "itkSensorNoiseErrors.h"
#include "itkSensorNoiseEstimation.h"
#include "itkSensorNoiseMapContainer.h"
#include "itkSensorNoiseMetaData.h"
#include "itkSensorNoisePageMaps.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/FreeMemory.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/moments/Codes.h"
#include "sensornoise/moments/MosaicLevels.h"
#include "sensornoise/moments/KnownOffset.h"
#include "sensornoise/moments/TemporalMoments.h"
#include "sensornoise/page/FigureJson.h"
#include "sensornoise/page/ReportPage.h"
#include "sensornoise/published/PublishedSettings.h"
#include "sensornoise/refined/RefinedSettings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace itk
{

/** Defined here: what reads the header alone, as wrapping does, need not read the methods. */
template <typename TStack>
struct SensorNoiseEstimator<TStack>::Estimation : SensorNoiseEstimation<PixelType>
{};

template <typename TStack>
SensorNoiseEstimator<TStack>::SensorNoiseEstimator()
{
  this->AddOptionalInputName("Mask", 1);
  this->AddOptionalInputName("Dark", 2);
  constexpr DataObjectPointerArraySizeType outputs = ChannelReportsOutput + 1;
  this->SetNumberOfRequiredOutputs(outputs);
  for (DataObjectPointerArraySizeType i = 0; i < outputs; ++i)
  {
    this->ProcessObject::SetNthOutput(i, this->MakeOutput(i));
  }
}

template <typename TStack>
SensorNoiseEstimator<TStack>::~SensorNoiseEstimator() = default;

template <typename TStack>
unsigned int
SensorNoiseEstimator<TStack>::NumberOfPasses() const
{
  return SensorNoiseEstimation<PixelType>::Refined::NumberOfPasses;
}

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
const sensornoise::Report &
SensorNoiseEstimator<TStack>::GetChannelReport(const std::string & channel) const
{
  const auto plane = WithItkErrors(this, [&channel] { return sensornoise::BayerPlaneOf(channel); });
  return this->GetChannelReports().Of(plane);
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetSourceRegion(SizeValueType x,
                                              SizeValueType y,
                                              SizeValueType width,
                                              SizeValueType height)
{
  m_Source.roi = { x, y, width, height };
  this->Modified();
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetSourceFrames(SizeValueType first, SizeValueType end)
{
  m_Source.frames = { first, end };
  this->Modified();
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetHash(sensornoise::InputFiles & input,
                                      const std::string &       sha256,
                                      SizeValueType             files,
                                      SizeValueType             bytes)
{
  const bool hasOnlyDigits = sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!sha256.empty() && (sha256.size() != 64 || !hasOnlyDigits))
  {
    itkExceptionMacro("the hash is \"" << sha256 << "\"; expected a SHA-256, 64 hexadecimal digits in small letters");
  }
  input = { sha256, files, bytes };
  this->Modified();
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetFramesHash(const std::string & sha256, SizeValueType files, SizeValueType bytes)
{
  this->SetHash(m_FramesHash, sha256, files, bytes);
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::SetDarkHash(const std::string & sha256, SizeValueType files, SizeValueType bytes)
{
  this->SetHash(m_DarkHash, sha256, files, bytes);
}

template <typename TStack>
std::optional<sensornoise::InputRecord>
SensorNoiseEstimator<TStack>::GetInputRecord() const
{
  if (m_FramesHash.sha256.empty())
  {
    return std::nullopt;
  }
  sensornoise::InputRecord record{ m_FramesHash, std::nullopt };
  if (this->GetDark() != nullptr && !m_DarkHash.sha256.empty())
  {
    record.dark = m_DarkHash;
  }
  return record;
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::VerifySource() const
{
  const auto size = this->GetInput()->GetLargestPossibleRegion().GetSize();
  if (const auto & roi = m_Source.roi; roi && ((*roi)[2] != size[0] || (*roi)[3] != size[1]))
  {
    itkExceptionMacro("the source's region has " << (*roi)[2] << " x " << (*roi)[3] << " pixels, but the frames have "
                                                 << size[0] << " x " << size[1]);
  }
  if (const auto & frames = m_Source.frames; frames && frames->second != frames->first + size[2])
  {
    itkExceptionMacro("the source's frames are " << frames->first << " up to " << frames->second
                                                 << ", but the stack has " << size[2]);
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::VerifyInputInformation() const
{
  this->VerifySource();
  const auto   region = this->GetInput()->GetLargestPossibleRegion();
  const double pixels = static_cast<double>(region.GetSize(0)) * static_cast<double>(region.GetSize(1));
  const double bytesPerPixel = m_Method == MethodEnum::Refined ? 56.0 : 40.0; // more with every series that is found
  WithItkErrors(this, [&] {
    sensornoise::RequireMemory(bytesPerPixel * pixels,
                               "the estimate of frames of " + std::to_string(region.GetSize(0)) + " x " +
                                 std::to_string(region.GetSize(1)) + " pixels");
  });
  const MaskImageType * mask = this->GetMask();
  if (mask != nullptr && mask->GetLargestPossibleRegion() != this->GetFrameRegion())
  {
    itkExceptionMacro("the mask has the region " << mask->GetLargestPossibleRegion() << "but the frames have "
                                                 << this->GetFrameRegion());
  }
  const TStack * dark = this->GetDark();
  const bool     hasOffset = !std::isnan(m_Offset);
  if (m_Method == MethodEnum::Published && (dark != nullptr || hasOffset))
  {
    itkExceptionMacro(
      "" << (hasOffset ? "the offset" : "dark frames") << " cannot be used by the method published, "
         << "which finds the offset from the flicker alone: leave it out, or set the method to refined");
  }
  if (m_Method == MethodEnum::Published && this->HasLevelRange())
  {
    itkExceptionMacro("the range of levels " << m_LevelRangeLow << " to " << m_LevelRangeHigh
                                             << " DN cannot be used by the method published, which fits all levels: "
                                             << "leave it out, or set the method to refined");
  }
  if (m_Method == MethodEnum::Published && m_MemoryLimit > 0 &&
      static_cast<double>(m_MemoryLimit) < bytesPerPixel * pixels)
  {
    itkExceptionMacro("the memory limit is "
                      << sensornoise::TextOfBytes(static_cast<double>(m_MemoryLimit)) << "; expected at least "
                      << sensornoise::TextOfBytes(bytesPerPixel * pixels) << " for the method published");
  }
  if (dark == nullptr)
  {
    return;
  }
  if (hasOffset)
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
SensorNoiseEstimator<TStack>::GenerateNthInputRequestedRegion(unsigned int number)
{
  Superclass::GenerateNthInputRequestedRegion(number);
  if (auto * dark = const_cast<TStack *>(this->GetDark()))
  {
    // They have been read before the first pass. Without this the pipeline would read them again, and whole.
    auto region = dark->GetLargestPossibleRegion();
    region.SetSize(2, 1);
    dark->SetRequestedRegion(region);
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
SensorNoiseEstimator<TStack>::GetReportAsHtml() const
{
  const bool         isMosaic = this->HasChannelReports(); // first: says whether there is a result
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
  settings.codes = this->MakeCodeSettings();
  return settings;
}

template <typename TStack>
sensornoise::CameraSettings
SensorNoiseEstimator<TStack>::GetCamera() const
{
  return sensornoise::CameraSettingsOf(this->GetInput()->GetMetaDataDictionary());
}

template <typename TStack>
sensornoise::CodeSettings
SensorNoiseEstimator<TStack>::MakeCodeSettings() const
{
  const sensornoise::CameraSettings camera = this->GetCamera();
  return sensornoise::MakeCodeSettings(m_BitDepth > 0 ? m_BitDepth : camera.bitDepth,
                                       m_ClipLow,
                                       std::isnan(m_ClipHigh) ? camera.whiteLevelDn : m_ClipHigh,
                                       m_QuantisationStep);
}

template <typename TStack>
sensornoise::RefinedSettings
SensorNoiseEstimator<TStack>::MakeRefinedSettings() const
{
  sensornoise::RefinedSettings settings;
  settings.rollingShutter = m_RollingShutter;
  settings.codes = this->MakeCodeSettings();
  if (this->HasLevelRange())
  {
    settings.levelRangeDn = sensornoise::LevelRange{ m_LevelRangeLow, m_LevelRangeHigh };
  }
  return settings;
}

template <typename TStack>
std::vector<std::optional<sensornoise::KnownOffset>>
SensorNoiseEstimator<TStack>::FindOffsets(const std::vector<std::uint8_t> &        mask,
                                          const std::optional<SensorNoiseMosaic> & mosaic)
{
  std::vector<std::optional<sensornoise::KnownOffset>> offsets(mosaic ? sensornoise::BayerPlanes.size() : 1);
  if (!std::isnan(m_Offset))
  {
    std::fill(offsets.begin(), offsets.end(), sensornoise::KnownOffset{ m_Offset, m_OffsetStandardError });
  }
  else if (const TStack * dark = this->GetDark())
  {
    const sensornoise::RefinedSettings settings = this->MakeRefinedSettings();
    settings.Validate();
    const auto sink = SensorNoiseDarkSink<TStack>::New();
    sink->SetInput(dark);
    sink->SetNumberOfStreamDivisions(this->GetNumberOfStreamDivisions());
    sink->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
    sink->SetUsedPixels(mask);
    if (mosaic)
    {
      sink->SetMosaic(mosaic->geometry);
    }
    auto * const reading = sink.GetPointer();
    sink->AddObserver(ProgressEvent(), [this, reading](const EventObject &) {
      this->InvokeEvent(ProgressEvent());
      reading->SetAbortGenerateData(this->GetAbortGenerateData());
    });
    sink->Update();
    const std::vector<sensornoise::KnownOffset> measured = sink->Measure(settings.codes);
    std::copy(measured.begin(), measured.end(), offsets.begin());
  }
  else if (const auto camera = this->GetCamera();
           m_Method == MethodEnum::Refined && std::isfinite(camera.opticalBlackDn + camera.opticalBlackErrorDn))
  {
    const sensornoise::KnownOffset masked{ camera.opticalBlackDn, camera.opticalBlackErrorDn };
    std::fill(offsets.begin(), offsets.end(), masked);
  }
  return offsets;
}

template <typename TStack>
std::optional<SensorNoiseMosaic>
SensorNoiseEstimator<TStack>::FindMosaic()
{
  using sensornoise::BayerSource;
  const auto                       size = this->GetFrameRegion().GetSize();
  const sensornoise::FrameGeometry frame{ size[0], size[1], m_ShutterAxis };
  if (m_BayerPattern == "none")
  {
    return std::nullopt;
  }
  if (m_BayerPattern != "auto")
  {
    return SensorNoiseMosaic{ { frame, sensornoise::BayerPatternOf(m_BayerPattern) }, m_BayerSource };
  }
  auto * const      stack = const_cast<TStack *>(this->GetInput());
  const std::string inFile = this->GetCamera().bayerPattern;
  if (!inFile.empty())
  {
    const auto pattern = WithItkErrors(this, [&inFile] { return sensornoise::BayerPatternOf(inFile); });
    return SensorNoiseMosaic{ { frame, pattern }, BayerSource::File };
  }
  this->GenerateNthInputRequestedRegion(0); // the first chunk, which the first pass then need not read again
  stack->Update();
  const auto                first = stack->GetLargestPossibleRegion();
  const PixelType * const   pixels = stack->GetBufferPointer() + stack->ComputeOffset(first.GetIndex());
  const std::vector<double> levels(pixels, pixels + frame.Pixels());
  if (const auto pattern = sensornoise::RecogniseMosaic(levels, frame.width, frame.height, this->GetParallelFor()))
  {
    return SensorNoiseMosaic{ { frame, *pattern }, BayerSource::Levels };
  }
  return std::nullopt;
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::StartPasses()
{
  const auto                       size = this->GetFrameRegion().GetSize();
  const sensornoise::FrameGeometry geometry{ size[0], size[1], m_ShutterAxis };
  const SizeValueType              frames = this->GetNumberOfFrames();
  std::vector<std::uint8_t>        userMask;
  if (const MaskImageType * mask = this->GetMask())
  {
    auto * whole = const_cast<MaskImageType *>(mask);
    whole->SetRequestedRegionToLargestPossibleRegion();
    whole->Update();
    userMask.assign(mask->GetBufferPointer(), mask->GetBufferPointer() + size[0] * size[1]);
  }
  const auto mosaic = this->FindMosaic();
  const auto offsets = this->FindOffsets(userMask, mosaic);
  const auto makeRefined = [&](std::size_t part, const auto & frame, const auto & mask, const auto & parallelFor) {
    sensornoise::RefinedSettings settings = this->MakeRefinedSettings();
    settings.offset = offsets[part];
    if (m_MemoryLimit > 0)
    {
      settings.memoryLimitBytes = static_cast<double>(m_MemoryLimit) / (mosaic ? sensornoise::BayerPlanes.size() : 1.0);
    }
    return sensornoise::RefinedMethod<PixelType>(settings, frame, frames, mask, parallelFor);
  };
  const auto makePublished = [&](std::size_t, const auto & frame, const auto & mask, const auto & parallelFor) {
    return sensornoise::PublishedMethod<PixelType>(this->MakePublishedSettings(), frame, frames, mask, parallelFor);
  };
  const auto ofPlane = [&](const auto & make) {
    return [&](sensornoise::BayerPlane plane, const sensornoise::ParallelFor & parallelFor) {
      const auto & planes = mosaic->geometry;
      return make(static_cast<std::size_t>(plane), planes.Plane(), planes.Take(userMask, plane), parallelFor);
    };
  };
  const auto parallelFor = this->GetParallelFor();
  using Work = SensorNoiseEstimation<PixelType>;
  using Method = decltype(Work::method);
  const bool isRefined = m_Method == MethodEnum::Refined;
  const auto makeMethod = [&]() -> Method {
    if (!mosaic)
    {
      return isRefined ? Method(makeRefined(0, geometry, userMask, parallelFor))
                       : Method(makePublished(0, geometry, userMask, parallelFor));
    }
    if (isRefined)
    {
      return typename Work::MosaicRefined(mosaic->geometry, ofPlane(makeRefined), parallelFor);
    }
    return typename Work::MosaicPublished(mosaic->geometry, ofPlane(makePublished), parallelFor);
  };
  m_Estimation = std::make_unique<Estimation>(Estimation{ { makeMethod(), mosaic, {} } });
  for (const auto & offset : offsets)
  {
    m_Estimation->dark.push_back(offset ? offset->maps : nullptr);
  }
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::ProcessFrames(unsigned int, const PixelType * frames, SizeValueType, SizeValueType count)
{
  std::visit([&](auto & method) { method.AddFrames(frames, count); }, m_Estimation->method);
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::EndPass(unsigned int)
{
  std::visit([](auto & method) { method.EndPass(); }, m_Estimation->method);
  if (m_Estimation->IsDone())
  {
    this->FillOutputs();
    m_Estimation.reset();
  }
}

template <typename TStack>
bool
SensorNoiseEstimator<TStack>::RepeatsPass(unsigned int pass) const
{
  return pass + 1 == this->NumberOfPasses() && m_Estimation;
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::DropPasses()
{
  m_Estimation.reset();
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
  auto report = m_Estimation->GetReport(m_Source, this->GetCamera());
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
    const auto pixelsOfImage = SensorNoiseMapContainer<decltype(missing)>::New();
    pixelsOfImage->TakeOver(m_Estimation->TakeMap(mapOf, missing, pixels));
    image->SetBufferedRegion(image->GetLargestPossibleRegion());
    image->SetPixelContainer(pixelsOfImage);
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
  os << indent << "BitDepth: " << m_BitDepth << std::endl;
  os << indent << "ClipLow: " << m_ClipLow << std::endl;
  os << indent << "ClipHigh: " << m_ClipHigh << std::endl;
  os << indent << "LevelRangeLow: " << m_LevelRangeLow << std::endl;
  os << indent << "LevelRangeHigh: " << m_LevelRangeHigh << std::endl;
  os << indent << "QuantisationStep: " << m_QuantisationStep << std::endl;
  os << indent << "MemoryLimit: " << m_MemoryLimit << std::endl;
  os << indent << "BayerPattern: " << m_BayerPattern << std::endl;
  if (const auto & roi = m_Source.roi)
  {
    os << indent << "SourceRegion: " << (*roi)[0] << ", " << (*roi)[1] << ", " << (*roi)[2] << ", " << (*roi)[3]
       << std::endl;
  }
  if (const auto & frames = m_Source.frames)
  {
    os << indent << "SourceFrames: " << frames->first << ", " << frames->second << std::endl;
  }
  os << indent << "FramesHash: " << m_FramesHash.sha256 << std::endl;
  os << indent << "DarkHash: " << m_DarkHash.sha256 << std::endl;
}

} // namespace itk

#endif
