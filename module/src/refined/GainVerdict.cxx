// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"

#include "base/Constants.h"
#include "pixels/Constants.h"
#include "refined/FramePhotonTransfer.h"
#include "refined/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace sensornoise
{

namespace
{
/** Returns whether the gains of columns differ, and the gains of rows. Amplifiers belong to columns or to rows; the
 * weights of an interpolation between pixels depend on both. */
bool
IsResampled(const LinesOfSensor & lines)
{
  const auto isLarge = [](const GainByLines & own) { return own.Differ() && own.size > InParts.sizeByWeights; };
  return isLarge(lines.columns) && isLarge(lines.rows);
}

/** Returns why the variance does not belong to a sensor of one gain; Identified: no reason was found. */
GainVerdict
FindContradiction(const RefinedResults & found, const GainEstimate & gain)
{
  if (found.frameNoise.HasSeveralGroups())
  {
    return GainVerdict::FramesDiffer;
  }
  if (found.lines.remainingVariance > 0.0 && CorrectionByCorrelation(found, gain) > InRefined.largestCorrection)
  {
    return GainVerdict::IlluminationIsLeft;
  }
  // Under strong vibration frames cannot be compared, so that their mixing may differ.
  if (found.correlation.kind == NoiseKind::Temporal && !MovesLittle(found.scene.model) &&
      CorrectionByCorrelation(found, gain) > 1.0 + InRefined.leastUnlikeNoise)
  {
    return GainVerdict::MotionIsLeft;
  }
  if (MovesLittle(found.scene.model) && IsResampled(found.variance.lines))
  {
    return GainVerdict::Resampled;
  }
  if (gain.nonlinearity > InRefined.largestNonlinearity)
  {
    return GainVerdict::NotAffine;
  }
  // Levels that are alike do not show whether their line or the dark frames are wrong.
  if (gain.isDarkRejected && gain.atOffset && !gain.isOffsetAboveFlicker && !gain.isWide)
  {
    return GainVerdict::DarkFramesContradict;
  }
  if (gain.isWide && gain.IsNonlinear() &&
      gain.above + gain.below > 2.0 * InCommon.largestRelativeError * gain.line.gain)
  {
    return GainVerdict::GainDependsOnOffset;
  }
  return gain.line.gain > 0.0 ? GainVerdict::Identified : GainVerdict::NotRising;
}

bool
AreTooFew(const std::vector<std::uint8_t> & pixelUse, double usable)
{
  const auto used = std::count(pixelUse.begin(), pixelUse.end(), static_cast<std::uint8_t>(PixelUse::Used));
  return static_cast<double>(used) < InRefined.leastUsedFraction * usable;
}
} // namespace

GainVerdict
TestGain(const RefinedResults & found, const GainEstimate & gain)
{
  // If all levels are alike, parts of them differ by fixed-pattern noise, and not by a non-linear response.
  const double error = gain.isWide ? std::sqrt(gain.covariance(0, 0)) : gain.StandardError();
  if (!(gain.line.pivotDn > found.blackDn) && error > InCommon.largestRelativeError * gain.line.gain)
  {
    return GainVerdict::NotRising; // the dark frames are brighter than the frames: no signal gives a size of the gain
  }
  const bool areTooFew = AreTooFew(found.variance.pixelUse, found.scene.usable);
  const bool isTooLittle = error > InCommon.largestRelativeError * gain.Size() || areTooFew;
  if (isTooLittle && !found.frameNoise.HasSeveralGroups() && !(gain.nonlinearity > InRefined.largestNonlinearity))
  {
    return areTooFew                 ? GainVerdict::TooFewPixels
           : FindFewLitFrames(found) ? GainVerdict::FewLitFrames
                                     : GainVerdict::LevelsTooAlike;
  }
  return FindContradiction(found, gain);
}

EstimateStatus
StatusBy(GainVerdict verdict)
{
  switch (verdict)
  {
    case GainVerdict::Identified:
      return EstimateStatus::Identified;
    case GainVerdict::TooFewPixels:
    case GainVerdict::FewLitFrames:
    case GainVerdict::LevelsTooAlike:
      return EstimateStatus::NotIdentifiable;
    case GainVerdict::FramesDiffer:
    case GainVerdict::IlluminationIsLeft:
    case GainVerdict::MotionIsLeft:
    case GainVerdict::Resampled:
    case GainVerdict::NotAffine:
    case GainVerdict::GainDependsOnOffset:
    case GainVerdict::DarkFramesContradict:
    case GainVerdict::NotRising:
    case GainVerdict::LineIllumination:
    case GainVerdict::NoiseNotLinear:
      break;
  }
  return EstimateStatus::Failed;
}

double
CorrectionByCorrelation(const RefinedResults & found, const GainEstimate & gain)
{
  const double correction = gain.line.gain / std::max(smallestDivisor, found.variance.line.gain);
  return std::max(correction, 1.0 / std::max(smallestDivisor, correction));
}

std::optional<Interval>
GainBounds(const RefinedResults & found, const GainEstimate & gain)
{
  const auto & known = found.settings.offset;
  const double signal = known ? gain.line.pivotDn - known->valueDn : 0.0;
  if (!known || known->variance || !(signal > 0.0))
  {
    return std::nullopt;
  }
  const Eigen::Vector2d pivot(gain.line.pivotDn, 1.0);
  const double          atPivot = gain.line.intercept + gain.line.gain * gain.line.pivotDn;
  const double          error = 2.0 * std::sqrt(std::max(0.0, pivot.dot(gain.covariance * pivot)));
  const double          lowest = std::min(gain.line.At(found.scene.model.darkestDn), atPivot);
  return Interval{ std::max(0.0, atPivot - lowest - error) / signal, (atPivot + error) / signal };
}

std::optional<LitFrames>
FindFewLitFrames(const RefinedResults & found)
{
  const Eigen::MatrixXd & basis = found.series.basis.GetBasis();
  const Eigen::Index      frames = basis.rows();
  const Eigen::VectorXd   illumination =
    (1.0 + Eigen::Map<const Eigen::VectorXd>(found.series.line.gamma.data(), frames).array()).max(0.0);
  const double          all = illumination.sum();
  const Eigen::VectorXd kept = (1.0 - 1.0 / static_cast<double>(frames)) - basis.cwiseAbs2().rowwise().sum().array();
  const double          left =
    illumination.dot(kept) / all * static_cast<double>(frames) / std::max(smallestDivisor, kept.sum());
  std::vector<Eigen::Index> order(static_cast<std::size_t>(frames));
  std::iota(order.begin(), order.end(), Eigen::Index{ 0 });
  std::stable_sort(
    order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return illumination(a) > illumination(b); });
  std::size_t count = 0;
  double      carried = 0.0;
  while (count < order.size() && carried < InPixels.fractionOfFewFrames * all)
  {
    carried += illumination(order[count++]);
  }
  if (left > 1.0 - InPixels.largestFeedback || 4 * count > order.size())
  {
    return std::nullopt;
  }
  order.resize(count);
  std::sort(order.begin(), order.end());
  return LitFrames{ order, carried / all, std::max(0.0, left) };
}

} // namespace sensornoise
