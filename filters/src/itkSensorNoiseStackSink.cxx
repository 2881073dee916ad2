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
#include "itkSensorNoiseStackSink.h"

#include "itkSensorNoiseChunks.h"
#include "itkSensorNoiseErrors.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <numeric>
#include <ostream>
#include <thread>

namespace itk
{

template <typename TStack>
void
SensorNoiseStackSink<TStack>::SetNumberOfStreamDivisions(unsigned int number)
{
  if (m_NumberOfStreamDivisions != number)
  {
    m_NumberOfStreamDivisions = number;
    this->Modified();
  }
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::UpdateOutputInformation()
{
  ResetAfterError(this, [this] { Superclass::UpdateOutputInformation(); });
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::UpdateOutputData(DataObject * output)
{
  try
  {
    ResetAfterError(this, [&] { WithItkErrors(this, [&] { Superclass::UpdateOutputData(output); }); });
  }
  catch (...)
  {
    this->DropPasses();
    throw;
  }
}

template <typename TStack>
sensornoise::ParallelFor
SensorNoiseStackSink<TStack>::GetParallelFor()
{
  return [this](std::size_t count, const std::function<void(std::size_t)> & function) {
    this->ReportProgress(m_Reached);
    if (count == 1)
    {
      function(0); // also if this call runs in one of the threads already
      return;
    }
    // The number of calls of this function per chunk is not known. Each advances the progress by half of the rest.
    const bool         isOfUpdate = std::this_thread::get_id() == m_Thread;
    const float        from = m_Reached;
    const float        to = isOfUpdate ? 0.5F * (m_Reached + m_NextReached) : m_Reached;
    const float        ofThread = static_cast<float>(this->GetNumberOfThreads()) / static_cast<float>(count);
    std::exception_ptr aborted;
    std::atomic<bool>  isAborted{ false };
    this->GetMultiThreader()->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
    this->GetMultiThreader()->ParallelizeArray(
      0,
      count,
      [&](SizeValueType i) {
        if (isAborted)
        {
          return;
        }
        function(i);
        if (std::this_thread::get_id() == m_Thread) // the other threads must end before the exception is rethrown
        {
          try
          {
            this->ReportProgress(from + (to - from) * std::min(1.0F, static_cast<float>(i + 1) * ofThread));
          }
          catch (...)
          {
            aborted = std::current_exception();
            isAborted = true;
          }
        }
      },
      nullptr);
    if (aborted)
    {
      std::rethrow_exception(aborted);
    }
    if (isOfUpdate)
    {
      m_Reached = to;
    }
  };
}

template <typename TStack>
std::size_t
SensorNoiseStackSink<TStack>::GetNumberOfThreads() const
{
  return std::min<std::size_t>(this->GetNumberOfWorkUnits(), this->GetMultiThreader()->GetMaximumNumberOfThreads());
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::ReportProgress(float reached)
{
  if (std::this_thread::get_id() != m_Thread)
  {
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - m_LastReport >= std::chrono::milliseconds(50))
  {
    m_LastReport = now;
    this->UpdateProgress(std::max(this->GetProgress(), reached)); // constant while a pass is repeated
  }
  if (this->GetAbortGenerateData())
  {
    ProcessAborted aborted(__FILE__, __LINE__);
    aborted.SetLocation(ITK_LOCATION);
    aborted.SetDescription("aborted before all frames were read");
    throw aborted;
  }
}

template <typename TStack>
auto
SensorNoiseStackSink<TStack>::GetFrameRegion() const -> FrameRegionType
{
  const StackRegionType & stack = this->GetInput()->GetLargestPossibleRegion();
  FrameRegionType         frame;
  for (unsigned int d = 0; d < 2; ++d)
  {
    frame.SetIndex(d, stack.GetIndex(d));
    frame.SetSize(d, stack.GetSize(d));
  }
  return frame;
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::CopyFrameInformation(ImageBase<2> * frame) const
{
  const StackType *           stack = this->GetInput();
  ImageBase<2>::SpacingType   spacing;
  ImageBase<2>::PointType     origin;
  ImageBase<2>::DirectionType direction;
  for (unsigned int i = 0; i < 2; ++i)
  {
    spacing[i] = stack->GetSpacing()[i];
    origin[i] = stack->GetOrigin()[i];
    for (unsigned int j = 0; j < 2; ++j)
    {
      direction[i][j] = stack->GetDirection()[i][j];
    }
  }
  if (direction[0][0] * direction[1][1] == direction[0][1] * direction[1][0])
  {
    direction.SetIdentity(); // no 2-D direction describes frames that are perpendicular to the first two axes
  }
  frame->SetLargestPossibleRegion(this->GetFrameRegion());
  frame->SetSpacing(spacing);
  frame->SetOrigin(origin);
  frame->SetDirection(direction);
}

template <typename TStack>
SizeValueType
SensorNoiseStackSink<TStack>::ChunkBytes(unsigned int) const
{
  return SensorNoiseChunkBytes;
}

template <typename TStack>
SizeValueType
SensorNoiseStackSink<TStack>::BytesAtOnce() const
{
  return SensorNoisePieceBytes;
}

template <typename TStack>
unsigned int
SensorNoiseStackSink<TStack>::ChooseNumberOfChunks(unsigned int pass) const
{
  const StackType *   stack = this->GetInput();
  const SizeValueType frames = std::max<SizeValueType>(1, this->GetNumberOfFrames());
  if (m_NumberOfStreamDivisions > 0)
  {
    return static_cast<unsigned int>(std::min<SizeValueType>(m_NumberOfStreamDivisions, frames));
  }
  const bool isInMemory = stack->GetBufferedRegion() == stack->GetLargestPossibleRegion() &&
                          (!stack->GetSource() || stack->GetUpdateMTime() >= stack->GetPipelineMTime());
  if (isInMemory)
  {
    return 1;
  }
  const SizeValueType framesPerChunk =
    SensorNoiseFramesPerChunk(this->GetFrameRegion().GetNumberOfPixels() * sizeof(PixelType), this->ChunkBytes(pass));
  return static_cast<unsigned int>((frames + framesPerChunk - 1) / framesPerChunk);
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::BeforeStreamedGenerateData()
{
  this->ChooseChunks(); // StartPasses() may read the first chunk
  m_Thread = std::this_thread::get_id();
  m_Reached = 0.0F;
  m_NextReached = 0.0F;
  Superclass::BeforeStreamedGenerateData();
  this->StartPasses();
  this->ChooseChunks();
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::ChooseChunks()
{
  m_Chunks.clear();
  for (unsigned int pass = 0; pass < this->NumberOfPasses(); ++pass)
  {
    m_Chunks.push_back(this->ChooseNumberOfChunks(pass));
  }
}

template <typename TStack>
unsigned int
SensorNoiseStackSink<TStack>::GetNumberOfInputRequestedRegions()
{
  return m_Chunks.empty() ? this->NumberOfPasses() : std::accumulate(m_Chunks.begin(), m_Chunks.end(), 0U);
}

template <typename TStack>
auto
SensorNoiseStackSink<TStack>::PlaceOf(unsigned int number) const -> Place
{
  Place place{ 0, number, 1 };
  for (; place.pass < m_Chunks.size(); ++place.pass)
  {
    place.chunks = m_Chunks[place.pass];
    if (place.chunk < place.chunks)
    {
      return place;
    }
    place.chunk -= place.chunks;
  }
  return { number, 0, 1 }; // the passes have not started
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::GenerateNthInputRequestedRegion(unsigned int number)
{
  // The other inputs are requested whole.
  ProcessObject::GenerateInputRequestedRegion();
  auto *              stack = const_cast<StackType *>(this->GetInput());
  const SizeValueType frames = this->GetNumberOfFrames();
  const Place         place = this->PlaceOf(number);
  // The larger chunks come first, as a buffer that grows needs its memory twice for the copy.
  const SizeValueType size = frames / place.chunks;
  const SizeValueType larger = frames % place.chunks;
  const SizeValueType first = place.chunk * size + std::min<SizeValueType>(place.chunk, larger);
  m_Chunk = stack->GetLargestPossibleRegion();
  m_Chunk.SetIndex(2, m_Chunk.GetIndex(2) + static_cast<IndexValueType>(first));
  m_Chunk.SetSize(2, place.chunk < larger ? size + 1 : size);
  stack->SetRequestedRegion(m_Chunk);
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::StreamedGenerateData(unsigned int number)
{
  this->ProcessChunk(number);
  const auto [pass, chunk, chunks] = this->PlaceOf(number);
  if (chunk + 1 < chunks)
  {
    return;
  }
  auto * const stack = const_cast<StackType *>(this->GetInput());
  const auto   release = [stack] {
    if (stack->GetBufferedRegion() != stack->GetLargestPossibleRegion())
    {
      stack->ReleaseData(); // the next pass requests another part of the stack
    }
  };
  release();
  this->EndPass(pass);
  while (this->RepeatsPass(pass))
  {
    for (unsigned int again = number - chunk; again <= number; ++again)
    {
      this->GenerateNthInputRequestedRegion(again);
      stack->PropagateRequestedRegion();
      stack->UpdateOutputData();
      this->ProcessChunk(again);
    }
    release();
    this->EndPass(pass);
  }
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::ProcessChunk(unsigned int number)
{
  // m_Chunk is used here, because readers that cannot stream enlarge the requested region to the whole stack.
  const StackType * stack = this->GetInput();
  if (!stack->GetBufferedRegion().IsInside(m_Chunk))
  {
    itkExceptionMacro("the stack holds the region " << stack->GetBufferedRegion() << " but " << m_Chunk
                                                    << " was asked for");
  }
  RequirePixels(stack, "the stack");
  const unsigned int  pass = this->PlaceOf(number).pass;
  const SizeValueType first =
    static_cast<SizeValueType>(m_Chunk.GetIndex(2) - stack->GetLargestPossibleRegion().GetIndex(2));
  const SizeValueType framePixels = this->GetFrameRegion().GetNumberOfPixels();
  const SizeValueType count = m_Chunk.GetSize(2);
  const SizeValueType atOnce = SensorNoiseFramesPerChunk(framePixels * sizeof(PixelType), this->BytesAtOnce());
  const PixelType *   frames = stack->GetBufferPointer() + stack->ComputeOffset(m_Chunk.GetIndex());
  const auto          reachedAt = [&](SizeValueType frame) {
    const auto done = static_cast<float>(std::min(frame, count)) / static_cast<float>(count);
    return (static_cast<float>(number) + 0.99F * done) / static_cast<float>(this->GetNumberOfInputRequestedRegions());
  };
  for (SizeValueType begin = 0; begin < count; begin += atOnce)
  {
    m_Reached = reachedAt(begin);
    m_NextReached = reachedAt(begin + atOnce);
    this->ReportProgress(m_Reached);
    this->ProcessFrames(pass, frames + begin * framePixels, first + begin, std::min(atOnce, count - begin));
    m_Reached = m_NextReached;
    this->UpdateProgress(std::max(this->GetProgress(), m_Reached));
  }
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::AfterStreamedGenerateData()
{
  this->ReportProgress(m_Reached);
  Superclass::AfterStreamedGenerateData();
}

template <typename TStack>
void
SensorNoiseStackSink<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfStreamDivisions: " << m_NumberOfStreamDivisions << std::endl;
}

#define SensorNoise_INSTANTIATE(TPixel) template class SensorNoiseStackSink<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
