// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameRepetition_h
#define sensornoise_simulation_FrameRepetition_h

#include "simulation/SettingChecks.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

/** Frames that are written more than once, as when a recorder runs faster than the camera: each exposure, or each so
 * manieth of them. */
struct RepetitionSettings
{
  /** How often such an exposure is written, 1 or more; 1: no frame is repeated. */
  std::size_t count{ 1 };
  /** Such is the last of so many exposures, 1 or more; 1: each, 3: each third one, 0 1 2 2 3 4 5 5 of a count of 2. */
  std::size_t period{ 1 };

  /** The exposure that frame \a frame of the stack shows. */
  std::size_t
  ExposureOf(std::size_t frame) const
  {
    const std::size_t inPeriod = std::min(frame % FramesOfPeriod(), period - 1);
    return frame / FramesOfPeriod() * period + inPeriod;
  }

  /** The first frame that shows it. */
  std::size_t
  FirstFrameOf(std::size_t exposure) const
  {
    return exposure / period * FramesOfPeriod() + exposure % period;
  }

private:
  std::size_t
  FramesOfPeriod() const
  {
    return period - 1 + count;
  }
};

/** \throws std::invalid_argument if the setting cannot be used. */
inline void
CheckSettings(const RepetitionSettings & settings)
{
  RequireSetting(
    settings.count >= 1, "number of times that a frame is written", static_cast<double>(settings.count), "1 or more");
  RequireSetting(
    settings.period >= 1, "period of repeated frames", static_cast<double>(settings.period), "1 or more exposures");
}

} // namespace sensornoise

#endif
