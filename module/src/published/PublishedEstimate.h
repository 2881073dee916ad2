// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedEstimate_h
#define sensornoise_published_PublishedEstimate_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "base/PolynomialFit.h"
#include "published/Flicker.h"
#include "published/PublishedScene.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Largest reduced chi-square of the corrected variance about its line that is accepted [1]. Chosen. */
inline constexpr double LargestReducedChi2 = 10.0;
/** Reduced chi-square from which the fit is said to be poor [1]. Chosen. */
inline constexpr double PoorReducedChi2 = 1.5;

/** Verdict on the line through the corrected variance: whether it describes a sensor, or the reason why not. */
enum class LineVerdict : std::uint8_t
{
  Identified,
  OneIntensity, ///< the pixels of the regression have one intensity
  NotRising     ///< the variance does not rise with the mean
};

/** Parameters of the sensor by the line through the corrected variance. */
struct NoiseParameters
{
  PolynomialFit             line;
  std::optional<FitQuality> quality;   ///< null: the number of frames, on which it depends, is not known
  std::optional<double>     offsetDn;  ///< mu [DN]; null: the flicker does not determine it
  std::optional<double>     darkestDn; ///< mean of the darkest pixels, with its error [DN]; null: not known
  LineVerdict               verdict{ LineVerdict::Identified };
  /** sigma^2 by gain, intercept and offset, also if it is not above 0 [DN^2]; 0 without an offset. */
  double   squaredReadNoiseDn2{ 0.0 };
  Quantity gain;               ///< [DN/e-]
  Quantity intercept;          ///< sigma^2 - g mu, with quantization noise [DN^2]
  Quantity offset;             ///< [DN]
  Quantity readNoise;          ///< [DN]
  Quantity readNoiseElectrons; ///< [e-]

  /** Returns whether the variance scatters so much about the line that no parameter is accepted. */
  bool
  IsScattered() const
  {
    return quality && quality->reducedChi2 > LargestReducedChi2;
  }
  /** Returns whether sigma^2 is not above 0, though the offset is known. */
  bool
  IsReadNoiseLost() const
  {
    return verdict == LineVerdict::Identified && offsetDn && !(squaredReadNoiseDn2 > 0.0);
  }
  /** Returns the level where sigma^2 is 0: the lowest offset [DN]. */
  double
  LowestOffsetDn() const
  {
    return -line.intercept / line.slope;
  }
  /** Returns whether the darkest pixels bound the offset from above. */
  bool
  HasBounds() const
  {
    return verdict == LineVerdict::Identified && darkestDn && *darkestDn > this->LowestOffsetDn();
  }
};

/** Returns gain, intercept, offset and read noise by the line through the corrected variance, as in section 3.3 of Sur
 * & Gredi\'ac 2015 (https://doi.org/10.1137/140977035): g is the slope, sigma^2 - g mu is the intercept, and
 * sigma^2 = intercept + g mu if mu is known.
 *
 * \a offsetDn is mu [DN], or null if the flicker does not determine it. In that case offset and read noise are
 * not-identifiable. They have bounds from sigma^2 >= 0 and flux >= 0: -intercept/g <= mu <= \a darkestDn [DN]. A gain
 * that is not positive, or a line about which the variance of \a quality scatters by more than LargestReducedChi2,
 * contradicts the model: all parameters are failed.
 *
 * Quantization noise is not subtracted: intercept and total intercept are equal, as in the paper. */
SensorNoise_EXPORT NoiseParameters
EstimateParameters(const PolynomialFit &             line,
                   std::optional<double>             offsetDn,
                   std::optional<double>             darkestDn,
                   const std::optional<FitQuality> & quality = std::nullopt);

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

/** Largest deviation of the corrected variance from its line, half way between dark and bright, that is not said,
 * relative to the line [1]. Chosen. */
inline constexpr double LargestCurvedFraction = 0.03;

/** Estimates of the published method from the results of its passes, without messages. */
struct PublishedEstimate
{
  Quantity flickerSd;           ///< [1]
  Quantity vibrationSdX;        ///< [pixel]
  Quantity vibrationSdY;        ///< [pixel]
  Quantity vibrationCovariance; ///< [pixel^2]
  double   contrastDn{ 0.0 };   ///< level of the bright set minus level of the dark set [DN]
  double   neededDn{ 0.0 };     ///< contrast that is needed for a line [DN]
  /** Parameters of the sensor; null: the contrast is too small. */
  std::optional<NoiseParameters> parameters;
  /** Significant deviation of the corrected variance from its line, half way between dark and bright, relative to the
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
EstimatePublished(const PublishedFindings & found, const ParallelFor & parallelFor);

/** Returns the report of the published method. It has values and statuses, but no standard errors or intervals: the
 * paper gives none for a stack, and the errors of an ordinary regression would hide its bias. */
SensorNoise_EXPORT Report
MakePublishedReport(const PublishedFindings & found, const ParallelFor & parallelFor);

/** Copies the parameters and the quality of the fit to \a report, and warns of what contradicts them. */
SensorNoise_EXPORT void
FileParameters(Report & report, const NoiseParameters & parameters);

} // namespace sensornoise

#endif
