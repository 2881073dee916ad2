// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_Codes_h
#define sensornoise_moments_Codes_h

#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"
#include "moments/PileUp.h"
#include "SensorNoiseExport.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** How many pixels have which code as their extreme over time. */
class SensorNoise_EXPORT CodeHistogram
{
public:
  CodeHistogram();
  /** Counts a pixel whose extreme is \a code, a whole number from -32768 to 65535 [DN]. */
  void
  Add(double code)
  {
    ++m_Counts[static_cast<std::size_t>(static_cast<std::int32_t>(code) + LowestCode)];
  }
  /** Pixels whose extreme is \a code. */
  std::uint32_t
  Count(std::int32_t code) const
  {
    const std::int32_t i = code + LowestCode;
    return i < 0 || i >= static_cast<std::int32_t>(m_Counts.size()) ? 0 : m_Counts[static_cast<std::size_t>(i)];
  }
  /** The codes that occur, ascending. */
  std::vector<std::int32_t>
  Occupied() const;
  /** Whether Add() takes a value. */
  static bool
  IsCode(double value)
  {
    return value >= -LowestCode && value <= 65535.0 && value == std::floor(value);
  }

private:
  static constexpr std::int32_t LowestCode = 32768; // room for signed and unsigned 16-bit codes
  std::vector<std::uint32_t>    m_Counts;
};

/** The spacing of the codes: the majority of the distances between neighbouring codes that occur.
 *
 * 12 bits left-aligned in 16 have the spacing 16. Data that were rescaled (for example by 65535/4095) have spacings of
 * 16 and 17, so that their codes drift through all remainders: more than 2 % of the codes off the grid, and \a regular
 * is false. A few stray codes do not matter. */
SensorNoise_EXPORT double
FindQuantisationStep(const std::vector<std::int32_t> & codes, bool & regular);

/** The outermost code of extremes that is the extreme of more than stray pixels. It is the highest or the lowest code,
 * unless that lies beyond a pile-up, see IsPileUp(), apart from it, and so do all other codes beyond: a stuck pixel
 * does not hide the level at which all others saturate. \a step is the spacing of the codes. Some pixel was added. */
SensorNoise_EXPORT std::int32_t
FindEndOfCodes(const CodeHistogram & extremes, bool isHigh, double step);

/** Finds bit depth, code step and clip levels of integer data from every pixel's extremes over time.
 *
 * Given values win. The bit depth is the smallest of 8, 10, 12, 14 and 16 that holds the codes. A clip level is a
 * pile-up of the extremes, else the end of the code range (design: a sensor that saturates at 3,400 of 4,095, or rests
 * on a floor above 0, is common). \a typicalVarianceDn2 is the median temporal variance of the pixels that vary: where
 * a pile-up says nothing, see CanTellPileUp(), only the code range is trusted.
 *
 * Throws std::invalid_argument if the data pass what was given. */
SensorNoise_EXPORT CodeRange
FindCodes(const CodeHistogram & minima,
          const CodeHistogram & maxima,
          double                typicalVarianceDn2,
          const CodeSettings &  settings,
          const ExtremeDepths & depths = {});

/** What is given, and nothing else: floating-point data have no codes. */
SensorNoise_EXPORT CodeRange
GivenCodes(const CodeSettings & settings);

} // namespace sensornoise

#endif
