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
 * \brief Reads a stack, an image whose last axis is time, in chunks of whole frames, once or in several passes.
 *
 * The number of requested regions is the number of chunks of all passes. By default the number of chunks is chosen. A
 * stack that is in memory already is one chunk. Otherwise each chunk is smaller than ChunkBytes(), which is 32 MiB
 * unless a subclass allows more. Readers that cannot stream (NRRD, multi-page TIFF) return the whole stack each time.
 * The subclass still receives only the requested chunk.
 *
 * An error or an abort resets the pipeline, and the next Update() starts from the beginning, never from a partial
 * result. An abort takes effect within a moment, also for a stack in memory and between the passes. While the threads
 * work, progress is reported to the observers at most every 50 ms.
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

  /** Number of chunks in which each pass reads the stack. Default 0: the number is chosen. A number above the number of
   * frames gives one chunk for each frame. */
  void
  SetNumberOfStreamDivisions(unsigned int number) override;
  unsigned int
  GetNumberOfStreamDivisions() const override
  {
    return m_NumberOfStreamDivisions;
  }

  /** Updates the filter. Does nothing if nothing has changed since the last update, as other process objects do.
   * (ImageSink would compute again.) */
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

  /** Returns the number of passes over the stack. */
  virtual unsigned int
  NumberOfPasses() const = 0;
  /** Prepares the passes. Called before the first pass. */
  virtual void
  StartPasses() = 0;
  /** Processes the next frames of the current pass: \a count whole frames in time order. \a first is the index of the
   * first one and counts from 0. */
  virtual void
  ProcessFrames(unsigned int pass, const PixelType * frames, SizeValueType first, SizeValueType count) = 0;
  /** Ends a pass. Called after its last frame. */
  virtual void
  EndPass(unsigned int pass) = 0;
  /** Returns whether the pass is repeated, which reads the stack once more. Called after EndPass(). */
  virtual bool
  RepeatsPass(unsigned int) const
  {
    return false;
  }
  /** Releases the memory of the passes. Called after an error or an abort. */
  virtual void
  DropPasses()
  {}

  /** Returns the largest size of a chunk of a stack that is not in memory [bytes]. Called before StartPasses() for the
   * first pass, and after it for all passes. */
  virtual SizeValueType
  ChunkBytes(unsigned int pass) const;
  /** Returns the largest size of the whole frames of a stack in memory that one call of ProcessFrames() receives
   * [bytes]. */
  virtual SizeValueType
  BytesAtOnce() const;

  /** Returns a function that distributes work over the threads of this filter. The function throws ProcessAborted,
   * before or during the work, if an abort is requested. */
  sensornoise::ParallelFor
  GetParallelFor();
  /** Returns the number of threads over which GetParallelFor() distributes work. */
  std::size_t
  GetNumberOfThreads() const;

  /** Returns the region of a frame. CopyFrameInformation() copies the geometry of the first two axes of the stack to an
   * output of the size of a frame. */
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
  /** Pass of a requested region, its index among the chunks of the pass, and the number of these chunks. */
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
  /** Passes the pixels of the current chunk, which is in memory, to ProcessFrames(). */
  void
  ProcessChunk(unsigned int number);
  /** Reports the progress \a reached to the observers, at most every 50 ms, and throws ProcessAborted if an abort is
   * requested. Does nothing on a thread other than the thread of Update(). */
  void
  ReportProgress(float reached);

  unsigned int                          m_NumberOfStreamDivisions{ 0 };
  std::vector<unsigned int>             m_Chunks; // for each pass, once the passes have started
  StackRegionType                       m_Chunk;
  std::thread::id                       m_Thread; // the thread of Update()
  std::chrono::steady_clock::time_point m_LastReport{};
  float                                 m_Reached{ 0.0F };     // lower bound of the progress
  float                                 m_NextReached{ 0.0F }; // progress after the current frames
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseStackSink<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
