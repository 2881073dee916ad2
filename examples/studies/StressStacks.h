// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef StressStacks_h
#define StressStacks_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/** \file
 * Simulated bursts with faults of real recordings: illumination that varies over the frame, moving objects, sensors
 * with flaws, and grey values that were changed after the converter. Each stack is a function of its name,
 * reference, size and seed.
 */

namespace sensornoise::tools
{

/** Expected result of an estimator. */
enum class StressExpectation
{
  Measured,  ///< gain and intercept agree with the true values
  Nonlinear, ///< non-linear response: the interval of the gain contains the mean local gain
  Refused,   ///< the grey values are not an affine function of the signal: the gain is `failed`
  Processed  ///< the noise is correlated between pixels or frames: reported, but not tested
};

/** Case of a simulated burst. */
struct StressCase
{
  std::string       name;
  std::string       what; ///< one-line description
  StressExpectation expectation{ StressExpectation::Measured };
};

/** True values of a pixel, or their means over the pixels that an estimate used. */
struct StressTruth
{
  double gain{ 0.0 };      ///< g, d(mean digital number)/d(electron) [DN/e-]
  double offset{ 0.0 };    ///< mu [DN]
  double intercept{ 0.0 }; ///< sigma^2 - g mu, with the read noise sigma of single pixels [DN^2]

  /** Returns the true intercept that an estimate is compared with [DN^2]. The dark variance of a pixel also contains
   * row noise, column noise and banding. An estimate may include none, all, or any part of their variance.
   * \param found the estimate [DN^2]
   * \param lineVarianceDn2 variance of row noise, column noise and banding of the stack [DN^2] */
  double
  InterceptNear(double found, double lineVarianceDn2) const;
};

/** Burst, frame after frame, and its true values. */
struct StressStack
{
  std::vector<std::uint16_t> greyValues;
  std::size_t                width{ 0 };
  std::size_t                height{ 0 };
  std::size_t                frames{ 0 };
  bool                       isEightBit{ false };    ///< a camera would write 8 bits per pixel
  double                     gain{ 0.0 };            ///< g [DN/e-]
  double                     offset{ 0.0 };          ///< mu [DN]
  double                     readNoise{ 0.0 };       ///< sigma, without row noise, column noise and banding [DN]
  double                     lineVarianceDn2{ 0.0 }; ///< variance of row noise, column noise and banding [DN^2]
  /** True values of each pixel if the pixels differ by design or the response is non-linear; else empty. The
   * intercept of a pixel is the variance of its read noise minus its local gain times its offset. */
  std::vector<StressTruth> ofPixel;

  /** Returns the mean over the pixels with a 1 in \a isUsed, or over all pixels if none has a 1. */
  StressTruth
  TruthOver(const std::vector<std::uint8_t> & isUsed) const;
};

/** Returns all cases, in the order in which they are reported. */
std::vector<StressCase>
GetStressCases();

/** Simulates a case with a square reference image, "target" or "texture".
 * \throws std::invalid_argument if the case or the reference is not known */
StressStack
MakeStressStack(const std::string & name, const std::string & reference, std::size_t size, std::uint64_t seed);

} // namespace sensornoise::tools

#endif
