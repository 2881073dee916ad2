// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef StressStacks_h
#define StressStacks_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/** \file
 * Simulated bursts with what goes wrong in real life: light that is not the same everywhere, things that move, sensors
 * with flaws, codes that are not the sensor's own. Every stack is a function of its name, reference, size and seed. */

namespace sensornoise::tools
{

/** What an estimator should make of a case. */
enum class StressExpectation
{
  Measured, ///< gain and intercept as they are
  Bent,     ///< the response bends: the gain's interval holds the mean of the local gain
  Refused,  ///< the codes are no affine function of the light: the gain is `failed`
  Processed ///< noise is shared between pixels or frames: reported, neither right nor wrong
};

/** One kind of trouble. */
struct StressCase
{
  std::string       name;
  std::string       what; ///< one line for people
  StressExpectation expectation{ StressExpectation::Measured };
};

/** What is true of the pixels that an estimate used. */
struct StressTruth
{
  double gain{ 0.0 };      ///< g, d(mean code)/d(electron) [DN/e-]
  double offset{ 0.0 };    ///< mu [DN]
  double intercept{ 0.0 }; ///< sigma^2 - g mu, sigma the pixels' own [DN^2]

  /** The truth to compare with. A pixel's variance without light also holds what the pixels of a row, a column or a
   * band share: an estimate may count all of it, or none, or a part as far as it is told from the rest.
   * \param found the estimate [DN^2]
   * \param sharedVariance of the stack [DN^2] */
  double
  InterceptNear(double found, double sharedVariance) const;
};

/** A burst, frame after frame, and what is true of its codes. */
struct StressStack
{
  std::vector<std::uint16_t> codes;
  std::size_t                width{ 0 };
  std::size_t                height{ 0 };
  std::size_t                frames{ 0 };
  bool                       isEightBit{ false };   ///< a camera would give it in bytes
  double                     gain{ 0.0 };           ///< g [DN/e-]
  double                     offset{ 0.0 };         ///< mu [DN]
  double                     readNoise{ 0.0 };      ///< sigma of the pixels alone [DN]
  double                     sharedVariance{ 0.0 }; ///< of what the pixels of a row, a column or a band share [DN^2]
  /** The truth of each pixel, where pixels differ by design or the response is bent; else empty. The intercept of a
   * pixel is the variance of its own read noise minus its local gain times its offset. */
  std::vector<StressTruth> ofPixel;

  /** The mean over the pixels with a 1 in \a isUsed; over all if there is none. */
  StressTruth
  TruthOver(const std::vector<std::uint8_t> & isUsed) const;
};

/** All cases, in the order in which they are reported. */
std::vector<StressCase>
GetStressCases();

/** Simulates a case with a square reference image, "target" or "texture".
 * \throws std::invalid_argument if the case or the reference is not known. */
StressStack
MakeStressStack(const std::string & name, const std::string & reference, std::size_t size, std::uint64_t seed);

} // namespace sensornoise::tools

#endif
