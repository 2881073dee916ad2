// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedScene_h
#define sensornoise_published_PublishedScene_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Settings.h"
#include "base/NothingToMeasure.h"
#include "base/Quantiles.h"
#include "moments/StackMaps.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Centred differences of a map at an inner pixel [DN/pixel], (3.1) of Sur & Gredi\'ac 2015. */
struct Gradient
{
  double x;
  double y;
};

inline Gradient
CentredGradient(const double * map, std::size_t width, std::size_t p)
{
  return { 0.5 * (map[p + 1] - map[p - 1]), 0.5 * (map[p + width] - map[p - width]) };
}

/** Returns the quantile that a chi-square variable of 2 degrees of freedom exceeds with probability \a level:
 * -2 ln(level). 1 % gives 9.21, the value of the paper. Throws std::invalid_argument unless 0 < level < 1. */
SensorNoise_EXPORT double
ChiSquare2Quantile(double level);

/** Applies the test of section 3.1 to \a count neighbouring inner pixels of a row: sets \a kept to 1 where
 * 2 T |grad ubar|^2 < quantile var(u), else to 0. \a stride is the distance to the next row of \a mean [pixel].
 * \a valid may be null. */
SensorNoise_EXPORT void
TestVibrationOfRow(const double *       mean,
                   std::ptrdiff_t       stride,
                   const double *       variance,
                   const std::uint8_t * valid,
                   std::size_t          count,
                   std::size_t          frames,
                   double               quantile,
                   std::uint8_t *       kept);

/** Returns a map that is 1 at pixels whose gradient is explained by noise alone, so that vibrations do not change their
 * variance.
 *
 * Section 3.1 of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035): where E(u) is locally constant,
 * 2 T |grad ubar|^2 / var(u) has a chi-square distribution of 2 degrees of freedom. A pixel is kept (1) if this number
 * is below the quantile of \a level. Not kept (0) are pixels on the border, which have no centred difference, pixels
 * that are not \a valid (null: all are), pixels that never vary, and pixels beside one that is not finite.
 *
 * The variance is the temporal variance of the uncorrected stack, flicker included, as in the paper. */
SensorNoise_EXPORT std::vector<std::uint8_t>
VibrationMask(const double *       mean,
              const double *       variance,
              const std::uint8_t * valid,
              std::size_t          width,
              std::size_t          height,
              std::size_t          frames,
              double               level,
              const ParallelFor &  parallelFor = SerialFor);

/** Fits the multiple ordinary regression (2.20) of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035):
 *
 *     Var(u) = c0 + c1 ubar + sigma_gamma^2 ubar^2 + (1 + sigma_gamma^2) grad ubar' Cov(alpha, beta) grad ubar
 *
 * over all inner pixels that are \a valid (null: all) and finite, including those moved by vibrations. \a mean [DN] and
 * \a variance [DN^2] are maps of the uncorrected stack, flicker included. \a flickerSd is sigma_gamma if it is known
 * from the flicker itself [1]. Below 0 it is the square root of this regression's own coefficient (0 if the coefficient
 * is negative). */
SensorNoise_EXPORT VibrationCovariance
FitVibrationCovariance(const double *       mean,
                       const double *       variance,
                       const std::uint8_t * valid,
                       std::size_t          width,
                       std::size_t          height,
                       double               flickerSd,
                       const ParallelFor &  parallelFor = SerialFor);

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
