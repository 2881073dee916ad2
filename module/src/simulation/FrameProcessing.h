// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameProcessing_h
#define sensornoise_simulation_FrameProcessing_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/SensorFlaws.h"
#include "simulation/DoubleFrame.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>

/** \file
 * The processing of whole frames, in order. */

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const DefectCorrectionSettings & settings);

/** Returns \a codesDn with corrected defects [DN]; every decision uses the uncorrected frame. */
SensorNoise_EXPORT DoubleFrame
CorrectDefects(const DoubleFrame & codesDn, const DefectCorrectionSettings & settings, const ParallelFor & parallelFor);

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

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const MedianSettings & settings);

/** Returns \a codesDn filtered [DN]. */
SensorNoise_EXPORT DoubleFrame
FilterByMedian(const DoubleFrame & codesDn, const MedianSettings & settings, const ParallelFor & parallelFor);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const SmoothingSettings & settings);

/** Returns \a codesDn smoothed [DN]. */
SensorNoise_EXPORT DoubleFrame
SmoothFrame(DoubleFrame codesDn, const SmoothingSettings & settings, const ParallelFor & parallelFor);

/** Returns whether a row depends on other rows of its frame, or on other frames. */
inline bool
NeedsWholeFrames(const SensorFlaws & flaws)
{
  return flaws.brighterFatter.IsOn() || flaws.coupling.IsOn() || flaws.defectCorrection.IsOn() ||
         flaws.temporalFilter.IsOn() || flaws.median.IsOn() || flaws.smoothing.IsOn() || flaws.binning.IsOn() ||
         flaws.resampling.IsOn() || flaws.blocks.IsOn();
}

/** Redistributes the charges [e-] between collection and read-out: brighter-fatter effect, then coupling. */
SensorNoise_EXPORT DoubleFrame
MoveCharge(DoubleFrame charge, const SensorFlaws & flaws, const ParallelFor & parallelFor);

/** Processes the codes [DN] before the temporal filter: correction of defects. */
SensorNoise_EXPORT DoubleFrame
ProcessBeforeTemporalFilter(DoubleFrame codesDn, const SensorFlaws & flaws, const ParallelFor & parallelFor);

/** Processes the codes [DN] after the temporal filter: median, smoothing, binning, resampling, and last the compression
 * in blocks, which needs the \a bitDepth of the converter. */
SensorNoise_EXPORT DoubleFrame
ProcessAfterTemporalFilter(DoubleFrame         codesDn,
                           const SensorFlaws & flaws,
                           unsigned int        bitDepth,
                           const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
