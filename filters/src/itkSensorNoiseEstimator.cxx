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
#include "itkSensorNoiseEstimator.h"

#include "itkSensorNoiseDarkSink.h"
#include "itkSensorNoiseErrors.h"
#include "itkSensorNoiseEstimation.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Settings.h"
#include "moments/StackMaps.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace itk
{

template <typename TStack>
SensorNoiseEstimator<TStack>::SensorNoiseEstimator()
{
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
SizeValueType
SensorNoiseEstimator<TStack>::ChunkBytes(unsigned int pass) const
{
  // In the second pass of Refined the computation per chunk takes as long as about eight frames, so that larger chunks
  // are faster. With 16 bytes more per pixel, this pass needs as much memory as the third pass with nine components.
  constexpr SizeValueType moreBytes = 16;
  const bool              isLarger = m_Method == MethodEnum::Refined && pass == 1 && m_MemoryLimit == 0;
  return Superclass::ChunkBytes(pass) + (isLarger ? moreBytes * this->GetFrameRegion().GetNumberOfPixels() : 0);
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::GenerateNthInputRequestedRegion(unsigned int number)
{
  Superclass::GenerateNthInputRequestedRegion(number);
  if (auto * dark = const_cast<TStack *>(this->GetDark()))
  {
    // The dark frames were read before the first pass. With a larger region the pipeline would read all of them again.
    auto region = dark->GetLargestPossibleRegion();
    region.SetSize(2, 1);
    dark->SetRequestedRegion(region);
  }
}

template <typename TStack>
std::vector<std::optional<sensornoise::KnownOffset>>
SensorNoiseEstimator<TStack>::FindOffsets(const SensorNoiseStack & stack)
{
  std::vector<std::optional<sensornoise::KnownOffset>> offsets(stack.mosaic ? sensornoise::BayerPlanes.size() : 1);
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
    sink->WorkFor(this);
    sink->SetUsedPixels(stack.mask);
    if (stack.mosaic)
    {
      sink->SetMosaic(stack.mosaic->geometry);
    }
    sink->Update();
    const std::vector<sensornoise::KnownOffset> measured = sink->Measure(settings.dnSettings);
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
  this->GenerateNthInputRequestedRegion(0); // the first chunk, so that the first pass does not read it again
  stack->Update();
  RequirePixels(stack, "the stack");
  const auto              first = stack->GetLargestPossibleRegion();
  const PixelType * const pixels = stack->GetBufferPointer() + stack->ComputeOffset(first.GetIndex());
  if (const auto pattern = sensornoise::RecogniseMosaic(pixels, frame.width, frame.height, this->GetParallelFor()))
  {
    return SensorNoiseMosaic{ { frame, *pattern }, BayerSource::Levels };
  }
  return std::nullopt;
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::StartPasses()
{
  this->StartEstimation(true);
}

template <typename TStack>
void
SensorNoiseEstimator<TStack>::StartEstimation(bool withoutMerging)
{
  const auto       size = this->GetFrameRegion().GetSize();
  SensorNoiseStack stack{ { size[0], size[1], m_ShutterAxis }, this->GetNumberOfFrames(), this->ReadMask(), {}, {} };
  stack.mosaic = this->FindMosaic();
  stack.offsets = this->FindOffsets(stack);
  using Work = SensorNoiseEstimation<PixelType>;
  const auto settings = m_Method == MethodEnum::Refined ? typename Work::Settings(this->MakeRefinedSettings())
                                                        : typename Work::Settings(this->MakePublishedSettings());
  m_Estimation = std::make_unique<Estimation>(
    Estimation{ Work::Start(settings, stack, this->GetParallelFor(), this->GetNumberOfThreads(), withoutMerging) });
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

} // namespace itk

#include "itkSensorNoiseEstimatorOutputs.hxx"
#include "itkSensorNoiseEstimatorSettings.hxx"

namespace itk
{

#define SensorNoise_INSTANTIATE(TPixel) template class SensorNoiseEstimator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
