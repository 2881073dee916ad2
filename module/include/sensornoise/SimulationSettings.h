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

/** Shapes of the illumination factor over the frames. L is IlluminationSettings::low, P is periodFrames, t is the
 * number of the frame, and T is the number of frames. u_t are uniform and e_t exponential random numbers. */
enum class IlluminationShape
{
  Steady,      ///< 1
  Pulses,      ///< 1 in every P-th frame (t = P - 1, 2 P - 1, ...), L in the others; P rounded to whole frames
  Ramp,        ///< L + (1 - L) t / (T - 1): from L to 1
  Decay,       ///< L^(t / (T - 1)): exponential, from 1 to L
  Sine,        ///< L + (1 - L) (1 + sin(2 pi t / P)) / 2, as of a light source on the mains
  Uniform,     ///< L + (1 - L) u_t
  Exponential, ///< L + (1 - L) e_t, where e_t has the mean 1; the factor may exceed 1
  Factors      ///< IlluminationSettings::factors
};

/** Illumination factors of the frames of a simulated stack, without the flicker. */
struct IlluminationSettings
{
  /** Shape of the illumination factor over the frames; Steady (default): 1. */
  IlluminationShape shape{ IlluminationShape::Steady };
  /** L, the lowest factor [1], 0 to 1; above 0 for Decay. Steady and Factors do not use it. */
  double low{ 0.0 };
  /** P, the period for Pulses and Sine [frame], 1 to 1e9. */
  double periodFrames{ 4.0 };
  /** Factors of all frames for Factors [1], each from 0 to 1e9. */
  std::vector<double> factors{};
};

/** Returns the settings that a text describes: the name of the shape, and then L and P if they differ from the
 * defaults, for example "ramp", "decay:0.1" or "pulses:0.3:4". The names are "steady", "pulses", "ramp", "decay",
 * "sine", "uniform" and "exponential". The default of L is 0.1 for a decay, else 0. Throws std::invalid_argument for
 * any other text. */
SensorNoise_EXPORT IlluminationSettings
IlluminationOf(const std::string & text);

/** Returns whether the text begins with the name of a shape of IlluminationOf(). */
SensorNoise_EXPORT bool
IsIlluminationName(const std::string & text);

/** Returns the text of the settings, as IlluminationOf() reads it; "factors" for Factors. */
SensorNoise_EXPORT std::string
TextOf(const IlluminationSettings & illumination);

/** Parameters of the camera: the left half of Table 1 of Sur and Grediac 2015 (DOI 10.1137/140977035). The default is
 * camera B. */
struct CameraModel
{
  /** A, expected electrons of the brightest pixel of the scene [e-], above 0, at most 1e9. */
  double electrons{ 3000.0 };
  /** g, system gain [DN/e-], above 0, at most 1e9. */
  double gainDnPerElectron{ 1.0 };
  /** mu, dark offset [DN], -1e9 to 1e9. */
  double offsetDn{ 100.0 };
  /** sigma, read noise [DN], 0 to 1e9. */
  double readNoiseDn{ 8.0 };
};

/** Returns camera 'A', 'B' or 'C' of Table 1. Throws std::invalid_argument for any other name. */
SensorNoise_EXPORT CameraModel
PaperCamera(char name);

/** Conditions of the illumination and of the motion: the right half of Table 1. The default is condition 3. */
struct SceneConditions
{
  /** Standard deviation of the flicker gamma_t [1], 0 to 1e9. */
  double flickerSd{ 0.05 };
  /** Standard deviation of the horizontal shift alpha_t [pixel], 0 to 1e9. */
  double vibrationSdXPixels{ 0.01 };
  /** Standard deviation of the vertical shift beta_t [pixel], 0 to 1e9. */
  double vibrationSdYPixels{ 0.02 };
};

/** Returns experimental condition 1, 2 or 3 of Table 1. Throws std::invalid_argument for any other number. */
SensorNoise_EXPORT SceneConditions
PaperConditions(int number);

/** All parameters of a simulated stack, without the reference image. */
struct SimulationSettings
{
  /** Parameters of the camera; camera B by default. */
  CameraModel camera{};
  /** Flicker and vibration; condition 3 by default. */
  SceneConditions conditions{};
  /** Illumination factors of the frames, by which 1 + gamma_t is multiplied; steady by default. */
  IlluminationSettings illumination{};
  /** T, number of frames, at least 1. */
  std::size_t frames{ 100 };
  /** Bit depth of the analogue-to-digital converter [bit], 0 to 32. Integer pixels are clipped to
   * [0, 2^bitDepth - 1]; 0: to the range of their type. */
  unsigned int bitDepth{ 12 };
  /** Seed of all random numbers. The same settings with the same seed give the same stack. */
  std::uint64_t seed{ 1 };
  /** Standard deviation of the Gaussian blur of the optics [pixel], 0 to 1000; the paper has 0.5. */
  double opticalBlurPixels{ 0.5 };
  /** Period of the flicker along y under a rolling shutter [row], 0 to 1e9. 0: a global shutter, where gamma_t is one
   * normal number per frame. Above 0: pulsed illumination while the rows are read one after the other, with
   * gamma_t(y) = sqrt(2) flickerSd sin(2 pi y / period + phase_t), where phase_t is uniform. */
  double rollingShutterPeriodRows{ 0.0 };
  /** Lowest level of the sensor [DN], below clipHighDn; null: none. */
  std::optional<double> clipLowDn{};
  /** Level at which the sensor saturates [DN]; null: none. */
  std::optional<double> clipHighDn{};
  /** Photo-response non-uniformity (PRNU): standard deviation of the relative sensitivity of the pixels [1], 0 to 1e9.
   */
  double prnuSd{ 0.0 };
  /** Dark-signal non-uniformity (DSNU): standard deviation of the offsets of the pixels about offsetDn [DN], 0 to 1e9.
   */
  double dsnuSdDn{ 0.0 };
  /** Fraction of the pixels that are hot, with excess read noise [1], 0 to 1. */
  double hotPixelFraction{ 0.0 };
  /** Read noise of hot pixels over the read noise of the others [1], 0 to 1e9. */
  double hotPixelNoiseFactor{ 10.0 };
  /** Further effects of a real sensor and its camera; all off by default. */
  SensorFlaws flaws{};
  /** Whether the shutter is closed, so that no pixel collects an electron. Gains, offsets and read noise of the pixels
   * depend on the seed alone: the same settings with an open shutter are the same sensor. The noise of dark frames is
   * independent of the noise of bright frames. */
  bool isDark{ false };
};

/** Throws std::invalid_argument if a setting is out of its range, or contradicts another. The message names this
 * setting. */
SensorNoise_EXPORT void
CheckSettings(const SimulationSettings & settings);

} // namespace sensornoise

#endif
