// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_Illumination_h
#define sensornoise_simulation_Illumination_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** How the illumination changes from frame to frame. L is IlluminationSettings::low, P its period, t the frame, T the
 * number of frames, u_t uniform and e_t exponential random numbers. */
enum class IlluminationShape
{
  Steady,      ///< 1
  Pulses,      ///< 1 in every P-th frame (t = P - 1, 2 P - 1, ...), L in the others; P rounded to whole frames
  Ramp,        ///< L + (1 - L) t / (T - 1): from L to 1
  Decay,       ///< L^(t / (T - 1)): exponential, from 1 to L
  Sine,        ///< L + (1 - L) (1 + sin(2 pi t / P)) / 2: a lamp on the mains
  Uniform,     ///< L + (1 - L) u_t
  Exponential, ///< L + (1 - L) e_t, where e_t has the mean 1: may exceed 1
  Factors      ///< IlluminationSettings::factors
};

/** Illumination factor of every frame of a simulated stack, without its flicker. */
struct IlluminationSettings
{
  IlluminationShape shape{ IlluminationShape::Steady };
  /** L, lowest factor [1], 0 to 1; above 0 for Decay. Steady and Factors do not use it. */
  double low{ 0.0 };
  /** P, period [frames], at least 1; for Pulses and Sine. */
  double periodFrames{ 4.0 };
  /** Factors of the frames [1], 0 or more and at most 1e9, one each; for Factors. */
  std::vector<double> factors{};
};

/** Reads a shape from text: its name, then L and P where they differ from the defaults, as in "ramp", "decay:0.1" or
 * "pulses:0.3:4". The names are "steady", "pulses", "ramp", "decay", "sine", "uniform" and "exponential".
 * \throws std::invalid_argument if the text is none of these. */
SensorNoise_EXPORT IlluminationSettings
IlluminationOf(const std::string & text);

/** Whether the text begins with the name of a shape that IlluminationOf() knows. */
SensorNoise_EXPORT bool
IsIlluminationName(const std::string & text);

/** Returns the text that IlluminationOf() reads; "factors" for Factors. */
SensorNoise_EXPORT std::string
TextOf(const IlluminationSettings & illumination);

/** \throws std::invalid_argument naming the first setting that cannot be used for a stack of `frames` frames. */
SensorNoise_EXPORT void
CheckSettings(const IlluminationSettings & illumination, std::size_t frames);

/** Returns the illumination factor of a frame [1]. A random one depends on the seed and on the frame alone. */
SensorNoise_EXPORT double
IlluminationFactor(const IlluminationSettings & illumination,
                   std::size_t                  frame,
                   std::size_t                  frames,
                   std::uint64_t                seed);

} // namespace sensornoise

#endif
