// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_SimulationSettings_h
#define sensornoise_SimulationSettings_h

#include "SensorNoiseExport.h"
#include "sensornoise/SensorFlaws.h"

#include <cstddef>
#include <cstdint>
#include <optional>
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

/** The camera: the left half of Table 1 of Sur and Grediac 2015 (DOI 10.1137/140977035). The default is camera B. */
struct CameraModel
{
  /** A, electrons of the brightest pixel of the scene [e-], above 0 and at most 1e9. */
  double electrons{ 3000.0 };
  /** g [DN/e-], above 0. */
  double gainDnPerElectron{ 1.0 };
  /** mu, level without light [DN]. */
  double offsetDn{ 100.0 };
  /** sigma, standard deviation of the noise without light [DN], 0 or more. */
  double readNoiseDn{ 8.0 };
};

/** Camera "A", "B" or "C" of Table 1. \throws std::invalid_argument for another name. */
SensorNoise_EXPORT CameraModel
PaperCamera(char name);

/** The light and the floor: the right half of Table 1. The default is condition 3, the realistic one. */
struct SceneConditions
{
  /** Standard deviation of the flicker gamma_t [1], 0 or more. */
  double flickerSd{ 0.05 };
  /** Standard deviation of the horizontal shift alpha_t [pixel], 0 or more. */
  double vibrationSdXPixels{ 0.01 };
  /** Standard deviation of the vertical shift beta_t [pixel], 0 or more. */
  double vibrationSdYPixels{ 0.02 };
};

/** Experimental condition 1, 2 or 3 of Table 1. \throws std::invalid_argument for another number. */
SensorNoise_EXPORT SceneConditions
PaperConditions(int number);

/** All that a simulated stack depends on, beside the reference image. */
struct SimulationSettings
{
  CameraModel     camera{};
  SceneConditions conditions{};
  /** Illumination factors of the frames, by which 1 + gamma_t is multiplied; steady by default. */
  IlluminationSettings illumination{};
  /** T, at least 1. */
  std::size_t frames{ 100 };
  /** Bits of the analogue-to-digital converter, 0 to 32: integer pixels are clipped to [0, 2^bitDepth - 1]; 0 leaves
   * them the whole range of their type. */
  unsigned int bitDepth{ 12 };
  /** The same seed gives the same stack. */
  std::uint64_t seed{ 1 };
  /** Standard deviation of the Gaussian blur of the optics [pixel], 0 or more; the paper has 0.5. */
  double opticalBlurPixels{ 0.5 };
  /** 0: the flicker gamma_t is one normal number a frame (global shutter). Above 0: a lamp that pulses while the rows
   * are read one after the other, gamma_t(y) = sqrt(2) flickerSd sin(2 pi y / period + phase_t), phase uniform [row].
   */
  double rollingShutterPeriodRows{ 0.0 };
  /** Floor of the sensor [DN]; not set: none. */
  std::optional<double> clipLowDn{};
  /** Level at which the sensor saturates [DN]; not set: none. */
  std::optional<double> clipHighDn{};
  /** Photo-response non-uniformity: standard deviation of the pixels' relative sensitivity [1], 0 or more. */
  double prnuSd{ 0.0 };
  /** Dark-signal non-uniformity: standard deviation of the pixels' offset about offsetDn [DN], 0 or more. */
  double dsnuSdDn{ 0.0 };
  /** Fraction of the pixels with excess read noise, from 0 to 1. */
  double hotPixelFraction{ 0.0 };
  /** Read noise of those pixels in units of the others', 0 or more. */
  double hotPixelNoiseFactor{ 10.0 };
  /** What else a real sensor does; all off. */
  SensorFlaws flaws{};
  /** The shutter is closed: no pixel expects an electron. Gains, offsets and read noise of the pixels depend on the
   * seed alone, so the same settings with and without light are the same sensor; the noise of dark frames is
   * independent of that of bright ones. */
  bool isDark{ false };
};

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const SimulationSettings & settings);

} // namespace sensornoise

#endif
