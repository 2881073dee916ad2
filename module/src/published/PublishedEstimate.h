// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedEstimate_h
#define sensornoise_published_PublishedEstimate_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "published/FlickerEstimate.h"
#include "published/NoiseParameters.h"
#include "published/PublishedScene.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Result of pass 3 of the published method. */
struct CorrectedMaps
{
  std::vector<double>       variance; ///< variance of the corrected stack [DN^2]; empty: the stack cannot be measured
  std::vector<std::uint8_t> pixelUse; ///< values of PixelUse
};

/** Results of all passes of the published method, from which its estimate is made. */
struct PublishedFindings
{
  const PublishedSettings & settings;
  const FrameGeometry &     geometry;
  std::size_t               frames;
  const PublishedScene &    scene;
  const FlickerEstimate &   flicker;
  const CorrectedMaps &     corrected;
};

/** Largest departure of the corrected variance from its line, half way between dark and bright, that is not said,
 * relative to the line [1]. Chosen. */
inline constexpr double LargestCurvedFraction = 0.03;

/** What the published method estimates from the results of its passes, without a message. */
struct PublishedEstimate
{
  Quantity flickerSd;           ///< [1]
  Quantity vibrationSdX;        ///< [pixel]
  Quantity vibrationSdY;        ///< [pixel]
  Quantity vibrationCovariance; ///< [pixel^2]
  double   contrastDn{ 0.0 };   ///< level of the bright set minus that of the dark one [DN]
  double   neededDn{ 0.0 };     ///< contrast that is needed for a line [DN]
  /** Parameters of the sensor; null: the contrast is too small. */
  std::optional<NoiseParameters> parameters;
  /** Significant departure of the corrected variance from its line, half way between dark and bright, relative to the
   * line, if it is above LargestCurvedFraction [1]; null: it is not. */
  std::optional<double> curvedFraction;

  /** Returns whether the flicker determines the offset. */
  bool
  HasFlicker() const
  {
    return flickerSd.status == EstimateStatus::Identified;
  }
};

/** Decides on every quantity by the results of the passes; the scene must be measurable. */
SensorNoise_EXPORT PublishedEstimate
EstimateAll(const PublishedFindings & found, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
