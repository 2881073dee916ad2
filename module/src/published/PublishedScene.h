// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedScene_h
#define sensornoise_published_PublishedScene_h

#include "sensornoise/StepResults.h"
#include "SensorNoiseExport.h"
#include "base/Quantiles.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/FrameGeometry.h"
#include "base/NothingToMeasure.h"
#include "moments/StackMaps.h"
#include "sensornoise/Settings.h"

#include <cstddef>
#include <cstdint>
#include <optional>
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

/** Result of pass 1 of the published method: maps of a frame, and the sets from which pass 2 estimates the flicker. */
struct PublishedScene
{
  StackSummary                    summary;
  std::vector<double>             mean;          ///< [DN]
  std::vector<double>             variance;      ///< variance of the uncorrected stack, flicker included [DN^2]
  std::vector<std::uint8_t>       valid;         ///< 1: finite, never clipped and not masked by the user
  std::vector<std::uint8_t>       kept;          ///< 1: kept by the vibration mask
  std::vector<std::uint8_t>       pixelUse;      ///< values of PixelUse, as far as pass 1 determines them
  IsoIntensitySet                 bright;        ///< S^*
  IsoIntensitySet                 dark;          ///< S_*
  IsoIntensitySet                 rowSet;        ///< set for gamma_t(y); empty with RollingShutter::Off
  std::optional<NothingToMeasure> failureReason; ///< reason why the stack cannot be measured; null: it can
};

/** Sets valid, kept and pixelUse of a scene that has mean, variance and valid of the moments. Pixels that are 0 in
 * \a mask become invalid. An empty \a mask excludes no pixels. */
SensorNoise_EXPORT void
SortPixels(PublishedScene &                  scene,
           const PublishedSettings &         settings,
           const FrameGeometry &             geometry,
           std::size_t                       frames,
           const std::vector<std::uint8_t> & mask,
           const ParallelFor &               parallelFor);

/** Sets the iso-intensity sets of a scene after SortPixels(), or the reason of its failure. */
SensorNoise_EXPORT void
FindSets(PublishedScene &          scene,
         const PublishedSettings & settings,
         std::size_t               frames,
         const ParallelFor &       parallelFor);

} // namespace sensornoise

#endif
