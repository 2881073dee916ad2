// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/StaticVariance.h"

#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/pixels/Constants.h"
#include "sensornoise/pixels/JudgingLine.h"
#include "sensornoise/pixels/LevelPattern.h"
#include "sensornoise/pixels/LightLine.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/StaticPixels.h"
#include "sensornoise/pixels/VarianceFit.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/pixels/VarianceQuality.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** A line without errors, good enough to judge pixels by. */
JudgingLine
FollowLine(const ProjectedVariance &           projected,
           const std::vector<std::uint8_t> &   mask,
           double                              blackDn,
           const ParallelFor &                 parallelFor,
           double                              sharedSquares,
           const std::optional<VarianceLine> & start)
{
  VarianceFit fit(projected.GetData(mask), parallelFor, start);
  fit.Iterate(3);
  JudgingLine judge = fit.GetLine().isDetermined ? MakeJudgingLine(fit.GetLine(), projected, mask, blackDn, parallelFor)
                                                 : JudgingLine{ fit.GetLine(), {}, {} };
  judge.sharedSquares = sharedSquares;
  return judge;
}

std::vector<std::uint8_t>
MaskOfFlatClasses(const ProjectedVariance &         projected,
                  const std::vector<std::uint8_t> & usable,
                  const ParallelFor &               parallelFor)
{
  std::vector<std::uint8_t> mask(usable.size());
  ForPixels(mask.size(), parallelFor, [&](std::size_t p) {
    mask[p] = usable[p] != 0 && projected.ClassOf(p) <= InPixels.flatShare * ProjectedVariance::Classes ? 1 : 0;
  });
  return mask;
}

/** Files classes, mask and use of the pixels as \a line tells; returns the number of pixels that do not fit. */
std::size_t
SelectPixels(const ProjectedVariance &         projected,
             const JudgingLine &               line,
             const std::vector<std::uint8_t> & usable,
             StaticVariance &                  found,
             const ParallelFor &               parallelFor)
{
  const std::vector<std::uint8_t> misfit = FindLocalMisfit(projected, line, usable, parallelFor);
  ForPixels(
    misfit.size(), parallelFor, [&](std::size_t p) { found.mask[p] = usable[p] != 0 && misfit[p] == 0 ? 1 : 0; });
  found.classes = JudgeClasses(projected, line, found.mask, parallelFor);
  ForPixels(misfit.size(), parallelFor, [&](std::size_t p) {
    if (usable[p] != 0)
    {
      const bool isRough = projected.ClassOf(p) >= found.classes.firstBad;
      found.pixelUse[p] = static_cast<std::uint8_t>(misfit[p] != 0 ? PixelUse::NotStatic
                                                    : isRough      ? PixelUse::Vibration
                                                                   : PixelUse::Used);
      found.mask[p] = isRough ? 0 : found.mask[p];
    }
  });
  return static_cast<std::size_t>(std::count(misfit.begin(), misfit.end(), std::uint8_t{ 1 }));
}

/** The mean has noise of its own, and it is correlated with the variance as the noise is skewed. Both together bias
 * the slope's equation by -g sigma^2 / T a unit of weight. Estimator.md, 3.6. */
void
CorrectForNoisyMeans(VarianceLine & line, double offsetDn, std::size_t frames)
{
  const double readVariance = std::max(0.0, line.intercept + line.gain * offsetDn);
  const double bias = -line.gain * readVariance / static_cast<double>(frames) * line.weightSum / line.spreadDn2;
  line.gain -= bias;
  line.intercept += bias * line.pivotDn;
}
} // namespace

StaticVariance
FitStaticVariance(ProjectedVariance &               projected,
                  const std::vector<std::uint8_t> & usable,
                  std::vector<std::uint8_t>         pixelUse,
                  double                            slopeDn,
                  double                            offsetDn,
                  double                            blackDn,
                  const ParallelFor &               parallelFor,
                  double                            sharedSquares)
{
  StaticVariance found;
  found.sharedSquares = sharedSquares;
  found.pixelUse = std::move(pixelUse);
  // The line of the flat classes tells which neighbourhoods fit, and among these, which classes do.
  projected.Compute(slopeDn);
  found.mask = MaskOfFlatClasses(projected, usable, parallelFor);
  const ReferenceFrame & frame = projected.GetFrame();
  JudgingLine            judge = FollowLine(projected, found.mask, blackDn, parallelFor, sharedSquares, std::nullopt);
  if (!judge.line.isDetermined)
  {
    return found;
  }
  projected.Compute(judge.line.gain);
  for (int round = 0; round < 2; ++round)
  {
    const std::size_t misfits = SelectPixels(projected, judge, usable, found, parallelFor);
    judge = FollowLine(projected, found.mask, blackDn, parallelFor, sharedSquares, judge.line);
    if (!judge.line.isDetermined)
    {
      return found;
    }
    if (static_cast<double>(misfits) < InPixels.fewMisfits * static_cast<double>(usable.size()))
    {
      break; // too few to have drawn the line
    }
  }
  projected.Compute(judge.line.gain);
  VarianceFit fit(projected.GetData(found.mask), parallelFor, judge.line, TrimRule::Distance, blackDn);
  fit.Iterate(8);
  fit.FillErrors();
  VarianceLine line = fit.GetLine();
  if (!line.isDetermined)
  {
    return found;
  }
  const std::vector<std::uint8_t> trimmed = fit.FindTrimmed();
  ForPixels(trimmed.size(), parallelFor, [&](std::size_t p) {
    found.pixelUse[p] = trimmed[p] != 0 ? static_cast<std::uint8_t>(PixelUse::Outlier) : found.pixelUse[p];
  });
  found.fromFlat = FitFlatHalf(projected, found.mask, line, parallelFor);
  const VarianceData data = projected.GetData(found.mask);
  found.pattern = MeasureLevelPattern(frame, data, line, blackDn, parallelFor);
  if (found.pattern.LargestShare() * std::abs(line.gain) >
      InPixels.negligiblePattern * std::sqrt(line.covariance(0, 0)))
  {
    found.fromLight = FitLightLine(fit, data, frame);
  }
  CorrectForNoisyMeans(line, offsetDn, frame.frames);
  found.line = line;
  found.curve = fit.CurveAbout(found.fromLight.isDetermined ? found.fromLight : line);
  found.notStatic = static_cast<std::size_t>(
    std::count(found.pixelUse.begin(), found.pixelUse.end(), static_cast<std::uint8_t>(PixelUse::NotStatic)));
  return found;
}

} // namespace sensornoise
