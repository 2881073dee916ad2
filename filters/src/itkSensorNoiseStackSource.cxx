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
#include "itkSensorNoiseStackSourceSettings.hxx"
#include "base/FreeMemory.h"
#include "moments/StackMaps.h"
#include "simulation/FrameProcessing.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "itkImageRegionConstIterator.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
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
constexpr double BytesPerFrame = 40.0;
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
      sensornoise::StackSimulator::PixelRangeDn<OutputPixelType>(settings);
      return truth;
    },
    ImpossibleSimulation);

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
    ImpossibleSimulation);
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

#define SensorNoise_INSTANTIATE(TPixel) template class SensorNoiseStackSource<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
