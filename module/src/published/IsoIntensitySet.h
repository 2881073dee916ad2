// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_IsoIntensitySet_h
#define sensornoise_published_IsoIntensitySet_h

#include "sensornoise/StepResults.h"
#include "SensorNoiseExport.h"
#include "base/Quantiles.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Finds iso-intensity sets. */
class SensorNoise_EXPORT IsoIntensitySetFinder
{
public:
  /** \a mean [DN], \a variance over time [DN^2] and \a mask are maps of \a pixels pixels, which must outlive the
   * object. \a frames is T. Throws NothingToMeasure if the mask keeps fewer than MinimumPixels. */
  IsoIntensitySetFinder(const double *       mean,
                        const double *       variance,
                        const std::uint8_t * mask,
                        std::size_t          pixels,
                        std::size_t          frames,
                        const ParallelFor &  parallelFor = SerialFor);

  /** Returns the set at \a quantile (0 to 1). If it is too small, the quantile moves towards 1/2 (Remark 3), then the
   * band widens. Throws NothingToMeasure if the widest band has too few pixels. */
  IsoIntensitySet
  Find(double quantile) const;

  /** Returns the pixels within 6 sigma_u of the level of \a bright, with equal weights. From this set gamma_t(y) is
   * estimated row by row, (3.28).
   *
   * The paper uses S^* itself. But if the flicker differs from row to row, the mean of a row over T frames differs by
   * about sigma_u. As u^* is the level of the brightest rows, S^* then misses whole rows. The pixels need not have one
   * intensity, because v = u / ubar is relative to the mean of each pixel. */
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
