// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_TemporalFilter_h
#define sensornoise_simulation_TemporalFilter_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>

namespace sensornoise
{

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const TemporalFilterSettings & settings);

/** \class TemporalFilter
 * Frames in any order, with the same bits: the last output is kept, so that frames one after the other cost one input
 * each; an earlier frame starts again from frame 0. May be called by several threads. */
class SensorNoise_EXPORT TemporalFilter
{
public:
  using InputFrame = std::function<DoubleFrame(std::size_t frame)>;

  explicit TemporalFilter(const TemporalFilterSettings & settings);

  /** Frame \a frame of the output; \a inputOf makes a frame of the input and is asked for each at most once. */
  DoubleFrame
  OutputFrame(std::size_t frame, const InputFrame & inputOf, const ParallelFor & parallelFor);

private:
  struct State
  {
    std::size_t frame{ 0 };
    DoubleFrame output;
  };

  double                       m_Weight;
  std::mutex                   m_Mutex; ///< of the pointer below; never held while a frame is made
  std::shared_ptr<const State> m_Last;
};

} // namespace sensornoise

#endif
