// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_TemporalFilter_h
#define sensornoise_simulation_TemporalFilter_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>

namespace sensornoise
{

/** Temporal denoising in the camera, a recursive filter: out_t = (1 - a) in_t + a out_(t-1), out_0 = in_0. White noise
 * keeps (1 - a) / (1 + a) of its variance once a^(2 t) has died away, and frames d apart correlate by a^d. */
struct TemporalFilterSettings
{
  /** a, the weight of the last frame [1], 0 to 0.99; 0: no filter. */
  double weight{ 0.0 };

  bool
  IsOn() const
  {
    return weight > 0.0;
  }
};

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
