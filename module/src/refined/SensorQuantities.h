// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_SensorQuantities_h
#define sensornoise_refined_SensorQuantities_h

#include "SensorNoiseExport.h"
#include "pixels/PartTiles.h"
#include "refined/GainEstimate.h"
#include "refined/GainVerdict.h"
#include "refined/OffsetEstimate.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Gains of parts of the frame or of the burst that differ. */
struct UnlikeParts
{
  Partition         partition; ///< how the pixels or frames are divided
  double            rms;       ///< rms of the parts' gains about their mean, beyond chance, relative to it [1]
  GainByPartsRecord record;    ///< gain of every part

  /** Returns the parts of the lowest and of the highest gain. */
  SensorNoise_EXPORT std::pair<const GainByPartsRecord::Part &, const GainByPartsRecord::Part &>
  Extremes() const;
};

/** A line of the variance, the verdict on it, and its quantities. */
struct TestedGain
{
  GainEstimate             line;
  GainVerdict              verdict{ GainVerdict::NoiseNotLinear };
  Quantity                 gain;           ///< [DN/e-]
  Quantity                 varianceSlope;  ///< with the slope of the quantization noise [DN/e-]
  Quantity                 intercept;      ///< sigma^2 - g mu, without quantization noise [DN^2]
  Quantity                 totalIntercept; ///< with quantization noise [DN^2]
  std::vector<UnlikeParts> parts;          ///< empty: the gain is uniform, or is not identified

  bool
  IsIdentified() const
  {
    return verdict == GainVerdict::Identified;
  }
};

/** Returns the quantities of \a line as far as \a verdict lets them be identified. The intervals contain the gains of
 * all parts of the levels, the frame and the burst. \a quantisationDn2 is the variance of the quantization noise
 * [DN^2]. */
SensorNoise_EXPORT TestedGain
QuantitiesBy(GainVerdict verdict, const GainEstimate & line, const RefinedResults & found, double quantisationDn2);

/** Dark offset and read noise. */
struct DarkQuantities
{
  Quantity offset;                                                                ///< [DN]
  Quantity readNoise;                                                             ///< [DN]
  Quantity readNoiseMedian{ Quantity::Without(EstimateStatus::NotIdentifiable) }; ///< [DN]
  Quantity readNoiseElectrons;                                                    ///< [e-]
  /** Covariance matrix of the errors of gain, intercept and offset; null: not known, see Report::covariance. */
  std::optional<std::array<std::array<double, 3>, 3>> covariance;
};

/** Returns what the dark frames or the user say of offset and read noise. Quantities that they do not determine have
 * \a status. \a quantisationDn2 is the variance of the quantization noise [DN^2]. */
SensorNoise_EXPORT DarkQuantities
QuantitiesOfDarkFrames(const RefinedSettings & settings, double quantisationDn2, EstimateStatus status);

/** Returns offset and read noise beside an identified gain. The offset is the known one, if there is one, else
 * \a flicker. \a quantisationDn2 is the variance of the quantization noise [DN^2]. */
SensorNoise_EXPORT DarkQuantities
QuantitiesByOffset(const RefinedResults & found,
                   const GainEstimate &   gain,
                   const OffsetLimits &   limits,
                   const OffsetEstimate & flicker,
                   double                 quantisationDn2);

} // namespace sensornoise

#endif
