// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ChannelReports.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Text.h"
#include "report/ReportParts.h"
#include "report/Quantities.h"
#include "sensornoise/FrameGeometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace sensornoise
{

namespace
{
/** Number with its standard error, which is above 0. Both have the unit of the quantity. */
struct Measurement
{
  double value;
  double error;
};

/** Returns the value and the standard error of a quantity; null: it lacks one of them. */
std::optional<Measurement>
MeasurementOf(const Quantity & quantity)
{
  if (!quantity.value || !quantity.standardError || !(*quantity.standardError > 0.0))
  {
    return std::nullopt;
  }
  return Measurement{ *quantity.value, *quantity.standardError };
}

/** Returns whether the dark offset was given as a number, without dark frames. */
bool
IsOffsetGiven(const Report & report)
{
  return std::any_of(report.settings.begin(), report.settings.end(), [](const auto & setting) {
    return setting.first == "dark_frames" && setting.second == Report::SettingValue{ 0.0 };
  });
}

/** Returns the weighted mean of the measured offsets; null: fewer than two channels measured an offset. */
std::optional<JointOffset>
JoinOffsets(const std::array<Report, 4> & channels)
{
  std::vector<Measurement> offsets;
  for (const Report & channel : channels)
  {
    if (const auto offset = MeasurementOf(channel.offset); offset && !IsOffsetGiven(channel))
    {
      offsets.push_back(*offset);
    }
  }
  if (offsets.size() < 2)
  {
    return std::nullopt;
  }
  double weights = 0.0;
  double sum = 0.0;
  double best = offsets.front().error;
  for (const Measurement & offset : offsets)
  {
    const double weight = 1.0 / (offset.error * offset.error);
    weights += weight;
    sum += weight * offset.value;
    best = std::min(best, offset.error);
  }
  const double mean = sum / weights;
  const double dof = static_cast<double>(offsets.size()) - 1.0;
  double       chi2 = 0.0;
  for (const Measurement & offset : offsets)
  {
    chi2 += (offset.value - mean) * (offset.value - mean) / (offset.error * offset.error);
  }
  JointOffset joint;
  joint.reducedChi2 = chi2 / dof;
  // If the offsets differ by more than chance (5 %), the cause of the difference is an error of the mean, too.
  const bool   isMore = chi2 > ChiSquareQuantile(0.95, dof);
  const double error = std::sqrt((isMore ? joint.reducedChi2 : 1.0) / weights);
  if (error < best)
  {
    joint.offset = WithError(mean, error);
    joint.precisionGain = best / error;
  }
  else
  {
    joint.offset = Quantity::Without(EstimateStatus::Failed);
  }
  return joint;
}

/** Warns if the gains of the two greens differ. Their filters, pixels and amplifiers are equal, so that a difference
 * shows another pattern, or rows with different amplifiers. */
void
CompareGreens(ChannelReports & reports)
{
  const auto first = MeasurementOf(reports.Of(BayerPlane::G1).gain);
  const auto second = MeasurementOf(reports.Of(BayerPlane::G2).gain);
  if (!first || !second)
  {
    return;
  }
  const double difference = first->value - second->value;
  const double error = std::hypot(first->error, second->error);
  const double mean = 0.5 * (first->value + second->value);
  if (std::abs(difference) > Significance.oneTest * error &&
      std::abs(difference) > InReport.leastGreenDifference * mean)
  {
    reports.warnings.push_back(
      { WarningCode::GreensDiffer,
        "the gains of the two greens are " + Measured(first->value, first->error) + " and " +
          Measured(second->value, second->error) +
          " DN/e-, expected equal: the pattern is wrong, or rows are read by different amplifiers. Check the "
          "pattern: --bayer" });
  }
}

/** Returns the mean level of the used pixels of a plane [DN]; null: no pixels are used. */
std::optional<double>
MeanLevelOf(const Report & report)
{
  double sum = 0.0;
  double pixels = 0.0;
  for (std::size_t i = 0; i < report.scatter.mean.size(); ++i)
  {
    sum += static_cast<double>(report.scatter.count[i]) * report.scatter.mean[i];
    pixels += static_cast<double>(report.scatter.count[i]);
  }
  return pixels > 0.0 ? std::optional<double>(sum / pixels) : std::nullopt;
}

/** Warns if the levels contradict the pattern. All planes show one scene, each through its colour filter: two planes of
 * one colour have the same mean level, except for noise and edges. If the planes called red and blue have equal levels,
 * and the planes called green have different levels, then red and blue are the greens. */
void
CompareLevels(ChannelReports & reports)
{
  const auto red = MeanLevelOf(reports.Of(BayerPlane::R));
  const auto first = MeanLevelOf(reports.Of(BayerPlane::G1));
  const auto second = MeanLevelOf(reports.Of(BayerPlane::G2));
  const auto blue = MeanLevelOf(reports.Of(BayerPlane::B));
  if (!red || !first || !second || !blue)
  {
    return;
  }
  const double contrast = 0.5 * std::abs(*red + *blue - *first - *second);
  const double ofGreens = std::abs(*first - *second);
  const double ofOthers = std::abs(*red - *blue);
  if (ofGreens > InReport.leastLevelDifference * std::max(contrast, ofOthers) && contrast > 0.0 &&
      ofOthers < InReport.largestLevelDifference * ofGreens)
  {
    reports.warnings.push_back(
      { WarningCode::BayerPatternDiffers,
        std::string("the levels contradict the pattern ") + NameOf(reports.pattern) + ": its greens differ, with " +
          Rounded(*first) + " and " + RoundedApart(*second, *first) + " DN, and its red and blue are alike, with " +
          Rounded(*red) + " and " + Rounded(*blue) + " DN. Give the pattern of the sensor: --bayer " +
          NameOf(CutPattern(reports.pattern, 1, 0)) + " or " + NameOf(CutPattern(reports.pattern, 0, 1)) });
  }
}

/** Sets the bit depth of all channels that have one to the largest of them. A dark plane may show too small a bit
 * depth, but all planes have one converter. */
void
UnifyBitDepths(std::array<Report, 4> & channels)
{
  std::optional<int> bits;
  for (const Report & channel : channels)
  {
    bits = std::max(bits, channel.bitDepth);
  }
  for (Report & channel : channels)
  {
    channel.bitDepth = channel.bitDepth ? bits : channel.bitDepth;
  }
}
} // namespace

const char *
NameOf(BayerSource source)
{
  return source == BayerSource::Given ? "given" : source == BayerSource::File ? "file" : "levels";
}

bool
ChannelReports::IsUsable() const
{
  return std::any_of(channels.begin(), channels.end(), [](const Report & channel) { return channel.IsUsable(); });
}

ChannelReports
MakeChannelReports(BayerPattern pattern, BayerSource source, std::array<Report, 4> channels)
{
  UnifyBitDepths(channels);
  for (const BayerPlane plane : BayerPlanes)
  {
    Report & report = channels.at(static_cast<std::size_t>(plane));
    report.channel = NameOf(plane);
    report.settings.emplace_back("bayer", std::string(NameOf(pattern)));
  }
  ChannelReports reports{ pattern, source, std::move(channels), std::nullopt, std::nullopt, {}, std::nullopt };
  if (source == BayerSource::Levels)
  {
    reports.warnings.push_back({ WarningCode::RedOrBlue,
                                 std::string("the pattern ") + NameOf(pattern) +
                                   " was found from the levels, which distinguish only green: the brighter of the "
                                   "two other colours is called R, but may be blue. Give the pattern (--bayer " +
                                   NameOf(pattern) + " or " + NameOf(CutPattern(pattern, 1, 1)) + ")" });
  }
  reports.joint = JoinOffsets(reports.channels);
  if (reports.joint && reports.joint->offset.status == EstimateStatus::Failed)
  {
    reports.warnings.push_back(
      { WarningCode::OffsetsDiffer,
        "the offsets of the channels differ by " + Rounded(std::sqrt(reports.joint->reducedChi2)) +
          " times their errors: steady illumination of another colour than the flickering one, or a black level for "
          "each channel. Give dark frames (--dark)" });
  }
  reports.motion = JoinMotion(reports.channels);
  if (reports.motion)
  {
    WidenVibration(reports.channels, *reports.motion);
    std::for_each(reports.channels.begin(), reports.channels.end(), FileStatuses);
  }
  CompareGreens(reports);
  CompareLevels(reports);
  return reports;
}

namespace
{
/** Shift (x, y) of every frame [pixel]; NaN: the frame is left out. */
using Motion = std::vector<std::array<double, 2>>;

/** Returns whether the shift of a frame is known; the shift of a frame that is left out is NaN. */
bool
IsKnown(const std::array<double, 2> & shift)
{
  return std::isfinite(shift[0]);
}

/** Returns the mean of two motions, minus its mean over time [pixel]. Both motions have the same number of frames. */
Motion
MeanOf(const Motion & first, const Motion & second)
{
  Motion                mean(first.size());
  std::array<double, 2> sum{};
  double                known = 0.0; // number of frames with a known shift
  for (std::size_t t = 0; t < mean.size(); ++t)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      mean[t][axis] = 0.5 * (first[t][axis] + second[t][axis]);
      sum[axis] += IsKnown(mean[t]) ? mean[t][axis] : 0.0;
    }
    known += IsKnown(mean[t]) ? 1.0 : 0.0;
  }
  for (auto & shift : mean)
  {
    shift[0] -= sum[0] / known;
    shift[1] -= sum[1] / known;
  }
  return mean;
}

/** Variances and covariance of the motion, from products of the mean motion a of R and B with the mean motion b of G1
 * and G2. Each sum over time is divided by the number of frames minus 1. The noise of a and the noise of b are
 * independent, and do not bias the products. */
struct JointProducts
{
  double dof{ 0.0 };            ///< degrees of freedom: number of distinct frames minus 1
  double square[2]{ 0.0, 0.0 }; ///< variance of the motion along x and y, without noise [pixel^2]
  double noise[2]{ 0.0, 0.0 };  ///< variance of a - b along x and y [pixel^2]
  double covariance{ 0.0 };     ///< covariance of the motions along x and along y [pixel^2]

  /** Returns the standard error of square[axis] [pixel^2]. */
  double
  ErrorOfSquare(std::size_t axis) const
  {
    return std::sqrt((std::max(0.0, square[axis]) * noise[axis] + 0.25 * noise[axis] * noise[axis]) / dof);
  }
  /** Returns the standard error of the covariance [pixel^2]. */
  double
  ErrorOfCovariance() const
  {
    const double both = std::max(0.0, square[0]) * noise[1] + std::max(0.0, square[1]) * noise[0];
    return 0.5 * std::sqrt((both + 0.5 * noise[0] * noise[1]) / dof);
  }
};

/** Returns the products of the motions \a a and \a b, which have the same number of frames. */
JointProducts
ProductsOf(const Motion & a, const Motion & b, std::size_t framesDistinct)
{
  JointProducts products;
  products.dof = static_cast<double>(std::max<std::size_t>(framesDistinct, 2) - 1);
  const auto   known = static_cast<std::size_t>(std::count_if(a.begin(), a.end(), IsKnown));
  const double scale = 1.0 / static_cast<double>(std::max<std::size_t>(known, 2) - 1);
  for (std::size_t t = 0; t < a.size(); ++t)
  {
    if (!IsKnown(a[t]))
    {
      continue;
    }
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const double difference = a[t][axis] - b[t][axis];
      products.square[axis] += scale * a[t][axis] * b[t][axis];
      products.noise[axis] += scale * difference * difference;
    }
    products.covariance += 0.5 * scale * (a[t][0] * b[t][1] + a[t][1] * b[t][0]);
  }
  return products;
}

/** Returns the smallest standard error of a quantity among the channels, in its unit; 0: no channel has one. */
double
SmallestError(const std::array<Report, 4> & channels, Quantity Report::* member)
{
  std::optional<double> smallest;
  for (const Report & channel : channels)
  {
    if (const auto & error = (channel.*member).standardError)
    {
      smallest = smallest ? std::min(*smallest, *error) : *error;
    }
  }
  return smallest.value_or(0.0);
}

/** Adds the deviation of \a quantity from \a joint to its standard error, as a root sum of squares. The 95 % interval
 * follows from the new error, and has no values below \a lowest. */
void
Widen(Quantity & quantity, const Quantity & joint, double lowest)
{
  if (!quantity.value || !quantity.standardError || !joint.value)
  {
    return;
  }
  quantity = WithError(*quantity.value, std::hypot(*quantity.standardError, *quantity.value - *joint.value));
  quantity.interval95->low = std::max(lowest, *quantity.interval95->low);
}
} // namespace

std::optional<JointMotion>
JoinMotion(const std::array<Report, 4> & channels)
{
  const std::size_t frames = channels.front().motion.size();
  for (const Report & channel : channels)
  {
    if (channel.motion.empty() || channel.motion.size() != frames)
    {
      return std::nullopt;
    }
  }
  const auto motionOf = [&channels](BayerPlane plane) -> const Motion & {
    return channels.at(static_cast<std::size_t>(plane)).motion;
  };
  // Each of the two pairs samples every column and every row of the mosaic.
  const Motion        redBlue = MeanOf(motionOf(BayerPlane::R), motionOf(BayerPlane::B));
  const Motion        greens = MeanOf(motionOf(BayerPlane::G1), motionOf(BayerPlane::G2));
  const JointProducts products = ProductsOf(redBlue, greens, channels.front().framesDistinct);
  const auto          sdAlong = [&](std::size_t axis, Quantity Report::* ofPlane) {
    const double sd = std::sqrt(std::max(0.0, products.square[axis]));
    return RootOf(products.square[axis],
                  std::hypot(products.ErrorOfSquare(axis), 2.0 * sd * SmallestError(channels, ofPlane)));
  };
  JointMotion joint;
  joint.sdX = sdAlong(0, &Report::vibrationSdX);
  joint.sdY = sdAlong(1, &Report::vibrationSdY);
  joint.covariance =
    WithError(products.covariance,
              std::hypot(products.ErrorOfCovariance(), SmallestError(channels, &Report::vibrationCovariance)));
  joint.series = MeanOf(redBlue, greens);
  return joint;
}

void
WidenVibration(std::array<Report, 4> & channels, const JointMotion & joint)
{
  for (Report & channel : channels)
  {
    Widen(channel.vibrationSdX, joint.sdX, 0.0);
    Widen(channel.vibrationSdY, joint.sdY, 0.0);
    Widen(channel.vibrationCovariance, joint.covariance, -std::numeric_limits<double>::infinity());
  }
}

} // namespace sensornoise
