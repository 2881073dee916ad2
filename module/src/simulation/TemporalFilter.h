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

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const TemporalFilterSettings & settings);

/** \class TemporalFilter
 * \brief Recursive temporal filter, which outputs frames in any order with the same bits.
 *
 * The last output is kept, so that consecutive frames need one input each; an earlier frame starts again from frame 0.
 * Several threads may call it. */
class SensorNoise_EXPORT TemporalFilter
{
public:
  using InputFrame = std::function<DoubleFrame(std::size_t frame)>;

  explicit TemporalFilter(const TemporalFilterSettings & settings);

  /** Returns frame \a frame of the output. \a inputOf makes a frame of the input; it is called at most once for each.
   */
  DoubleFrame
  OutputFrame(std::size_t frame, const InputFrame & inputOf, const ParallelFor & parallelFor);

private:
  struct State
  {
    std::size_t frame{ 0 };
    DoubleFrame output;
  };

  double                       m_Weight;
  std::mutex                   m_Mutex; ///< protects the pointer below; never held while a frame is computed
  std::shared_ptr<const State> m_Last;
};

} // namespace sensornoise

#endif
