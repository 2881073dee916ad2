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
#ifndef itkSensorNoiseDarkSink_h
#define itkSensorNoiseDarkSink_h

#include "itkSensorNoiseStackSink.h"
#include "base/Simd.h"
#include "sensornoise/Parallel.h"
#include "mosaic/MosaicGeometry.h"
#include "sensornoise/Settings.h"
#include "moments/DarkFrames.h"
#include "moments/TemporalMoments.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace itk
{

/** \class SensorNoiseDarkSink
 * \brief Reads dark frames once, in chunks, for SensorNoiseEstimator. It is not meant for pipelines.
 * \ingroup SensorNoise
 */
template <typename TStack>
class SensorNoiseDarkSink : public SensorNoiseStackSink<TStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseDarkSink);

  using Self = SensorNoiseDarkSink;
  using Superclass = SensorNoiseStackSink<TStack>;
  using Pointer = SmartPointer<Self>;
  using typename Superclass::PixelType;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseDarkSink";
  }

  /** Reads the frames. ProcessObject::Update() does nothing for an object without outputs. */
  void
  Update() override
  {
    this->UpdateOutputInformation();
    this->UpdateOutputData(nullptr);
  }

  /** Sets the pixels to be used: nonzero values in \a used; empty (default): all. Call it before Update(). */
  void
  SetUsedPixels(std::vector<std::uint8_t> used)
  {
    m_UsedPixels = std::move(used);
    this->Modified();
  }

  /** Declares that the frames are mosaics, whose planes are measured separately. Call it before Update(). */
  void
  SetMosaic(const sensornoise::MosaicGeometry & geometry)
  {
    m_Planes.emplace(geometry);
    this->Modified();
  }

  /** Uses the chunks and threads of \a estimator, forwards the progress to its observers, and aborts when it aborts. */
  void
  WorkFor(Superclass * estimator)
  {
    this->SetNumberOfStreamDivisions(estimator->GetNumberOfStreamDivisions());
    this->SetNumberOfWorkUnits(estimator->GetNumberOfWorkUnits());
    this->AddObserver(ProgressEvent(), [this, estimator](const EventObject &) {
      estimator->InvokeEvent(ProgressEvent());
      this->SetAbortGenerateData(estimator->GetAbortGenerateData());
    });
  }

  /** Returns offset and read noise of the frames that were read, see sensornoise::MeasureDarkFrames(): one result per
   * plane in the order of BayerPlanes, or one for frames that are no mosaics. Call it once, as it consumes the sums. */
  std::vector<sensornoise::KnownOffset>
  Measure(const sensornoise::CodeSettings & codes)
  {
    std::vector<sensornoise::KnownOffset> offsets;
    for (Part & part : m_Parts)
    {
      offsets.push_back(sensornoise::MeasureDarkFrames<PixelType>(
        std::move(part.moments), codes, part.usedPixels, this->GetParallelFor(), part.drift));
    }
    return offsets;
  }

protected:
  SensorNoiseDarkSink() = default;
  ~SensorNoiseDarkSink() override = default;

  unsigned int
  NumberOfPasses() const override
  {
    return 1;
  }
  void
  StartPasses() override
  {
    m_Parts.clear();
    if (!m_Planes)
    {
      const SizeValueType pixels = this->GetFrameRegion().GetNumberOfPixels();
      m_Parts.emplace_back(m_UsedPixels, pixels);
      return;
    }
    const sensornoise::MosaicGeometry & geometry = m_Planes->GetGeometry();
    for (const sensornoise::BayerPlane plane : sensornoise::BayerPlanes)
    {
      m_Parts.emplace_back(geometry.Take(m_UsedPixels, plane), geometry.Plane().Pixels());
    }
  }
  void
  ProcessFrames(unsigned int, const PixelType * frames, SizeValueType, SizeValueType count) override
  {
    const sensornoise::ParallelFor parallelFor = this->GetParallelFor();
    if (!m_Planes)
    {
      m_Parts.front().AddFrames(frames, count, parallelFor);
      return;
    }
    m_Planes->ForPlanes(frames, count, parallelFor, [&](std::size_t k, const PixelType * plane, std::size_t now) {
      m_Parts[k].AddFrames(plane, now, parallelFor);
    });
  }
  void
  EndPass(unsigned int) override
  {}

private:
  /** Sums over the frames, or over one plane of the frames. */
  struct Part
  {
    Part(std::vector<std::uint8_t> used, std::size_t numberOfPixels)
      : usedPixels(std::move(used))
      , pixels(numberOfPixels)
      , moments(numberOfPixels)
      , drift(numberOfPixels, usedPixels)
    {}

    void
    AddFrames(const PixelType * frames, std::size_t count, const sensornoise::ParallelFor & parallelFor)
    {
      sensornoise::ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
        moments.AddFrames(frames, pixels, count, begin, end);
      });
      moments.AdvanceFrames(count);
      drift.AddFrames(frames, count, parallelFor);
    }

    std::vector<std::uint8_t>               usedPixels;
    std::size_t                             pixels;
    sensornoise::TemporalMoments<PixelType> moments;
    sensornoise::DarkDrift                  drift;
  };

  std::vector<std::uint8_t>                          m_UsedPixels;
  std::optional<sensornoise::PlaneFrames<PixelType>> m_Planes; // null: not a mosaic
  std::vector<Part>                                  m_Parts;
};

} // namespace itk

#endif
