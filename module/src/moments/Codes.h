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

/** Histogram of the extremes of the pixels over time: the number of pixels by digital number. */
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
  /** Returns the number of pixels whose extreme is \a code. */
  std::uint32_t
  Count(std::int32_t code) const
  {
    const std::int32_t i = code + LowestCode;
    return i < 0 || i >= static_cast<std::int32_t>(m_Counts.size()) ? 0 : m_Counts[static_cast<std::size_t>(i)];
  }
  /** Returns the codes that occur, ascending. */
  std::vector<std::int32_t>
  Occupied() const;
  /** Returns whether Add() accepts \a value. */
  static bool
  IsCode(double value)
  {
    return value >= -LowestCode && value <= 65535.0 && value == std::floor(value);
  }

private:
  static constexpr std::int32_t LowestCode = 32768; // room for signed and unsigned 16-bit codes
  std::vector<std::uint32_t>    m_Counts;
};

/** Returns the quantization step [DN]: the most frequent distance between neighbouring codes that occur. Without a
 * majority it is the greatest common divisor of the distances.
 *
 * 12 bits left-aligned in 16 bits have the step 16. Rescaled data (for example by 65535/4095) have distances of 16 and
 * 17, so that more than 2 % of the codes lie off the grid. Then \a regular is set to false. A few stray codes do not
 * matter. */
SensorNoise_EXPORT double
FindQuantisationStep(const std::vector<std::int32_t> & codes, bool & regular);

/** Returns the outermost code of \a extremes that is not due to stray pixels [DN].
 *
 * This is the highest or the lowest code, unless only few pixels have a code beyond a pile-up, see IsPileUp(),
 * separated from it by a gap. Then the pile-up is the end: a stuck pixel does not hide the saturation level of the
 * others. \a step is the quantization step [DN]. The histogram must not be empty. */
SensorNoise_EXPORT std::int32_t
FindEndOfCodes(const CodeHistogram & extremes, bool isHigh, double step);

/** Finds the bit depth, the quantization step and the clip levels of integer data from the extremes of every pixel over
 * time.
 *
 * Given values take precedence. The bit depth is the smallest of 8, 10, 12, 14 and 16 that holds the codes. A clip
 * level is a pile-up of the extremes, else the end of the DN range. Many sensors saturate below this end, for example
 * at 3,400 of 4,095, or never fall to 0. \a typicalVarianceDn2 is the median temporal variance of the pixels that vary
 * [DN^2]. Where a pile-up is not evidence of clipping, see IsPileUpEvidence(), the end of the DN range is used.
 *
 * Throws std::invalid_argument if the stack holds no pixel, or a level above the bit depth. */
SensorNoise_EXPORT CodeRange
FindCodes(const CodeHistogram & minima,
          const CodeHistogram & maxima,
          double                typicalVarianceDn2,
          const CodeSettings &  settings,
          const ExtremeDepths & depths = {});

/** Returns the given settings only: floating-point data have no codes. */
SensorNoise_EXPORT CodeRange
GivenCodes(const CodeSettings & settings);

} // namespace sensornoise

#endif
