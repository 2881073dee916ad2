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
#ifndef itkSensorNoiseStackSink_h
#define itkSensorNoiseStackSink_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/FrameGeometry.h"
#include "itkImage.h"
#include "itkImageSink.h"

#include <chrono>
#include <ostream>
#include <thread>
#include <vector>

namespace itk
{

/** \class SensorNoiseStackSink
 * \brief Reads a stack, an image whose last axis is time, in chunks of whole frames and as often as a subclass wants.
 *
 * The number of requested regions is that of all passes' chunks. By default their number is chosen: one if the stack is
 * in memory already, else as many as keep a chunk under ChunkBytes(), 32 MiB unless a subclass can do with more.
 * Readers that cannot stream (NRRD, multi-page TIFF) give the whole stack each time; still only the chunk asked for is
 * handed on.
 *
 * An error, or an abort, resets the pipeline: the next Update() starts afresh, never from a partial result. An abort
 * takes effect within a moment, also if the stack is in memory, and between the passes: observers of progress are asked
 * again and again while the threads work, at most every 50 ms.
 *
 * A subclass implements NumberOfPasses(), StartPasses(), ProcessFrames() and EndPass().
 *
 * \tparam TStack itk::Image of 3 dimensions: x, y, time.
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT SensorNoiseStackSink : public ImageSink<TStack>
{
  static_assert(TStack::ImageDimension == 3, "a stack has three dimensions: x, y and time");

public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseStackSink);

  using Self = SensorNoiseStackSink;
  using Superclass = ImageSink<TStack>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using StackType = TStack;
  using PixelType = typename TStack::PixelType;
  using StackRegionType = typename TStack::RegionType;
  using FrameImageType = Image<double, 2>;
  using MaskImageType = Image<unsigned char, 2>;
  using FrameRegionType = ImageRegion<2>;

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseStackSink";
  }

  /** Number of chunks in which each pass reads the stack. 0 (default): chosen; more than the frames: one a frame. */
  void
  SetNumberOfStreamDivisions(unsigned int number) override;
  unsigned int
  GetNumberOfStreamDivisions() const override
  {
    return m_NumberOfStreamDivisions;
  }

  /** As every process object: does nothing if nothing has changed (ImageSink would compute again). */
  void
  Update() override
  {
    ProcessObject::Update(); // NOLINT(bugprone-parent-virtual-call)
  }
  void
  UpdateLargestPossibleRegion() override
  {
    ProcessObject::UpdateLargestPossibleRegion(); // NOLINT(bugprone-parent-virtual-call)
  }
  void
  UpdateOutputInformation() override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  SensorNoiseStackSink() = default;
  ~SensorNoiseStackSink() override = default;

  /** How often the stack is read. */
  virtual unsigned int
  NumberOfPasses() const = 0;
  /** Called before the first pass. */
  virtual void
  StartPasses() = 0;
  /** The next frames of the current pass, whole and one after the other. \a first counts from 0. */
  virtual void
  ProcessFrames(unsigned int pass, const PixelType * frames, SizeValueType first, SizeValueType count) = 0;
  /** Called after the last frame of a pass. */
  virtual void
  EndPass(unsigned int pass) = 0;
  /** Asked after EndPass(): whether the pass is repeated, which reads the stack once more. */
  virtual bool
  RepeatsPass(unsigned int) const
  {
    return false;
  }
  /** Called after an error or an abort: gives back the memory of the passes. */
  virtual void
  DropPasses()
  {}

  /** Bytes of a chunk of a stack that is not in memory; of the first pass before StartPasses(), of all after it. */
  virtual SizeValueType
  ChunkBytes(unsigned int pass) const;
  /** Bytes of a stack in memory that ProcessFrames() is given at a time, whole frames. */
  virtual SizeValueType
  BytesAtOnce() const;

  /** Spreads work over this filter's threads. Throws ProcessAborted, before that or in its midst, if an abort was asked
   * for. */
  sensornoise::ParallelFor
  GetParallelFor();
  /** That it spreads work over. */
  std::size_t
  GetNumberOfThreads() const;

  /** The region of a frame, and the geometry of the stack's first two axes for a frame-sized output. */
  FrameRegionType
  GetFrameRegion() const;
  void
  CopyFrameInformation(ImageBase<2> * frame) const;

  SizeValueType
  GetNumberOfFrames() const
  {
    return this->GetInput()->GetLargestPossibleRegion().GetSize(2);
  }

  unsigned int
  GetNumberOfInputRequestedRegions() override;
  void
  GenerateNthInputRequestedRegion(unsigned int number) override;
  void
  BeforeStreamedGenerateData() override;
  void
  StreamedGenerateData(unsigned int number) override;
  void
  AfterStreamedGenerateData() override;
  void
  ThreadedStreamedGenerateData(const StackRegionType &) override
  {}
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Of a requested region: its pass, and its place among the pass's chunks. */
  struct Place
  {
    unsigned int pass;
    unsigned int chunk;
    unsigned int chunks;
  };
  Place
  PlaceOf(unsigned int number) const;
  unsigned int
  ChooseNumberOfChunks(unsigned int pass) const;
  void
  ChooseChunks();
  /** Gives the pixels of the chunk, which is there, to ProcessFrames(). */
  void
  ProcessChunk(unsigned int number);
  /** Reports the progress \a reached to the observers, at most every 50 ms, and throws ProcessAborted if an abort is
   * asked for. Does nothing on another thread than that of Update(). */
  void
  ReportProgress(float reached);

  unsigned int                          m_NumberOfStreamDivisions{ 0 };
  std::vector<unsigned int>             m_Chunks; // of each pass, when they have started
  StackRegionType                       m_Chunk;
  std::thread::id                       m_Thread; // of Update()
  std::chrono::steady_clock::time_point m_LastReport{};
  float                                 m_Reached{ 0.0F };     // the progress, at least
  float                                 m_NextReached{ 0.0F }; // when the frames at work are done
};

// Instantiated once, in the library.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseStackSink<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
