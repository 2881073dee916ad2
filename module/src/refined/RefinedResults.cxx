// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedResults.h"

#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Jackknife.h"
#include "moments/DarkFrames.h"
#include "pixels/IlluminationResponses.h"
#include "refined/Constants.h"
#include "scene/ReferenceFrame.h"
#include "sensornoise/Report.h"
#include "series/FrameEquations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the effect of the noise on the equations of the frames, by the fitted \a line and the offset \a offsetDn
 * [DN]. */
RegressorNoise
NoiseOfLine(const FrameRegressors & regressors,
            const VarianceLine &    line,
            double                  offsetDn,
            const ParallelFor &     parallelFor)
{
  // Sums of the variance and of the shot noise for each class.
  const auto             varianceOf = [](std::size_t gradientClass) { return 2 * gradientClass; };
  const auto             shotOf = [](std::size_t gradientClass) { return 2 * gradientClass + 1; };
  const ReferenceFrame & frame = regressors.GetFrame();
  const auto sums = SumOverBlocks<2 * GradientClasses>(frame.mean.size(), parallelFor, [&](std::size_t p, auto & s) {
    const std::size_t c = regressors.ClassOf(p);
    if (c != FrameRegressors::Unused)
    {
      const double level = frame.neighbourMean[p];
      const double variance = line.At(level);
      const double w = 1.0 / regressors.GetModel().NoiseVariance(level);
      s[varianceOf(c)] += w * variance;
      s[shotOf(c)] += w * line.gain * std::max(0.0, level - offsetDn);
    }
  });
  RegressorNoise noise;
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    noise.variance[c] = sums[varianceOf(c)];
    noise.shot[c] = sums[shotOf(c)];
  }
  return noise;
}
} // namespace

ReestimatedComponents
ReestimateComponents(const FrameSums &        sums,
                     const SceneSeries &      series,
                     const PixelCoordinates & coordinates,
                     const StaticVariance &   variance,
                     const PixelMap &         correctedVariance,
                     const ParallelFor &      parallelFor)
{
  const InitialNoiseModel &   model = sums.GetRegressors().GetModel();
  const std::vector<double> & gamma = series.line.gamma;
  RegressorNoise noise = NoiseOfLine(sums.GetRegressors(), variance.line, series.offset + model.centreDn, parallelFor);
  noise.ofProducts = CovarianceOfProducts(sums.GetRegressors(), correctedVariance, parallelFor);
  ReestimatedComponents reestimated;
  reestimated.line = FitOffsetLine(sums, noise, gamma, series.squaresOfShifts).value_or(series.line);
  if (!reestimated.line.DeterminesOffset())
  {
    reestimated.line.UseOffset(series.offset);
  }
  const FrameEquations            equations = MakeFrameEquations(sums, noise, GradientClasses - 1, gamma);
  const std::optional<OffsetLine> everywhere = FitOffsetLine(equations);
  reestimated.motionPhi = everywhere ? everywhere->Widening() : 1.0;
  reestimated.motion = SolveMotion(equations, reestimated.line.gamma, reestimated.line.offset);
  reestimated.scaleErrors =
    ScaleErrorsOf(sums, noise, reestimated.motion, reestimated.line.gamma, reestimated.line.offset);
  reestimated.shifts = SolveShifts(sums,
                                   equations,
                                   reestimated.motion,
                                   sums.NoiseOfInstruments(variance.line.gain, variance.line.intercept),
                                   reestimated.line.gamma,
                                   reestimated.line.offset);
  if (series.local.IsLocal())
  {
    const IlluminationResponses illumination{
      sums.GetFrame(), coordinates,     series.basis.NumberOfIlluminationFactors(), variance.line, variance.mask,
      model.centreDn,  model.darkestDn, model.brightestDn - model.darkestDn
    };
    reestimated.isOffsetDrift = IsOffsetDrift(illumination);
    if (!reestimated.isOffsetDrift)
    {
      const MotionLeakage leakage = EstimateMotionLeakage(illumination, parallelFor);
      reestimated.isMotionLocal = leakage.isMotionLocal;
      reestimated.localOffset = FindLocalOffset(illumination, leakage.kappa, parallelFor);
    }
    reestimated.localFlicker = SumLocalFlicker(illumination);
  }
  else
  {
    reestimated.partOffsets = FindPartOffsets(sums, reestimated.line, reestimated.motion, variance, parallelFor);
  }
  return reestimated;
}

namespace
{
/** Sums for the illumination changes of a tile, and for the variance that they add to its pixels. */
struct TileIllumination
{
  double frames{ 0.0 };
  double pixels{ 0.0 };
  double square{ 0.0 }; ///< sum over the frames of the squared signal of the tile, in units of its noise

  TileIllumination &
  operator+=(const TileIllumination & other)
  {
    frames += other.frames;
    pixels += other.pixels;
    square += other.square;
    return *this;
  }
};

/** Returns the sums of tile \a i. Its signal in a frame, sum w z r, has the variance sum w z^2 by the noise of the
 * pixels. A relative change e of the illumination increases this variance by the fraction e^2 sum w z^2, and the
 * variance of the pixels by the mean of e^2 w z^2 over them. */
TileIllumination
SumTileIllumination(const NoiseResiduals & residuals, std::size_t i)
{
  const float * const w = residuals.WeightOf(i);
  const float * const z = residuals.SignalOf(i);
  const std::size_t   size = residuals.GetTiles().Pixels();
  TileIllumination    illumination;
  double              noise = 0.0;
  for (std::size_t p = 0; p < size; ++p)
  {
    illumination.pixels += w[p] > 0.0F ? 1.0 : 0.0;
    noise += static_cast<double>(w[p]) * static_cast<double>(z[p]) * static_cast<double>(z[p]);
  }
  if (!(noise > 0.0))
  {
    return {};
  }
  for (std::size_t t = 0; t < residuals.GetTiles().frames; ++t)
  {
    const float * const values = residuals.OfTile(i) + t * size;
    double              sum = 0.0;
    for (std::size_t p = 0; p < size; ++p)
    {
      sum += static_cast<double>(w[p]) * static_cast<double>(z[p]) * static_cast<double>(values[p]);
    }
    illumination.square += sum * sum / noise;
  }
  illumination.frames = residuals.GetDof();
  return illumination;
}
} // namespace

double
EffectOfLineIllumination(const MeasuredNumber & square, double signalDn, double gain, double least)
{
  const double effect = square.value * std::max(0.0, signalDn) / gain;
  return square.value > Significance.severalTests * square.standardError && effect > least ? effect : 0.0;
}

double
RestOfIllumination(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  std::vector<TileIllumination> tiles(residuals.GetTiles().origins.size());
  parallelFor(tiles.size(), [&](std::size_t i) { tiles[i] = SumTileIllumination(residuals, i); });
  const JackknifeEstimate estimate = Jackknife(tiles, [](const TileIllumination & sum) {
    return Eigen::VectorXd::Constant(1, sum.pixels > 0.0 ? (sum.square - sum.frames) / sum.pixels : 0.0);
  });
  // Both sums are over the tiles: the excess of each tile is a sum over its frames.
  const double perFrame = 1.0 / std::max(1.0, residuals.GetDof());
  const double rest = estimate.value(0) * perFrame;
  const double error = estimate.StandardError(0) * perFrame;
  return rest > Significance.severalTests * error &&
             rest > InRefined.largestLineIllumination / InRefined.slopeOfRemaining
           ? rest
           : 0.0;
}

ReplacedSquares
SubtractLineIllumination(LineIllumination &          lines,
                         NoiseResiduals &            residuals,
                         std::size_t                 width,
                         std::vector<std::uint8_t> & chosen,
                         std::vector<std::uint8_t> & pixelUse,
                         const ParallelFor &         parallelFor)
{
  const std::vector<float>  left = residuals.SubtractLines(lines.axis, chosen, parallelFor);
  const SampleTiles &       tiles = residuals.GetTiles();
  std::vector<std::uint8_t> sampled(chosen.size(), 0);
  ReplacedSquares           replaced;
  replaced.dof = residuals.GetDof();
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    for (std::size_t p = 0; p < tiles.Pixels(); ++p)
    {
      const std::size_t pixel = tiles.PixelOf(i, p, width);
      if (chosen[pixel] != 0 && left[i * tiles.Pixels() + p] > 0.0F)
      {
        sampled[pixel] = 1;
        replaced.pixels.push_back(pixel);
        replaced.squares.push_back(residuals.SquaresOf(i)[p]);
      }
    }
  }
  for (std::size_t p = 0; p < chosen.size(); ++p)
  {
    if (chosen[p] != 0 && sampled[p] == 0)
    {
      pixelUse[p] = static_cast<std::uint8_t>(PixelUse::FlickerUnknown);
    }
  }
  chosen = std::move(sampled);
  lines.isSubtracted = true;
  lines.pixels = static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), std::uint8_t{ 1 }));
  return replaced;
}

} // namespace sensornoise
