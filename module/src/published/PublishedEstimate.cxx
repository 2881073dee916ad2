// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedPasses.h"

#include "base/Constants.h"
#include "base/PolynomialFit.h"
#include "base/Quantiles.h"
#include "published/PublishedScene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace sensornoise
{

namespace
{
/** Fills offset and read noise without their bounds. */
void
FillOffset(NoiseParameters & found)
{
  found.offset = found.readNoise = found.readNoiseElectrons = Quantity::Without(EstimateStatus::NotIdentifiable);
  if (!found.offsetDn)
  {
    return;
  }
  found.offset = Quantity::Identified(*found.offsetDn);
  found.squaredReadNoiseDn2 = found.line.intercept + found.line.slope * *found.offsetDn;
  if (found.squaredReadNoiseDn2 > 0.0)
  {
    found.readNoise = Quantity::Identified(std::sqrt(found.squaredReadNoiseDn2));
    found.readNoiseElectrons = Quantity::Identified(std::sqrt(found.squaredReadNoiseDn2) / found.line.slope);
  }
}

void
FillBounds(NoiseParameters & found)
{
  if (found.HasBounds())
  {
    const double highest = std::sqrt(found.line.intercept + found.line.slope * *found.darkestDn);
    found.offset.bracket = Interval{ found.LowestOffsetDn(), found.darkestDn };
    found.readNoise.bracket = Interval{ 0.0, highest };
    found.readNoiseElectrons.bracket = Interval{ 0.0, highest / found.line.slope };
  }
}
} // namespace

NoiseParameters
EstimateParameters(const PolynomialFit &             line,
                   std::optional<double>             offsetDn,
                   std::optional<double>             darkestDn,
                   const std::optional<FitQuality> & quality)
{
  NoiseParameters found;
  found.line = line;
  found.quality = quality;
  found.offsetDn = offsetDn;
  found.darkestDn = darkestDn;
  found.verdict = !line.isDetermined    ? LineVerdict::OneIntensity
                  : !(line.slope > 0.0) ? LineVerdict::NotRising
                                        : LineVerdict::Identified;
  if (found.verdict == LineVerdict::Identified)
  {
    FillOffset(found);
    FillBounds(found);
    found.gain = Quantity::Identified(line.slope);
    found.intercept = Quantity::Identified(line.intercept);
  }
  if (found.IsScattered())
  {
    found.gain = found.intercept = found.offset = found.readNoise = found.readNoiseElectrons =
      Quantity::Without(EstimateStatus::Failed);
  }
  return found;
}

namespace
{
/** Contrast of the bright and the dark set that a line needs, in units of the sum of the standard deviations of their
 * levels [1]. Chosen without a source: the paper has no limit. */
constexpr double LeastContrast = 6.0;
/** Significance of a curvature of the corrected variance [standard errors]. Chosen without a source, as LeastContrast.
 */
constexpr double LeastCurvatureZ = 5.0;
/** Fraction of the pixels that are darker than the darkest level, which bounds the offset [1]. Chosen without a source:
 * the paper has no limit. */
constexpr double DarkestFraction = 0.001;
/** Number of standard errors by which the darkest level, a mean of noisy values, may be below the offset [1]. Chosen
 * without a source. */
constexpr double DarkestErrors = 3.0;

void
FillVibration(PublishedEstimate & estimate, const PublishedFindings & found, const ParallelFor & parallelFor)
{
  const VibrationCovariance vibration = FitVibrationCovariance(found.scene.mean.data(),
                                                               found.scene.variance.data(),
                                                               found.scene.valid.data(),
                                                               found.geometry.width,
                                                               found.geometry.height,
                                                               found.flicker.flickerSd,
                                                               parallelFor);
  const auto                identifiedIf = [](bool isDetermined, double value) {
    return isDetermined ? Quantity::Identified(value) : Quantity::Without(EstimateStatus::NotIdentifiable);
  };
  const auto sd = [&](double square) {
    return identifiedIf(vibration.isDetermined && square > 0.0, std::sqrt(std::max(0.0, square)));
  };
  estimate.vibrationSdX = sd(vibration.varianceXPixels2);
  estimate.vibrationSdY = sd(vibration.varianceYPixels2);
  estimate.vibrationCovariance = identifiedIf(vibration.isDetermined, vibration.covariancePixels2);
}

Quantity
SdOf(const FlickerEstimate & flicker)
{
  if (flicker.flickerZ > Significance.everyPixel)
  {
    return Quantity::Identified(flicker.flickerSd);
  }
  return Quantity::Without(EstimateStatus::UpperLimit, Interval{ 0.0, flicker.flickerSd });
}

/** Returns the deviation of the variance from its line, half way between both levels, relative to the line, if it is
 * significant and large. */
std::optional<double>
FindCurvedFraction(const NoiseParameters & parameters, const PublishedScene & scene, double contrastDn)
{
  const FitQuality & quality = *parameters.quality;
  const double       curvatureDn2 = quality.curvature * contrastDn * contrastDn / 8.0; // parabola minus chord
  const double       middleDn2 =
    parameters.line.intercept + parameters.line.slope * 0.5 * (scene.bright.levelDn + scene.dark.levelDn);
  const bool isCurved =
    std::abs(quality.curvatureZ) > LeastCurvatureZ && std::abs(curvatureDn2) > LargestCurvedFraction * middleDn2;
  return isCurved ? std::optional(std::abs(curvatureDn2) / middleDn2) : std::nullopt;
}
} // namespace

PublishedEstimate
EstimatePublished(const PublishedFindings & found, const ParallelFor & parallelFor)
{
  const PublishedScene & scene = found.scene;
  PublishedEstimate      estimate;
  estimate.flickerSd = SdOf(found.flicker);
  FillVibration(estimate, found, parallelFor);
  estimate.contrastDn = scene.bright.levelDn - scene.dark.levelDn;
  estimate.neededDn = LeastContrast * (scene.bright.levelSdDn + scene.dark.levelSdDn);
  if (!(estimate.contrastDn > estimate.neededDn))
  {
    return estimate;
  }
  const std::size_t    pixels = found.geometry.Pixels();
  const RegressionData corrected{ scene.mean.data(), found.corrected.variance.data(), scene.kept.data(), pixels };
  const PolynomialFit  line = FitLine(corrected, parallelFor);
  const IntensityIndex index(scene.mean.data(), scene.valid.data(), pixels, parallelFor);
  const double darkestDn = index.QuantileDn(DarkestFraction, parallelFor) + DarkestErrors * scene.dark.levelSdDn;
  estimate.parameters = EstimateParameters(line,
                                           estimate.HasFlicker() ? std::optional(found.flicker.offsetDn) : std::nullopt,
                                           darkestDn,
                                           EvaluateLineFit(corrected, line, found.frames, parallelFor));
  estimate.curvedFraction = FindCurvedFraction(*estimate.parameters, scene, estimate.contrastDn);
  return estimate;
}

} // namespace sensornoise
