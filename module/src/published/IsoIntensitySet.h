// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_IsoIntensitySet_h
#define sensornoise_published_IsoIntensitySet_h

#include "sensornoise/StepResults.h"
#include "SensorNoiseExport.h"
#include "base/IntensityIndex.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

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
