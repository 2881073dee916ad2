// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"

#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "pixels/Constants.h"
#include "pixels/RoughnessClasses.h"
#include "pixels/GainByParts.h"
#include "pixels/UnequalIllumination.h"
#include "pixels/RejectionModel.h"
#include "pixels/FixedPatternEstimate.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/VarianceFit.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

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
/** Fits a line without errors to a sample of the pixels: precise enough to test pixels. */
VarianceLine
FitSampleLine(const VarianceData & data, const std::optional<VarianceLine> & start, const ParallelFor & parallelFor)
{
  const SampledVariance sample(data, InPixels.pixelsOfRoughLine, parallelFor);
  VarianceFit           fit(sample.GetData(), parallelFor, start);
  fit.Iterate(3);
  return fit.GetLine();
}

/** Returns how the line of the pixels of \a mask depends on the gain that was put in; no dependence if the frames are
 * about equal. */
GainFeedback
ComputeFeedback(const ProjectedVariance &         projected,
                const VarianceLine &              line,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor)
{
  return projected.HasUnequalNoise() && line.isDetermined ? GainFeedback(projected, line, mask, parallelFor)
                                                          : GainFeedback();
}

/** Fits a line to the pixels of \a mask, again until the gain that corrects the variances equals the gain of the
 * line. */
VarianceLine
FitFixedPointLine(ProjectedVariance &                 projected,
                  const std::vector<std::uint8_t> &   mask,
                  const std::optional<VarianceLine> & start,
                  const ParallelFor &                 parallelFor)
{
  VarianceLine line = FitSampleLine(projected.GetData(mask), start, parallelFor);
  for (int round = 0; round < InPixels.fixedPointRounds; ++round)
  {
    const GainFeedback feedback = ComputeFeedback(projected, line, mask, parallelFor);
    const VarianceLine settled = feedback.SolveFixedPoint(line, projected.GetGain());
    if (!feedback.IsLarge() ||
        std::abs(settled.gain - projected.GetGain()) < InPixels.fixedPointChange * std::abs(settled.gain))
    {
      break;
    }
    projected.Compute(settled);
    line = FitSampleLine(projected.GetData(mask), settled, parallelFor);
  }
  return line;
}

/** Fits the first line to the flat pixels of \a mask. If only dark areas of the scene are flat, brighter pixels are
 * added to the mask, provided that their variance lies on one line with the variance of the dark pixels. */
VarianceLine
FitFirstLine(ProjectedVariance &               projected,
             const std::vector<std::uint8_t> & usable,
             std::vector<std::uint8_t> &       mask,
             const ParallelFor &               parallelFor)
{
  if (const std::optional<BrighterPixels> brighter = FindBrighterPixels(projected, usable, mask, parallelFor))
  {
    VarianceLine line = FitFixedPointLine(projected, brighter->mask, brighter->through, parallelFor);
    if (line.isDetermined && AgreesWithLine(projected, brighter->beyond, line) && AgreesWithLine(projected, mask, line))
    {
      mask = brighter->mask;
      return line;
    }
  }
  return FitFixedPointLine(projected, mask, std::nullopt, parallelFor);
}

/** Fits the line of all pixels of the data, with its errors. */
VarianceFit
FitAllPixels(const VarianceData & data, const VarianceLine & start, double blackDn, const ParallelFor & parallelFor)
{
  const SampledVariance sample(data, InPixels.pixelsOfRoughLine, parallelFor);
  VarianceFit           rough(sample.GetData(), parallelFor, start, TrimRule::Distance, blackDn);
  rough.Iterate(8);
  VarianceFit fit(data, rough);
  fit.Iterate(InPixels.stepsFromRoughLine);
  fit.FillErrors();
  return fit;
}

/** Sets classes, mask and use of the pixels by the rejection model \a line. Returns the number of pixels in rejected
 * neighbourhoods. */
std::size_t
SelectPixels(const ProjectedVariance &         projected,
             const RejectionModel &            line,
             const std::vector<std::uint8_t> & usable,
             StaticVariance &                  found,
             const ParallelFor &               parallelFor)
{
  const std::vector<std::uint8_t> misfit = RejectNeighbourhoods(projected, line, usable, parallelFor);
  ForPixels(
    misfit.size(), parallelFor, [&](std::size_t p) { found.mask[p] = usable[p] != 0 && misfit[p] == 0 ? 1 : 0; });
  found.classes = TestClasses(projected, line, found.mask, parallelFor);
  ForPixels(misfit.size(),
            parallelFor,
            [usable = usable.data(),
             misfit = misfit.data(),
             classOf = projected.GetClasses().data(),
             firstBad = found.classes.firstBad,
             use = found.pixelUse.data(),
             mask = found.mask.data()](std::size_t p) {
              const bool isRough = classOf[p] >= firstBad;
              const auto own = static_cast<std::uint8_t>(misfit[p] != 0 ? PixelUse::NotStatic
                                                         : isRough      ? PixelUse::Vibration
                                                                        : PixelUse::Used);
              use[p] = usable[p] != 0 ? own : use[p];
              mask[p] = isRough ? 0 : mask[p];
            });
  return static_cast<std::size_t>(std::count(misfit.begin(), misfit.end(), std::uint8_t{ 1 }));
}

/** Compares the parts by the measured variance of the pixels of \a mask. */
GainByParts
CompareMeasuredParts(const ProjectedVariance &         projected,
                     const PartReference &             reference,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor)
{
  VarianceData        data = projected.GetData(mask);
  std::vector<double> measured;
  if (projected.HasRatios())
  {
    measured = projected.MeasuredVariance();
    data.variance = measured.data();
  }
  return CompareParts(MakePartTiles(data, projected.GetFrame().geometry, reference, parallelFor));
}

/** Divides the variance by the ratios of parts whose gains differ much, so that their pixels are not rejected, and fits
 * \a drawn again. Changes nothing unless most pixels then follow the line: other causes of differences between parts,
 * such as a non-linear response, are left to the fit. */
void
CorrectForParts(ProjectedVariance &               projected,
                const PartReference &             reference,
                const std::vector<std::uint8_t> & mask,
                VarianceLine &                    drawn,
                const ParallelFor &               parallelFor)
{
  GainByParts parts = CompareMeasuredParts(projected, reference, mask, parallelFor);
  for (auto * const own : { &parts.places, &parts.phases })
  {
    if (*own && !(*own)->DifferMuch())
    {
      own->reset();
    }
  }
  if (parts.Larger() == nullptr)
  {
    return;
  }
  const ReferenceFrame & frame = projected.GetFrame();
  projected.SetRatios(MapOfRatios(parts, frame.mean, frame.geometry, reference, parallelFor));
  const VarianceLine line = FitFixedPointLine(projected, mask, drawn, parallelFor);
  if (!line.isDetermined || !AgreesWithLine(projected, mask, line))
  {
    projected.SetRatios({});
    return;
  }
  drawn = line;
}

/** Corrects the slope for the noise of the means, and for the correlation of this noise with the variance, which skewed
 * noise has. Together they bias the slope's equation by -g sigma^2 / T per unit of weight. Estimator.md, 3.6. */
void
CorrectForNoisyMeans(VarianceLine & line, double offsetDn, std::size_t frames)
{
  const double readVariance = std::max(0.0, line.intercept + line.gain * offsetDn);
  const double bias = -line.gain * readVariance / static_cast<double>(frames) * line.weightSum / line.spreadDn2;
  line.gain -= bias;
  line.intercept += bias * line.pivotDn;
}
/** Levels and variance inflation that FitStaticVariance() is called with, see there. */
struct FitPremises
{
  double slopeDn;
  double offsetDn;
  double blackDn;
  double varianceInflation;
};

/** Computes FitStaticVariance() once. With \a mayDivide the variance may be divided by the ratios of parts. */
StaticVariance
FitOnce(ProjectedVariance &               projected,
        const std::vector<std::uint8_t> & usable,
        std::vector<std::uint8_t>         pixelUse,
        const FitPremises &               premises,
        bool                              mayDivide,
        const ParallelFor &               parallelFor)
{
  const auto [slopeDn, offsetDn, blackDn, varianceInflation] = premises;
  StaticVariance found;
  found.varianceInflation = varianceInflation;
  found.pixelUse = std::move(pixelUse);
  // The line of the flat classes rejects neighbourhoods, and then classes among the others.
  projected.SetRatios({});
  projected.Compute(slopeDn);
  found.mask = MaskOfFlatClasses(projected, usable, parallelFor);
  VarianceLine drawn = FitFirstLine(projected, usable, found.mask, parallelFor);
  if (mayDivide && drawn.isDetermined)
  {
    CorrectForParts(projected, { drawn, blackDn, varianceInflation }, found.mask, drawn, parallelFor);
  }
  bool isJudged = false;
  for (int round = 0; round < 2 && drawn.isDetermined && !isJudged; ++round)
  {
    RejectionModel judge = FitRejectionModel(drawn, projected, found.mask, blackDn, parallelFor);
    judge.varianceInflation = varianceInflation;
    projected.Compute(drawn);
    const std::size_t misfits = SelectPixels(projected, judge, usable, found, parallelFor);
    isJudged = static_cast<double>(misfits) < InPixels.fewRejected * static_cast<double>(usable.size());
    drawn = FitFixedPointLine(projected, found.mask, judge.line, parallelFor);
  }
  if (!drawn.isDetermined)
  {
    return found;
  }
  projected.Compute(drawn);
  const VarianceData data = projected.GetData(found.mask);
  VarianceFit        fit = FitAllPixels(data, drawn, blackDn, parallelFor);
  const GainFeedback feedback = ComputeFeedback(projected, fit.GetLine(), found.mask, parallelFor);
  if (feedback.IsLarge())
  {
    const VarianceLine settled = feedback.SolveFixedPoint(fit.GetLine(), projected.GetGain());
    projected.Compute(settled);
    fit = FitAllPixels(data, settled, blackDn, parallelFor);
  }
  const auto settle = [&](const VarianceLine & fitted) {
    return feedback.SolveFixedPoint(fitted, projected.GetGain());
  };
  VarianceLine line = settle(fit.GetLine());
  if (!line.isDetermined)
  {
    return found;
  }
  const std::vector<std::uint8_t> trimmed = fit.FindTrimmed();
  ForPixels(trimmed.size(), parallelFor, [&](std::size_t p) {
    found.pixelUse[p] = trimmed[p] != 0 ? static_cast<std::uint8_t>(PixelUse::Outlier) : found.pixelUse[p];
  });
  const ReferenceFrame & frame = projected.GetFrame();
  found.pattern = EstimateFixedPattern(frame, data, line, blackDn, parallelFor);
  if (found.pattern.LargestFraction() * std::abs(line.gain) >
      InPixels.negligiblePattern * std::sqrt(line.covariance(0, 0)))
  {
    found.instrumentalLine = settle(FitInstrumental(fit, data, frame));
  }
  CorrectForNoisyMeans(line, offsetDn, frame.frames);
  found.line = line;
  std::vector<std::uint8_t> kept = found.mask;
  ForPixels(kept.size(), parallelFor, [&](std::size_t p) { kept[p] = trimmed[p] != 0 ? 0 : kept[p]; });
  found.parts = CompareMeasuredParts(projected, { line, blackDn, varianceInflation }, kept, parallelFor);
  found.curve = fit.CurveAbout(found.instrumentalLine.isDetermined ? found.instrumentalLine : line);
  if (found.curve.ReducedChi2() > InSteps.leastChi2 * varianceInflation)
  {
    found.ofOwnLevels = fit.CurveAbout(found.curve.line, VarianceFit::SortedBy::OwnLevel);
  }
  found.notStatic = static_cast<std::size_t>(
    std::count(found.pixelUse.begin(), found.pixelUse.end(), static_cast<std::uint8_t>(PixelUse::NotStatic)));
  return found;
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
                  double                            varianceInflation)
{
  const FitPremises premises{ slopeDn, offsetDn, blackDn, varianceInflation };
  StaticVariance    found = FitOnce(projected, usable, pixelUse, premises, true, parallelFor);
  if (projected.HasRatios() && found.parts.Larger() == nullptr)
  {
    // The pixels that fit do not confirm the differences between parts: a non-linear response, on a chart, looks like
    // them.
    found = FitOnce(projected, usable, std::move(pixelUse), premises, false, parallelFor);
  }
  return found;
}

} // namespace sensornoise
