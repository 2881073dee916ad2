// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_IsoIntensitySet_h
#define sensornoise_published_IsoIntensitySet_h

#include "SensorNoiseExport.h"
#include "base/IntensityIndex.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \class IsoIntensitySet
 * \brief Pixels of nearly one intensity, over which a frame's response is averaged: S^* or S_* of (3.7) and (3.13).
 *
 * Sur & Gredi\'ac 2015, https://doi.org/10.1137/140977035. The level u is a quantile of the mean over the pixels kept
 * by the vibration mask. The set is |mean - u| <= 3 sigma_u, with the weights exp(-(mean - u)^2 / (2 sigma_u^2)) of
 * Remark 1.
 *
 * The paper leaves open what sigma_u, "the associated standard deviation", is. Here it is the standard deviation of the
 * *mean* at that level: the median temporal standard deviation of the pixels nearest to the level, over sqrt(T). Read
 * as the standard deviation of one frame it gives spreads of the offset up to ten times smaller than those of the
 * paper's tables.
 *
 * Remark 3 lets the quantile move where the set is too small. Here it moves inwards by 1 % up to four times, and
 * then the band widens by factors of 2, until the set holds MinimumPixels; wideningSteps counts both.
 */
struct SensorNoise_EXPORT IsoIntensitySet
{
  static constexpr std::size_t MinimumPixels = 30;

  double                     levelDn{ 0.0 };             ///< u^* or u_* [DN]
  double                     levelSdDn{ 0.0 };           ///< sigma_u: of the mean, at that level [DN]
  double                     bandSdDn{ 0.0 };            ///< sigma_u of the weights: levelSdDn unless widened [DN]
  double                     temporalVarianceDn2{ 0.0 }; ///< of one frame, at that level [DN^2]
  double                     quantile{ 0.0 };            ///< the quantile that was used, 0 to 1
  unsigned int               wideningSteps{ 0 };         ///< 0: as asked for
  std::vector<std::uint32_t> pixels;                     ///< ascending
  std::vector<double>        weights;                    ///< of each pixel; their sum is 1

  /** Number of equally weighted pixels that would average noise as well: 1 / sum w^2. */
  double
  EffectivePixels() const;
};

/** Finds the iso-intensity set at a quantile. */
class SensorNoise_EXPORT IsoIntensitySetFinder
{
public:
  /** Frame-sized maps of \a pixels pixels: mean [DN], temporal variance [DN^2], mask; they must outlive the finder.
   * \a frames is T. Throws NothingToMeasure if the mask keeps fewer than MinimumPixels. */
  IsoIntensitySetFinder(const double *       mean,
                        const double *       variance,
                        const std::uint8_t * mask,
                        std::size_t          pixels,
                        std::size_t          frames,
                        const ParallelFor &  parallelFor = SerialFor);

  /** The set at \a quantile (0 to 1); where it is too small the quantile moves towards 1/2 (Remark 3). Throws
   * NothingToMeasure if no width of the band gives enough pixels. */
  IsoIntensitySet
  Find(double quantile) const;

  /** The pixels within 6 sigma_u of \a bright's level, equally weighted: the set from which gamma_t(y) is estimated
   * row by row, (3.28).
   *
   * The paper takes S^* itself. But where the flicker differs from row to row, so does a row's mean over T frames,
   * by about sigma_u; and u^* is the level of the brightest rows, so that S^* misses whole rows. As v = u / ubar is
   * relative to each pixel's own mean, the pixels need not be of one intensity. */
  IsoIntensitySet
  FindRowSet(const IsoIntensitySet & bright) const;

private:
  void
  SetLevel(IsoIntensitySet & set) const;
  void
  Fill(IsoIntensitySet & set) const;

  const double *       m_Mean;
  const double *       m_Variance;
  const std::uint8_t * m_Mask;
  std::size_t          m_Pixels;
  std::size_t          m_Frames;
  IntensityIndex       m_Index;
};

} // namespace sensornoise

#endif
