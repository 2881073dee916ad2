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
#include "mosaic/MosaicGeometry.h"
#include "sensornoise/Settings.h"

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
    m_Mosaic = geometry;
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

  /** Returns offset and read noise of the frames that were read. \see sensornoise::DarkFrameSums::Measure */
  std::vector<sensornoise::KnownOffset>
  Measure(const sensornoise::DnSettings & dnSettings)
  {
    return m_Sums->Measure(dnSettings, this->GetParallelFor());
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
    if (m_Mosaic)
    {
      m_Sums.emplace(*m_Mosaic, m_UsedPixels);
      return;
    }
    const auto size = this->GetFrameRegion().GetSize();
    m_Sums.emplace(sensornoise::FrameGeometry{ size[0], size[1] }, m_UsedPixels);
  }
  void
  ProcessFrames(unsigned int, const PixelType * frames, SizeValueType, SizeValueType count) override
  {
    m_Sums->AddFrames(frames, count, this->GetParallelFor());
  }
  void
  EndPass(unsigned int) override
  {}

private:
  std::vector<std::uint8_t>                            m_UsedPixels;
  std::optional<sensornoise::MosaicGeometry>           m_Mosaic; // null: not a mosaic
  std::optional<sensornoise::DarkFrameSums<PixelType>> m_Sums;   // null: no frame was read
};

} // namespace itk

#endif
