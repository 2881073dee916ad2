// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FramePhotonTransfer.h"

#include "base/Quantiles.h"
#include "base/Constants.h"
#include "base/Text.h"
#include "correlation/Constants.h"
#include "refined/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace sensornoise
{

namespace
{
constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

double
MedianOf(std::vector<double> values)
{
  return values.empty() ? Unknown : QuantileOf(std::move(values), 0.5);
}

/** Returns for each frame whether \a line predicts its noise variance in half of the tiles: the variance is above
 * LeastVarianceDn2(). The line does not determine the small variance of frames without illumination, and these have no
 * gain.
 */
std::vector<bool>
ArePredicted(const FrameEnergies & energies, const TileLevels & levels, const VarianceLine & line)
{
  Eigen::ArrayXd above = Eigen::ArrayXd::Zero(energies.Frames());
  for (Eigen::Index i = 0; i < energies.Tiles(); ++i)
  {
    above += (VariancesOfFrames(energies, levels, line, i).array() > LeastVarianceDn2(energies, i)).cast<double>();
  }
  std::vector<bool> predicted;
  for (Eigen::Index t = 0; t < above.size(); ++t)
  {
    predicted.push_back(2.0 * above(t) > static_cast<double>(energies.Tiles()));
  }
  return predicted;
}

/** Returns the squares of every frame over their expectation by \a line at its levels, as the median over the tiles.
 * \a noise is the known noise of the frames: the projection leaves some of the noise of each in the others. NaN for
 * frames that are not \a compared, and for frames that the projection leaves hardly anything of. */
Eigen::VectorXd
RatiosOfFrames(const FrameEnergies &     energies,
               const TileLevels &        levels,
               const VarianceLine &      line,
               const Eigen::VectorXd &   noise,
               const std::vector<bool> & compared)
{
  const Eigen::Index               frames = energies.Frames();
  std::vector<std::vector<double>> ofFrames(static_cast<std::size_t>(frames));
  for (Eigen::Index i = 0; i < energies.Tiles(); ++i)
  {
    const Eigen::VectorXd variance = VariancesOfFrames(energies, levels, line, i);
    const Eigen::VectorXd expected = energies.ExpectedSquares(variance.cwiseProduct(noise));
    std::vector<double>   ratios;
    std::vector<double>   known;
    for (Eigen::Index t = 0; t < frames; ++t)
    {
      const bool isLeft = compared[static_cast<std::size_t>(t)] &&
                          energies.RemainingFraction()(t) > InRefined.leastRemainingFraction && expected(t) > 0.0;
      ratios.push_back(isLeft ? energies.SquaresDn2()(i, t) * noise(t) / expected(t) : Unknown);
      if (isLeft)
      {
        known.push_back(ratios.back());
      }
    }
    const double typical = MedianOf(known);
    for (std::size_t t = 0; t < ratios.size() && typical > 0.0; ++t)
    {
      if (std::isfinite(ratios[t]))
      {
        ofFrames[t].push_back(ratios[t] / typical);
      }
    }
  }
  Eigen::VectorXd medians(frames);
  for (Eigen::Index t = 0; t < frames; ++t)
  {
    medians(t) = MedianOf(ofFrames[static_cast<std::size_t>(t)]);
  }
  return medians;
}

/** Returns the line turned about its pivot. */
VarianceLine
Turned(const VarianceLine & line, double byGain)
{
  VarianceLine turned = line;
  turned.gain += byGain;
  turned.intercept -= byGain * line.pivotDn;
  return turned;
}

/** Returns twice the slope of a line through the variance of \a line at the pivot that has no noise at zero signal
 * [DN/e-]. The factor allows for a dark offset that is not known. */
double
SteepestSlope(const VarianceLine & line, const TileLevels & levels)
{
  const double signalDn = line.pivotDn - levels.OffsetDn();
  return signalDn > 0.0 ? 2.0 * line.At(line.pivotDn) / signalDn : std::numeric_limits<double>::infinity();
}

/** The noise of a frame and its index. */
using NoiseOfFrame = std::pair<double, std::size_t>;

/** Returns the range of the largest group in \a sorted: the shortest interval that contains half of the frames,
 * extended to all frames near its median. */
std::pair<std::size_t, std::size_t>
FindLargestGroup(const std::vector<NoiseOfFrame> & sorted, double chance, double least)
{
  std::vector<double> noise;
  std::transform(
    sorted.begin(), sorted.end(), std::back_inserter(noise), [](const NoiseOfFrame & frame) { return frame.first; });
  auto begin = noise.begin() + static_cast<std::ptrdiff_t>(FindDensestHalf(noise));
  auto end = begin + static_cast<std::ptrdiff_t>((noise.size() + 1) / 2);
  for (int round = 0; round < 2; ++round) // the standard deviation of the densest half is too small
  {
    const RobustCentre centre = CentreOf({ begin, end });
    const double       most =
      std::max(least * centre.median, Significance.everyPixel * std::max(chance * centre.median, centre.sd));
    begin = std::lower_bound(noise.begin(), noise.end(), centre.median - most);
    end = std::upper_bound(noise.begin(), noise.end(), centre.median + most);
  }
  return { static_cast<std::size_t>(begin - noise.begin()), static_cast<std::size_t>(end - noise.begin()) };
}

FrameGroup
GroupOf(const std::vector<NoiseOfFrame> & sorted, std::size_t begin, std::size_t end)
{
  FrameGroup          group;
  std::vector<double> noise;
  for (std::size_t i = begin; i < end; ++i)
  {
    group.frames.push_back(sorted[i].second);
    noise.push_back(sorted[i].first);
  }
  std::sort(group.frames.begin(), group.frames.end());
  group.noise = MedianOf(noise);
  return group;
}

/** Adds the frames begin ... end - 1 in groups, divided where the noise differs by more than \a least. */
void
AddGroups(const std::vector<NoiseOfFrame> & sorted,
          std::size_t                       begin,
          std::size_t                       end,
          double                            least,
          std::vector<FrameGroup> &         groups)
{
  for (std::size_t first = begin, i = begin + 1; i <= end && begin < end; ++i)
  {
    if (i == end || sorted[i].first - sorted[i - 1].first > least * sorted[i].first)
    {
      groups.push_back(GroupOf(sorted, first, i));
      first = i;
    }
  }
}

/** Returns the groups of the frames, where the largest one has the frames begin ... end - 1. */
std::vector<FrameGroup>
GroupsAbout(const std::vector<NoiseOfFrame> & sorted, std::size_t begin, std::size_t end, double least)
{
  std::vector<FrameGroup> groups{ GroupOf(sorted, begin, end) };
  AddGroups(sorted, 0, begin, least, groups);
  AddGroups(sorted, end, sorted.size(), least, groups);
  return groups;
}

/** Leaves the frames out of the range begin ... end - 1 of the largest group, the first of \a groups, that are nearer
 * to another one. Where groups overlap, the largest one has frames of the others. */
void
LeaveOthersOut(const std::vector<NoiseOfFrame> & sorted,
               const std::vector<FrameGroup> &   groups,
               std::size_t &                     begin,
               std::size_t &                     end)
{
  const double largest = groups.front().noise;
  for (std::size_t k = 1; k < groups.size(); ++k)
  {
    const double between = 0.5 * (largest + groups[k].noise);
    while (groups[k].noise < largest && begin < end && sorted[begin].first < between)
    {
      ++begin;
    }
    while (groups[k].noise > largest && begin < end && sorted[end - 1].first > between)
    {
      --end;
    }
  }
}

} // namespace

Eigen::VectorXd
NoiseOfFrames(const FrameEnergies &   energies,
              const TileLevels &      levels,
              const VarianceLine &    line,
              double                  slopeError,
              const Eigen::VectorXd & known)
{
  const Eigen::VectorXd noise = known.size() > 0 ? known : Eigen::VectorXd::Ones(energies.Frames());
  if (energies.Tiles() < static_cast<Eigen::Index>(InCorrelation.leastTiles))
  {
    return {};
  }
  const std::vector<bool> compared = ArePredicted(energies, levels, line);
  const double            slack = Significance.hint * slopeError;
  const double            down = std::min(slack, std::max(0.0, line.gain));
  const double            up = std::min(slack, std::max(0.0, SteepestSlope(line, levels) - line.gain));
  Eigen::VectorXd         nearest = RatiosOfFrames(energies, levels, line, noise, compared);
  Eigen::VectorXd         low = nearest;
  Eigen::VectorXd         high = nearest;
  for (int step = 1; step <= InRefined.stepsOfSlope; ++step)
  {
    const double part = static_cast<double>(step) / InRefined.stepsOfSlope;
    for (const double turn : { -part * down, part * up })
    {
      const Eigen::VectorXd ratios = RatiosOfFrames(energies, levels, Turned(line, turn), noise, compared);
      low = low.cwiseMin(ratios);
      high = high.cwiseMax(ratios);
    }
  }
  for (Eigen::Index t = 0; t < nearest.size(); ++t)
  {
    nearest(t) = std::isfinite(nearest(t)) ? std::clamp(1.0, low(t), high(t)) : nearest(t);
  }
  return nearest;
}

FrameNoise
GroupFramesByNoise(const Eigen::VectorXd & ofFrames, double chance, double least)
{
  std::vector<NoiseOfFrame> sorted;
  double                    squares = 0.0;
  for (Eigen::Index t = 0; t < ofFrames.size(); ++t)
  {
    if (std::isfinite(ofFrames(t)))
    {
      sorted.emplace_back(ofFrames(t), static_cast<std::size_t>(t));
      squares += (ofFrames(t) - 1.0) * (ofFrames(t) - 1.0);
    }
  }
  FrameNoise found;
  if (sorted.empty())
  {
    return found;
  }
  std::sort(sorted.begin(), sorted.end());
  auto [begin, end] = FindLargestGroup(sorted, chance, least);
  found.groups = GroupsAbout(sorted, begin, end, least);
  LeaveOthersOut(sorted, found.groups, begin, end);
  found.groups = GroupsAbout(sorted, begin, end, least);
  for (std::size_t k = 1; k < found.groups.size(); ++k)
  {
    found.unlike.insert(found.unlike.end(), found.groups[k].frames.begin(), found.groups[k].frames.end());
  }
  std::sort(found.unlike.begin(), found.unlike.end());
  const double rms = std::sqrt(squares / static_cast<double>(sorted.size()));
  found.scatter = found.unlike.empty() && rms > std::max(least, Significance.everyPixel * chance) ? rms : 0.0;
  return found;
}

Eigen::VectorXd
FrameNoise::OfFrames(Eigen::Index frames) const
{
  Eigen::VectorXd noise = Eigen::VectorXd::Ones(frames);
  for (const FrameGroup & group : groups)
  {
    for (const std::size_t t : group.frames)
    {
      noise(static_cast<Eigen::Index>(t)) = group.noise;
    }
  }
  return noise;
}

std::string
TextOfFrames(const std::vector<std::size_t> & frames)
{
  constexpr std::size_t most = 4;
  std::string           text = frames.size() == 1 ? "frame " : "frames ";
  std::size_t           count = 0;
  for (std::size_t i = 0; i < frames.size(); ++count)
  {
    std::size_t last = i;
    while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1)
    {
      ++last;
    }
    text += count == 0 ? "" : ", ";
    if (count == most)
    {
      return text + "... (" + std::to_string(frames.size()) + " in all)";
    }
    text += std::to_string(frames[i]) + (last > i ? " to " + std::to_string(frames[last]) : "");
    i = last + 1;
  }
  return text;
}

std::string
FrameNoise::Text(double gain) const
{
  constexpr std::size_t most = 4;
  std::string           text;
  for (std::size_t k = 0; k < groups.size() && k <= most; ++k)
  {
    text += k == 0 ? "" : "; ";
    text += k == most ? "..."
                      : TextOfFrames(groups[k].frames) + ": " + Rounded(groups[k].noise) + " times, about " +
                          Rounded(gain * groups[k].noise) + " DN/e-";
  }
  return text;
}

} // namespace sensornoise
