// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackMaps_h
#define sensornoise_moments_StackMaps_h

#include "SensorNoiseExport.h"
#include "base/Constants.h"
#include "moments/Constants.h"
#include "moments/TemporalMoments.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "sensornoise/StepResults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace sensornoise
{

// A saturation level is found from repeated extreme values. Noise alone makes the outermost level the extreme of few
// pixels, of fewer than the levels inside. At a clip level, the extremes of all pixels that would exceed it accumulate.

/** Returns whether the outermost level is a saturation level: the extreme of \a atEnd pixels, at least 8 and more than
 * 3 times \a mostInside. \a mostInside is the largest number of pixels on one of the levels inside. */
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

/** Returns whether a repeated extreme value is evidence of clipping. It is no evidence if the noise is below half a
 * step of the levels, because then every level is repeated. It is no evidence either if \a depth, see ExtremeDepths, is
 * 2.5 or more. \a typicalVarianceDn2 is the median variance of the pixels that vary [DN^2], \a stepDn the spacing of
 * the levels [DN]. */
inline bool
IsClipEvidence(double typicalVarianceDn2, double stepDn, double depth)
{
  return typicalVarianceDn2 >= InCommon.hiddenVariance * stepDn * stepDn && depth < InMoments.largestClipDepth;
}

/** Histogram of the extremes of the pixels over time: the number of pixels by digital number. */
class SensorNoise_EXPORT DnHistogram
{
public:
  DnHistogram();
  /** Counts a pixel whose extreme is \a valueDn, a whole number from -32768 to 65535 [DN]. */
  void
  Add(double valueDn)
  {
    ++m_Counts[static_cast<std::size_t>(static_cast<std::int32_t>(valueDn) + RoomBelowZero)];
  }
  /** Returns the number of pixels whose extreme is \a valueDn. */
  std::uint32_t
  Count(std::int32_t valueDn) const
  {
    const std::int32_t i = valueDn + RoomBelowZero;
    return i < 0 || i >= static_cast<std::int32_t>(m_Counts.size()) ? 0 : m_Counts[static_cast<std::size_t>(i)];
  }
  /** Returns the digital numbers that occur, ascending. */
  std::vector<std::int32_t>
  Occupied() const;
  /** Returns whether Add() accepts \a value. */
  static bool
  Accepts(double value)
  {
    return value >= -RoomBelowZero && value <= 65535.0 && value == std::floor(value);
  }

private:
  static constexpr std::int32_t RoomBelowZero = 32768; // for signed and unsigned 16-bit digital numbers
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
      ++m_Counts.begin()->second; // shortcut, which every second pixel takes at a clip level
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

  /** Removes the outermost levels that lie beyond a saturation level and apart from it, as FindEndOfDnRange() does: the
   * levels of stuck pixels. \a stepDn is the spacing of the levels [DN]. */
  void
  LeaveOutStray(double stepDn);

  /** Returns the spacing of the levels [DN]: the quantile 0.1 of the distances between neighbours. Digital numbers that
   * no pixel has make most distances longer; stray values make a few shorter. 0: fewer than two levels. */
  double
  Step() const;

  /** Returns the largest number of pixels on one of the levels at most 16 steps inside of the outermost level. */
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

/** Returns the quantization step [DN]: the most frequent distance between neighbouring digital numbers that occur.
 * Without a majority it is the greatest common divisor of the distances.
 *
 * 12 bits left-aligned in 16 bits have the step 16. Rescaled data (for example by 65535/4095) have distances of 16 and
 * 17, so that more than 2 % of the digital numbers lie off the grid. Then \a regular is set to false. A few stray
 * digital numbers do not matter. */
SensorNoise_EXPORT double
FindQuantisationStep(const std::vector<std::int32_t> & valuesDn, bool & regular);

/** A digital number [DN], and the number of pixels that have it as an extreme over time. */
struct DnCount
{
  std::int32_t  valueDn;
  std::uint32_t pixels;
};

/** Finds the local quantization steps. \a counts holds all digital numbers that occur, ascending.
 *
 * Only neighbouring digital numbers that are the extreme of at least 8 pixels each are used: between them no number is
 * missing by chance. Means of at least 12 distances are compared. Rescaled data, whose steps are irregular but the same
 * everywhere, therefore have no table. */
SensorNoise_EXPORT QuantisationSteps
FindLocalSteps(const std::vector<DnCount> & counts);

/** Returns the spacing of the digital numbers of a stack, by which FindDnRange() finds their ends [DN]: the
 * quantization step, or the greatest common divisor of the distances of companded numbers. Both histograms together
 * determine it. */
SensorNoise_EXPORT double
FindSpacingDn(const DnHistogram & minima, const DnHistogram & maxima, const DnSettings & settings);

/** Returns the outermost digital number of \a extremes that is not due to stray pixels [DN].
 *
 * This is the highest or the lowest digital number, unless only few pixels lie beyond a saturation level, see
 * IsClipLevel(), separated from it by a gap. Then the saturation level is the end: a stuck pixel does not hide the
 * saturation level of the others. \a step is the quantization step [DN]. The histogram must not be empty. */
SensorNoise_EXPORT std::int32_t
FindEndOfDnRange(const DnHistogram & extremes, bool isHigh, double step);

/** Finds the bit depth, the quantization step and the clip levels of integer data from the extremes of every pixel over
 * time.
 *
 * Given values take precedence. The bit depth is the smallest of 8, 10, 12, 14 and 16 that holds the digital numbers. A
 * clip level is found from repeated extreme values, else it is the end of the DN range. Many sensors saturate below
 * this end, for example at 3,400 of 4,095, or never fall to 0. \a typicalVarianceDn2 is the median temporal variance of
 * the pixels that vary [DN^2]. Where repeated extreme values are not evidence of clipping, see IsClipEvidence(), the
 * end of the DN range is used.
 *
 * Throws std::invalid_argument if the stack holds no pixel, or a level above the bit depth. */
SensorNoise_EXPORT DnRange
FindDnRange(const DnHistogram &   minima,
            const DnHistogram &   maxima,
            double                typicalVarianceDn2,
            const DnSettings &    settings,
            const ExtremeDepths & depths = {});

/** Returns the given settings only: floating-point data have no digital numbers. */
SensorNoise_EXPORT DnRange
GivenDnRange(const DnSettings & settings);

/** Finds the clip levels of floating-point data from the extremes of every pixel over time, as FindDnRange() does for
 * integers. A clip level is a repeated extreme value: many pixels have exactly the outermost value as extreme.
 *
 * Given values take precedence. Floating-point data have no DN range: where no level is given and no extreme value is
 * repeated, no pixel is clipped. Converted digital numbers, and digital numbers scaled by one number, have the same
 * repeated values, and are compared with the levels one step apart. The division by a flat field spreads a clip level
 * over many values; then it cannot be found and must be given.
 *
 * \a typicalVarianceDn2 is the median temporal variance of the pixels that vary [DN^2], see IsClipEvidence(). \a minima
 * or \a maxima may be empty if they are known to have no repeated extreme value. */
SensorNoise_EXPORT DnRange
FindLevels(const OutermostLevels & minima,
           const OutermostLevels & maxima,
           double                  typicalVarianceDn2,
           const DnSettings &      settings,
           const ExtremeDepths &   depths = {});

/** Summarises a stack with these \a maps. The digital numbers and clip levels are given or found, see FindDnRange() and
 * FindLevels().
 * \param valid has room for the pixels of a frame; it receives 1 where a pixel is finite and never at a clip level,
 * else 0
 *
 * Throws std::invalid_argument if the data exceed the given bit depth. */
template <typename TPixel>
SensorNoise_EXPORT StackSummary
SummariseStack(const TemporalMaps<TPixel> & maps,
               const DnSettings &           settings,
               const ParallelFor &          parallelFor,
               std::uint8_t *               valid);

/** Maps of a stack, of a frame's size, and their summary. */
struct StackMaps
{
  StackSummary              summary;
  std::vector<double>       mean;     ///< mean over time [DN]; NaN where a pixel was not finite in a frame
  std::vector<double>       variance; ///< unbiased variance over time [DN^2]; 0 for a single frame
  std::vector<std::uint8_t> valid;    ///< see SummariseStack()
};

/** Makes the maps from the moments, which are consumed: mean and variance take the memory of the sums. The pixels
 * that are 0 in \a mask have no influence on digital numbers, clip levels and counts; empty: all pixels have.
 *
 * A floating-point number may have any size, and one value of one pixel may move the means of the neighbours by more
 * than their noise. Such a pixel has the median of the means of its neighbours, and the variance NaN: it is not
 * measured, and the others are measured as if it were one of them. The value lies far beyond all others of the pixel,
 * and of the neighbours: with another illumination of the frame they would have such values, too. \a width is the
 * number of columns of a frame; 0: all pixels keep their mean. */
template <typename TPixel>
SensorNoise_EXPORT StackMaps
MakeStackMaps(TemporalMoments<TPixel>           moments,
              const DnSettings &                settings,
              const ParallelFor &               parallelFor,
              const std::vector<std::uint8_t> & mask = {},
              std::size_t                       width = 0);

/** Returns whether the values of a stack are counts, so that 0 means no event and not a clip level.
 *
 * The variance of counts is proportional to their mean, down to a fraction of one. A sensor whose offset is near 0 has
 * read noise and quantization noise there, clipped at 0, so that the ratio of variance to mean changes. The ratio is
 * compared between pixels with a mean below one step, of 1 to 3, of 3 to 10, and above 10 steps. \a stepDn is the
 * quantization step [DN]. */
template <typename TPixel>
bool
AreCountsFromZero(const TemporalMaps<TPixel> & maps, double stepDn)
{
  constexpr std::size_t      groups = 4;
  std::array<double, groups> mean{};
  std::array<double, groups> variance{};
  std::array<double, groups> squares{}; // sum of the squared variances
  std::array<double, groups> pixels{};
  const std::size_t          stride = std::max<std::size_t>(1, maps.GetNumberOfPixels() / InCommon.pixelsOfSample);
  for (std::size_t p = 0; p < maps.GetNumberOfPixels(); p += stride)
  {
    const double steps = maps.mean[p] / stepDn;
    if (maps.IsMeasured(p) && maps.GetMinimum(p) >= 0.0 && steps > InMoments.leastCount &&
        steps < InMoments.largestCount)
    {
      const std::size_t group = steps < 1.0 ? 0 : steps < 3.0 ? 1 : steps < 10.0 ? 2 : 3;
      mean[group] += steps;
      const double ofSteps = maps.variance[p] / (stepDn * stepDn);
      variance[group] += ofSteps;
      squares[group] += ofSteps * ofSteps;
      pixels[group] += 1.0;
    }
  }
  // The standard error of the mean variance of a group is sqrt(spread) / pixels.
  double      least = 0.0;
  double      largest = 0.0;
  std::size_t reliable = 0;
  for (std::size_t k = 0; k < groups; ++k)
  {
    const double spread = squares[k] - variance[k] * variance[k] / std::max(1.0, pixels[k]);
    if (variance[k] > 0.0 && std::sqrt(std::max(0.0, spread)) < InMoments.errorOfCountRatio * variance[k])
    {
      const double ratio = variance[k] / mean[k];
      least = reliable == 0 ? ratio : std::min(least, ratio);
      largest = reliable == 0 ? ratio : std::max(largest, ratio);
      ++reliable;
    }
  }
  return reliable >= 2 && largest < (1.0 + InMoments.largestCountRatio) * least;
}

/** Returns the Bayer pattern of a frame, one exposure or the mean of many [DN], if its levels alternate as behind a
 * Bayer mosaic. There must be three different levels, one of them on both pixels of a diagonal of the 2 x 2 pixels,
 * everywhere. Null: the levels do not alternate in this way, as with a monochrome sensor or a dark mosaic.
 *
 * In blocks of 32 x 32 pixels every pixel is compared with its neighbours of another phase on both sides, so that
 * edges and slopes of the scene cancel. A fine checkerboard has two levels, stripes have no diagonal of equal levels.
 * A grid of dots with a period of exactly two pixels in the whole frame cannot be distinguished from a mosaic.
 *
 * The levels do not determine which of the two colours that are not green is red: the brighter one is called red. */
template <typename TPixel>
SensorNoise_EXPORT std::optional<BayerPattern>
RecogniseMosaic(const TPixel *      frameDn,
                std::size_t         width,
                std::size_t         height,
                const ParallelFor & parallelFor = SerialFor);

inline std::optional<BayerPattern>
RecogniseMosaic(const std::vector<double> & frameDn,
                std::size_t                 width,
                std::size_t                 height,
                const ParallelFor &         parallelFor = SerialFor)
{
  return RecogniseMosaic(frameDn.data(), width, height, parallelFor);
}

} // namespace sensornoise

#endif
