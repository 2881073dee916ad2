// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_Codes_h
#define sensornoise_moments_Codes_h

#include "sensornoise/StepResults.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "base/Constants.h"
#include "moments/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace sensornoise
{

// Pile-up: saturation level found from repeated extreme values. Noise alone makes the outermost level the extreme of
// few pixels, of fewer than the levels inside. At a clip level, the extremes of all pixels that would exceed it
// accumulate.

/** Returns whether the \a atEnd pixels whose extreme is the outermost level are a pile-up: at least 8, and more than 3
 * times \a mostInside. \a mostInside is the largest number of pixels on one of the levels inside. */
inline bool
IsClipLevel(std::size_t atEnd, std::size_t mostInside)
{
  return atEnd >= std::max(InMoments.fewestPixelsOfClipLevel, InMoments.clipLevelRatio * mostInside + 1);
}

/** Distance of the outermost levels from the mean of the pixels that attain them, in temporal standard deviations of
 * these pixels: the median over the pixels [1]. Pixels that a clip level cuts off have a mean near that level. If the
 * level is rare noise, or the quantization is as coarse as the noise, the distance is some standard deviations. */
struct ExtremeDepths
{
  double low{ 0.0 };  ///< depth of the lowest level [1]
  double high{ 0.0 }; ///< depth of the highest level [1]
};

/** Returns whether a pile-up is evidence of clipping. It is not if the noise is below half a step of the levels,
 * because then every level piles up. Nor is it if \a depth, see ExtremeDepths, is 2.5 or more. \a typicalVarianceDn2
 * is the median variance of the pixels that vary [DN^2], \a stepDn the spacing of the levels [DN]. */
inline bool
IsClipEvidence(double typicalVarianceDn2, double stepDn, double depth)
{
  return typicalVarianceDn2 >= InCommon.hiddenVariance * stepDn * stepDn && depth < InMoments.largestClipDepth;
}

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

/** \class OutermostLevels
 * \brief Histogram of the extremes of the pixels over time, for the 64 lowest or highest values of a floating-point
 * stack.
 *
 * Values are the same level only if they are exactly equal. The counts are exact for any order of the pixels: a level
 * that left the table has 64 others beyond it and cannot return. */
class SensorNoise_EXPORT OutermostLevels
{
public:
  enum class End
  {
    Low,
    High
  };

  explicit OutermostLevels(End end)
    : m_Sign(end == End::High ? 1.0 : -1.0)
  {}

  /** Adds a pixel whose extreme is \a value, a finite number. */
  void
  Add(double value)
  {
    const double outwards = m_Sign * value;
    if (!m_Counts.empty() && outwards == m_Counts.begin()->first)
    {
      ++m_Counts.begin()->second; // shortcut: at a clip level this is every second pixel
    }
    else if (m_Counts.size() < MostLevels || outwards >= m_Innermost)
    {
      this->Insert(outwards);
    }
  }

  /** Outermost level [DN]; the table must not be empty. */
  double
  Level() const
  {
    return m_Sign * m_Counts.begin()->first + 0.0; // + 0.0 turns -0 into 0
  }
  /** Number of pixels whose extreme is the outermost level; 0 if the table is empty. */
  std::size_t
  Pixels() const
  {
    return m_Counts.empty() ? 0 : m_Counts.begin()->second;
  }

  /** Removes the outermost levels that lie beyond a pile-up and apart from it, as FindEndOfCodes() does: the levels of
   * stuck pixels. \a stepDn is the spacing of the levels [DN]. */
  void
  LeaveOutStray(double stepDn);

  /** Returns the spacing of the levels [DN]: the quantile 0.1 of the distances between neighbours. Codes that no pixel
   * has make most distances longer; stray values make a few shorter. 0: fewer than two levels. */
  double
  Step() const;

  /** Returns the largest number of pixels on one of the levels at most 16 steps inside of the outermost one. */
  std::size_t
  MostInside(double stepDn) const;

private:
  static constexpr std::size_t MostLevels = 64;

  using Counts = std::map<double, std::size_t, std::greater<double>>; // outermost level first

  void
  Insert(double outwards);

  /** Returns the largest number of pixels on one of the levels at most 16 steps inside of \a end. */
  std::size_t
  MostInside(Counts::const_iterator end, double stepDn) const;

  double m_Sign;
  double m_Innermost{ 0.0 }; // innermost level of the table
  Counts m_Counts;
};

/** Returns the quantization step [DN]: the most frequent distance between neighbouring codes that occur. Without a
 * majority it is the greatest common divisor of the distances.
 *
 * 12 bits left-aligned in 16 bits have the step 16. Rescaled data (for example by 65535/4095) have distances of 16 and
 * 17, so that more than 2 % of the codes lie off the grid. Then \a regular is set to false. A few stray codes do not
 * matter. */
SensorNoise_EXPORT double
FindQuantisationStep(const std::vector<std::int32_t> & codes, bool & regular);

/** A digital number [DN], and the number of pixels that have it as an extreme over time. */
struct SeenCode
{
  std::int32_t  code;
  std::uint32_t pixels;
};

/** Finds the local quantization steps of \a codes: all digital numbers that occur, ascending.
 *
 * Only neighbouring codes that are the extreme of at least 8 pixels each are used: between them no code is missing by
 * chance. Means of at least 12 distances are compared. Rescaled data, whose steps are irregular but the same
 * everywhere, therefore have no table. */
SensorNoise_EXPORT CodeSteps
FindCodeSteps(const std::vector<SeenCode> & codes);

/** Returns the outermost code of \a extremes that is not due to stray pixels [DN].
 *
 * This is the highest or the lowest code, unless only few pixels have a code beyond a pile-up, see IsClipLevel(),
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
 * [DN^2]. Where a pile-up is not evidence of clipping, see IsClipEvidence(), the end of the DN range is used.
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

/** Finds the clip levels of floating-point data from the extremes of every pixel over time, as FindCodes() does for
 * integers. A clip level is a pile-up of the extremes: many pixels have exactly the outermost value as extreme.
 *
 * Given values take precedence. Floating-point data have no DN range: where nothing is given and nothing piles up, no
 * pixel is clipped. Converted codes, and codes scaled by one number, pile up like the codes, and are compared with the
 * levels one step apart. The division by a flat field spreads a clip level over many values; then it cannot be found
 * and must be given.
 *
 * \a typicalVarianceDn2 is the median temporal variance of the pixels that vary [DN^2], see IsClipEvidence(). \a
 * minima or \a maxima may be empty if they are known to have no pile-up. */
SensorNoise_EXPORT CodeRange
FindLevels(const OutermostLevels & minima,
           const OutermostLevels & maxima,
           double                  typicalVarianceDn2,
           const CodeSettings &    settings,
           const ExtremeDepths &   depths = {});

} // namespace sensornoise

#endif
