// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"

#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "pixels/Constants.h"
#include "pixels/RoughnessClasses.h"
#include "pixels/GainByParts.h"
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
/** Fits a line to a sample of the pixels: precise enough to test pixels. */
VarianceLine
FitSampleLine(const VarianceData & data, const std::optional<VarianceLine> & start, const ParallelFor & parallelFor)
{
  const SampledVariance sample(data, InCommon.pixelsOfSample, parallelFor);
  VarianceFit           fit(sample.GetData(), parallelFor, start);
  fit.Iterate(3);
  fit.FillErrors();
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
  return projected.GetSquares().HasUnequalNoise() && line.isDetermined
           ? GainFeedback(projected, line, mask, parallelFor)
           : GainFeedback();
}

/** A line, and the variance that it was fitted to. */
struct FittedLine
{
  VarianceLine      line;
  ProjectedVariance projected;

  /** Returns the variance with the gain of the line. */
  ProjectedVariance
  OfLine() const
  {
    return projected.WithLine(line);
  }
};

/** Fits a line to the pixels of \a mask, again until the gain that corrects the variances equals the gain of the
 * line. */
FittedLine
FitFixedPointLine(ProjectedVariance                   projected,
                  const std::vector<std::uint8_t> &   mask,
                  const std::optional<VarianceLine> & start,
                  const ParallelFor &                 parallelFor)
{
  VarianceLine line = FitSampleLine(projected.GetData(mask), start, parallelFor);
  for (int round = 0; round < InCommon.roundsOfFit; ++round)
  {
    const GainFeedback feedback = ComputeFeedback(projected, line, mask, parallelFor);
    const VarianceLine settled = feedback.SolveFixedPoint(line, projected.GetGain());
    if (!feedback.IsLarge() ||
        std::abs(settled.gain - projected.GetGain()) < InPixels.fixedPointChange * std::abs(settled.gain))
    {
      break;
    }
    projected = projected.WithLine(settled);
    line = FitSampleLine(projected.GetData(mask), settled, parallelFor);
  }
  return { line, std::move(projected) };
}

/** Fits the first line to the flat pixels of \a mask. If only dark areas of the scene are flat, brighter pixels are
 * added to the mask, provided that their variance lies on one line with the variance of the dark pixels. */
FittedLine
FitFirstLine(ProjectedVariance                 projected,
             const std::vector<std::uint8_t> & usable,
             std::vector<std::uint8_t> &       mask,
             const ParallelFor &               parallelFor)
{
  if (const std::optional<BrighterPixels> brighter = FindBrighterPixels(projected, usable, mask, parallelFor))
  {
    FittedLine fitted = FitFixedPointLine(std::move(projected), brighter->mask, brighter->through, parallelFor);
    if (fitted.line.isDetermined && AgreesWithLine(fitted.projected, brighter->beyond, fitted.line) &&
        AgreesWithLine(fitted.projected, mask, fitted.line))
    {
      mask = brighter->mask;
      return fitted;
    }
    projected = std::move(fitted.projected); // its gain is more accurate than the gain of the initial model
  }
  return FitFixedPointLine(std::move(projected), mask, std::nullopt, parallelFor);
}

/** Fits the line of all pixels of the data, with its errors. */
VarianceFit
FitAllPixels(const VarianceData & data, const VarianceLine & start, double blackDn, const ParallelFor & parallelFor)
{
  const SampledVariance sample(data, InCommon.pixelsOfSample, parallelFor);
  VarianceFit           rough(sample.GetData(), parallelFor, start, TrimRule::Distance, blackDn);
  rough.Iterate(8);
  VarianceFit fit(data, rough);
  fit.Iterate(InPixels.stepsFromRoughLine);
  fit.FillErrors();
  return fit;
}

std::size_t
CountPixels(const std::vector<std::uint8_t> & mask)
{
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), std::uint8_t{ 1 }));
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
  const std::vector<std::uint8_t> rejected = RejectNeighbourhoods(projected, line, usable, parallelFor);
  ForPixels(
    rejected.size(), parallelFor, [&](std::size_t p) { found.mask[p] = usable[p] != 0 && rejected[p] == 0 ? 1 : 0; });
  found.classes = TestClasses(projected, line, found.mask, parallelFor);
  ForPixels(rejected.size(),
            parallelFor,
            [usable = usable.data(),
             rejected = rejected.data(),
             classOf = projected.GetSquares().GetClasses().data(),
             firstBad = found.classes.firstBad,
             use = found.pixelUse.data(),
             mask = found.mask.data()](std::size_t p) {
              const bool isRough = classOf[p] >= firstBad;
              const auto own = static_cast<std::uint8_t>(rejected[p] != 0 ? PixelUse::NotStatic
                                                         : isRough        ? PixelUse::Vibration
                                                                          : PixelUse::Used);
              use[p] = usable[p] != 0 ? own : use[p];
              mask[p] = isRough ? 0 : mask[p];
            });
  return CountPixels(rejected);
}

/** A line, and the parts by whose ratios the variance was divided for it; null: it was not divided. */
struct LineOfParts
{
  FittedLine                 drawn;
  std::optional<GainByParts> dividedBy;
};

/** Divides the variance by the ratios of parts whose gains differ much, so that their pixels are not rejected, and fits
 * the line of \a drawn again. The line is of the mean over the \a usable pixels, as a half of the sensor may have fewer
 * flat ones. Returns \a drawn unless most pixels then follow the line: other causes of differences between parts, such
 * as a non-linear response, are left to the fit. */
LineOfParts
CorrectForParts(FittedLine                        drawn,
                const PartReference &             reference,
                const std::vector<std::uint8_t> & usable,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor)
{
  GainByParts            parts = CompareParts(TilesOfMeasured(drawn.projected, reference, mask, parallelFor));
  const ReferenceFrame & frame = drawn.projected.GetFrame();
  for (auto * const own : { &parts.places, &parts.phases })
  {
    if (*own && !(*own)->DifferMuch())
    {
      own->reset();
    }
    if (*own)
    {
      (*own)->CentreOn(usable, frame.geometry);
    }
  }
  if (parts.Larger() == nullptr)
  {
    return { std::move(drawn), std::nullopt };
  }
  const ProjectedVariance divided =
    drawn.projected.WithRatios(MapOfRatios(parts, frame.mean, frame.geometry, reference, parallelFor));
  FittedLine again = FitFixedPointLine(divided, mask, drawn.line, parallelFor);
  if (again.line.isDetermined && AgreesWithLine(again.projected, mask, again.line))
  {
    return { std::move(again), std::move(parts) };
  }
  return { std::move(drawn), std::nullopt };
}

/** Corrects the slope for the noise of the means, and for the correlation of this noise with the variance, which skewed
 * noise has. Together they bias the slope's equation by -g sigma^2 / T per unit of weight. The offset that sigma needs
 * lies between \a lowestDn and \a highestDn: the mean correction is made, and what it may be off by is an error.
 * Estimator.md, 3.6. */
void
CorrectForNoisyMeans(VarianceLine & line, double lowestDn, double highestDn, std::size_t frames)
{
  const auto bias = [&](double offsetDn) {
    const double readVariance = std::max(0.0, line.intercept + line.gain * offsetDn);
    return -line.gain * readVariance / static_cast<double>(frames) * line.weightSum / line.spreadDn2;
  };
  const double          least = bias(lowestDn);
  const double          most = bias(highestDn);
  const double          mean = 0.5 * (least + most);
  const Eigen::Vector2d effect(1.0, -line.pivotDn);
  line.gain -= mean;
  line.intercept += mean * line.pivotDn;
  line.covariance +=
    (most - least) * (most - least) / 12.0 * effect * effect.transpose(); // variance of a uniform distribution
}

/** Levels and variance inflation that FitStaticVariance() is called with, see there. */
struct FitPremises
{
  double firstGain;
  double offsetDn;
  double blackDn;
  double varianceInflation;
};

/** Result of FitStaticVariance(), and whether the variance was divided by the ratios of parts. */
struct StaticFit
{
  StaticVariance variance;
  bool           isDivided{ false };
};

/** The pixels that were selected, and their line. */
struct SelectedLine
{
  FittedLine                 drawn;
  StaticVariance             found;     ///< mask, use of the pixels, and classes are set
  std::optional<GainByParts> dividedBy; ///< parts by whose ratios the variance was divided; null: it was not
};

/** Selects the pixels of a static scene. The line of the flat classes rejects neighbourhoods, and then classes among
 * the others. With \a mayDivide the variance may be divided by the ratios of parts. */
SelectedLine
SelectStaticPixels(const ProjectedSquares &          squares,
                   const std::vector<std::uint8_t> & usable,
                   std::vector<std::uint8_t>         pixelUse,
                   const FitPremises &               premises,
                   bool                              mayDivide,
                   const ParallelFor &               parallelFor)
{
  StaticVariance found;
  found.varianceInflation = premises.varianceInflation;
  found.pixelUse = std::move(pixelUse);
  found.mask = MaskOfFlatClasses(squares, usable, parallelFor);
  FittedLine                 drawn = FitFirstLine({ squares, premises.firstGain }, usable, found.mask, parallelFor);
  std::optional<GainByParts> dividedBy;
  if (mayDivide && drawn.line.isDetermined)
  {
    const PartReference reference{ drawn.line, premises.blackDn, premises.varianceInflation };
    LineOfParts         ofParts = CorrectForParts(std::move(drawn), reference, usable, found.mask, parallelFor);
    drawn = std::move(ofParts.drawn);
    dividedBy = std::move(ofParts.dividedBy);
  }
  bool isSettled = false;
  for (int round = 0; round < 2 && drawn.line.isDetermined && !isSettled; ++round)
  {
    RejectionModel model = FitRejectionModel(drawn.line, drawn.projected, found.mask, premises.blackDn, parallelFor);
    model.varianceInflation = premises.varianceInflation;
    const ProjectedVariance projected = drawn.OfLine();
    std::size_t             numberRejected = SelectPixels(projected, model, usable, found, parallelFor);
    if (found.classes.isBelowModel)
    {
      StaticVariance byLevels = found;
      SetRatiosOfLevels(model, projected, usable);
      const std::size_t rejectedByLevels = SelectPixels(projected, model, usable, byLevels, parallelFor);
      if (CountPixels(byLevels.mask) > CountPixels(found.mask))
      {
        found = std::move(byLevels);
        numberRejected = rejectedByLevels;
      }
    }
    isSettled = static_cast<double>(numberRejected) < InPixels.fewRejected * static_cast<double>(usable.size());
    drawn = FitFixedPointLine(projected, found.mask, model.line, parallelFor);
  }
  if (drawn.line.isDetermined)
  {
    ProjectedVariance               projected = drawn.OfLine();
    const std::vector<std::uint8_t> quiet = FindQuietPixels(projected, drawn.line, found.mask, parallelFor);
    if (!quiet.empty())
    {
      ForPixels(quiet.size(), parallelFor, [&](std::size_t p) {
        found.mask[p] = quiet[p] != 0 ? 0 : found.mask[p];
        found.pixelUse[p] = quiet[p] != 0 ? static_cast<std::uint8_t>(PixelUse::Outlier) : found.pixelUse[p];
      });
      drawn = FitFixedPointLine(std::move(projected), found.mask, drawn.line, parallelFor);
    }
  }
  return { std::move(drawn), std::move(found), std::move(dividedBy) };
}

/** Computes FitStaticVariance() once. With \a mayDivide the variance may be divided by the ratios of parts. */
StaticFit
FitOnce(const ProjectedSquares &          squares,
        const std::vector<std::uint8_t> & usable,
        std::vector<std::uint8_t>         pixelUse,
        const FitPremises &               premises,
        bool                              mayDivide,
        const ParallelFor &               parallelFor)
{
  const auto [firstGain, offsetDn, blackDn, varianceInflation] = premises;
  auto [drawn, found, dividedBy] =
    SelectStaticPixels(squares, usable, std::move(pixelUse), premises, mayDivide, parallelFor);
  const bool isDivided = drawn.projected.HasRatios();
  if (!drawn.line.isDetermined)
  {
    return { std::move(found), isDivided };
  }
  ProjectedVariance  projected = drawn.OfLine();
  VarianceFit        fit = FitAllPixels(projected.GetData(found.mask), drawn.line, blackDn, parallelFor);
  const GainFeedback feedback = ComputeFeedback(projected, fit.GetLine(), found.mask, parallelFor);
  if (feedback.IsLarge())
  {
    const VarianceLine settled = feedback.SolveFixedPoint(fit.GetLine(), projected.GetGain());
    projected = projected.WithLine(settled);
    fit = FitAllPixels(projected.GetData(found.mask), settled, blackDn, parallelFor);
  }
  found.correctingGain = projected.GetGain();
  const auto settle = [&gain = found.correctingGain, &feedback](const VarianceLine & fitted) {
    return feedback.SolveFixedPoint(fitted, gain);
  };
  VarianceLine line = settle(fit.GetLine());
  if (!line.isDetermined)
  {
    return { std::move(found), isDivided };
  }
  const std::vector<std::uint8_t> trimmed = fit.FindTrimmed();
  ForPixels(trimmed.size(), parallelFor, [&use = found.pixelUse, &trimmed](std::size_t p) {
    use[p] = trimmed[p] != 0 ? static_cast<std::uint8_t>(PixelUse::Outlier) : use[p];
  });
  const ReferenceFrame & frame = projected.GetFrame();
  const VarianceData     data = projected.GetData(found.mask);
  found.pattern = EstimateFixedPattern(frame, data, line, blackDn, parallelFor);
  found.pattern.stepFraction =
    FractionOfSensorSteps(data, frame.geometry, line, blackDn, found.pattern.levelVarianceDn2, parallelFor);
  found.instrumentalLine = FindInstrumentalLine(line, found.pattern, fit, data, frame, settle);
  line.covariance *= WideningByCells(fit, data, frame.geometry);
  CorrectForNoisyMeans(line, std::min(blackDn, offsetDn), offsetDn, frame.frames);
  std::vector<std::uint8_t> kept = found.mask;
  ForPixels(kept.size(), parallelFor, [&](std::size_t p) { kept[p] = trimmed[p] != 0 ? 0 : kept[p]; });
  const PartReference reference{ line, blackDn, varianceInflation };
  const PartTiles     tiles = TilesOfMeasured(projected, reference, kept, parallelFor);
  found.parts = CompareParts(tiles);
  const std::vector<PartGains> parts = dividedBy            ? dividedBy->OfPixels()
                                       : found.parts.places ? std::vector<PartGains>()
                                                            : FindPossibleParts(tiles.places);
  const Eigen::Matrix2d        ofParts = CovarianceByRatios(parts, data, frame.geometry, reference, parallelFor);
  line.covariance += ofParts;
  found.instrumentalLine.covariance += ofParts;
  found.line = line;
  found.curve = fit.CurveAbout(found.instrumentalLine.isDetermined ? found.instrumentalLine : line);
  if (found.instrumentalLine.isDetermined)
  {
    VarianceCurve byInstrument = CurveByInstrument(found.instrumentalLine, fit, data, frame);
    if (2.0 * byInstrument.Nonlinearity(1.0) < found.curve.Nonlinearity(1.0)) // a non-linear response is in both
    {
      found.curve = std::move(byInstrument);
    }
  }
  if (found.curve.ReducedChi2() > InSteps.leastChi2 * varianceInflation)
  {
    found.ofOwnLevels = fit.CurveAbout(found.curve.line, VarianceFit::SortedBy::OwnLevel);
  }
  if (!found.parts.phases)
  {
    // Motion adds most to the variance beside edges, which may be parallel to the lines.
    const std::vector<std::uint8_t> flat = MaskOfFlatClasses(squares, kept, parallelFor);
    VarianceData                    ofFlat = projected.GetData(flat);
    ofFlat.variance.ratios = nullptr;
    found.lines = CompareLines(ofFlat, frame.geometry, reference, parallelFor);
  }
  found.excessOfLeftOut = ExcessOfLeftOut(projected, reference, found.pixelUse, parallelFor);
  found.notStatic = static_cast<std::size_t>(
    std::count(found.pixelUse.begin(), found.pixelUse.end(), static_cast<std::uint8_t>(PixelUse::NotStatic)));
  return { std::move(found), isDivided };
}
} // namespace

StaticVariance
FitStaticVariance(const ProjectedSquares &          squares,
                  const std::vector<std::uint8_t> & usable,
                  std::vector<std::uint8_t>         pixelUse,
                  double                            firstGain,
                  double                            offsetDn,
                  double                            blackDn,
                  const ParallelFor &               parallelFor,
                  double                            varianceInflation)
{
  const FitPremises premises{ firstGain, offsetDn, blackDn, varianceInflation };
  StaticFit         found = FitOnce(squares, usable, pixelUse, premises, true, parallelFor);
  if (found.isDivided && found.variance.parts.Larger() == nullptr)
  {
    // The pixels that fit do not confirm the differences between parts: a non-linear response, on a chart, looks like
    // them.
    found = FitOnce(squares, usable, std::move(pixelUse), premises, false, parallelFor);
  }
  return std::move(found.variance);
}

} // namespace sensornoise
