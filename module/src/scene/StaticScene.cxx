// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/StaticScene.h"

#include "base/Quantiles.h"
#include "base/Constants.h"
#include "base/RegressionSums.h"
#include "sensornoise/Report.h"
#include "base/Stencils.h"
#include "moments/StackFrames.h"
#include "scene/Constants.h"
#include "scene/UsablePixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** The lines of the frame that are parallel to a border: line 0 is the outermost one. */
struct BorderLines
{
  const std::vector<double> &       mean;
  const std::vector<std::uint8_t> & valid;
  std::size_t                       first;  // number of the pixel at the corner
  std::ptrdiff_t                    inward; // distance from a line to the next line [pixels in memory]
  std::ptrdiff_t                    along;  // distance from a pixel of a line to the next pixel [pixels in memory]
  std::size_t                       lines;
  std::size_t                       length;

  /** Returns the levels of about InScene.pixelsOfBorderLine pixels in the middle half of a line [DN]. The ends are left
   * out, because strips of the other borders may cover them. NaN: not valid. */
  std::vector<double>
  LevelsOf(std::size_t line) const
  {
    const std::size_t   middle = length / 2;
    const std::size_t   step = std::max<std::size_t>(1, middle / InScene.pixelsOfBorderLine);
    std::vector<double> levels;
    for (std::size_t j = length / 4; j < length / 4 + middle; j += step)
    {
      const auto p =
        static_cast<std::size_t>(static_cast<std::ptrdiff_t>(first) + static_cast<std::ptrdiff_t>(line) * inward +
                                 static_cast<std::ptrdiff_t>(j) * along);
      levels.push_back(valid[p] != 0 ? mean[p] : std::numeric_limits<double>::quiet_NaN());
    }
    return levels;
  }
};

/** Returns the centre of the levels of a line [DN]; null: too few of its pixels are valid. */
std::optional<RobustCentre>
LevelsAlongLine(std::vector<double> levels)
{
  levels.erase(std::remove_if(levels.begin(), levels.end(), [](double level) { return !std::isfinite(level); }),
               levels.end());
  if (levels.size() < InScene.fewestPixelsOfMedian)
  {
    return std::nullopt;
  }
  return CentreOf(std::move(levels));
}

/** Returns the median absolute difference between \a levels and \a others [DN]; infinite if there are no differences.
 */
double
MedianDifference(const std::vector<double> & levels, const std::vector<double> & others)
{
  std::vector<double> differences;
  for (std::size_t j = 0; j < levels.size(); ++j)
  {
    const double difference = std::abs(levels[j] - others[j]);
    if (std::isfinite(difference))
    {
      differences.push_back(difference);
    }
  }
  return differences.empty() ? std::numeric_limits<double>::infinity() : Quantile(differences, 0.5);
}

/** Returns the fraction of the levels whose distance from \a level exceeds \a distance [1]. */
double
FractionBeyond(const std::vector<double> & levels, double level, double distance)
{
  std::size_t beyond = 0;
  std::size_t counted = 0;
  for (const double own : levels)
  {
    beyond += std::abs(own - level) > distance ? 1 : 0;
    counted += std::isfinite(own) ? 1 : 0;
  }
  return static_cast<double>(beyond) / static_cast<double>(std::max<std::size_t>(1, counted));
}

/** Returns whether the strip of \a count lines ends within one pixel, and is either darker than nearly all of the scene
 * or without the structure of the scene beside it. */
bool
EndsSharply(const BorderLines & border, const RobustCentre & outermost, std::size_t count)
{
  const double                      distance = Significance.severalTests * outermost.sd;
  const std::vector<double>         beside = border.LevelsOf(count);
  const std::vector<double>         next = border.LevelsOf(count + 1);
  const std::optional<RobustCentre> first = LevelsAlongLine(beside);
  if (!first || FractionBeyond(beside, outermost.median, distance) < InScene.leastBorderFraction)
  {
    return false;
  }
  const double step = MedianDifference(beside, std::vector<double>(beside.size(), outermost.median));
  const double inside = std::max(MedianDifference(next, beside), MedianDifference(border.LevelsOf(count + 2), next));
  if (!(step > distance) || inside > InScene.largestBorderSlope * step)
  {
    return false;
  }
  if (count > 1)
  {
    const auto last = LevelsAlongLine(border.LevelsOf(count - 1));
    if (!last || std::abs(last->median - outermost.median) > InScene.largestBlur * step)
    {
      return false;
    }
  }
  const bool          hasStructure = first->sd > InScene.leastStructure * outermost.sd;
  std::vector<double> scene;
  const std::size_t   middle = border.lines - border.lines / 4; // the opposite border may have a strip, too
  for (std::size_t line = count; line < middle; line += std::max<std::size_t>(1, border.lines / 64))
  {
    const std::vector<double> own = border.LevelsOf(line);
    scene.insert(scene.end(), own.begin(), own.end());
  }
  scene.erase(std::remove_if(scene.begin(), scene.end(), [](double level) { return !std::isfinite(level); }),
              scene.end());
  const double darkest = Quantile(scene, InScene.darkestOfScene);
  return hasStructure || outermost.median + distance < darkest;
}

/** Returns the number of lines of the strip that begins with line 0; 0: no strip begins there. */
std::size_t
CountLines(const BorderLines & border, const RobustCentre & outermost)
{
  const auto largest = static_cast<std::size_t>(InScene.largestBorder * static_cast<double>(border.lines));
  for (std::size_t k = 1; k <= largest && k + 3 <= border.lines; ++k)
  {
    const std::optional<RobustCentre> own = LevelsAlongLine(border.LevelsOf(k));
    if (!own)
    {
      return 0;
    }
    const bool isEven = own->sd < Significance.severalTests * outermost.sd;
    const bool isNear = std::abs(own->median - outermost.median) < Significance.severalTests * outermost.sd;
    if (!(isEven && isNear) && EndsSharply(border, outermost, k))
    {
      return k;
    }
    if (!isEven)
    {
      return 0;
    }
  }
  return 0;
}

/** Levels of a line as a line over the levels of another one, pixel by pixel. */
struct LineLikeness
{
  double slope{ 0.0 };           ///< fraction of the structure of the other line in the line [1]
  double error{ 0.0 };           ///< standard error of the slope [1]
  double structureDn2{ 0.0 };    ///< variance of the levels of the other line [DN^2]
  double covarianceDn2{ 0.0 };   ///< covariance of both lines [DN^2]
  double covarianceError{ 0.0 }; ///< its standard error where the lines are independent [DN^2]
};

/** Compares the \a levels of a line with the levels of the \a other line. Null: too few pixels are valid in both, or
 * one of the lines has one level. */
std::optional<LineLikeness>
CompareLines(const std::vector<double> & levels, const std::vector<double> & other)
{
  const double   origin = LevelsAlongLine(other).value_or(RobustCentre{}).median;
  RegressionSums sums;
  double         squares = 0.0;
  for (std::size_t j = 0; j < levels.size(); ++j)
  {
    if (std::isfinite(levels[j]) && std::isfinite(other[j]))
    {
      sums += RegressionSums::Of(1.0, other[j] - origin, levels[j] - origin);
      squares += (levels[j] - origin) * (levels[j] - origin);
    }
  }
  const double ofLevels = sums.w > 0.0 ? squares - sums.y * sums.y / sums.w : 0.0;
  if (sums.w < static_cast<double>(InScene.fewestPixelsOfMedian) || !(sums.Spread() > 0.0) || !(ofLevels > 0.0))
  {
    return std::nullopt;
  }
  const double dof = sums.w - 2.0;
  const double residual = std::max(0.0, ofLevels - sums.Slope() * sums.Product());
  return LineLikeness{ sums.Slope(),
                       std::sqrt(residual / (dof * sums.Spread())),
                       sums.Spread() / dof,
                       sums.Product() / dof,
                       std::sqrt(ofLevels * sums.Spread() / sums.w) / dof };
}

/** Returns the number of lines before the first line that shows the scene; 0: there are none. A mask whose edge is not
 * sharp, or light below it, makes the levels of its lines differ. But none of them has the structure of the scene,
 * which begins within one pixel, whereas the image of an edge is blurred. */
std::size_t
CountLinesWithoutScene(const BorderLines & border)
{
  const auto largest = static_cast<std::size_t>(InScene.largestBorder * static_cast<double>(border.lines));
  const auto showsScene = [&](std::size_t line) {
    const auto next = CompareLines(border.LevelsOf(line), border.LevelsOf(line + 1));
    return next && next->slope > 1.0 - InScene.largestBorderSlope;
  };
  double sharedDn2 = 0.0; // structure that lines of the strip have in common
  for (std::size_t k = 1; k <= largest && k + 3 <= border.lines; ++k)
  {
    const auto last = CompareLines(border.LevelsOf(k - 1), border.LevelsOf(k));
    if (!last)
    {
      return 0;
    }
    const double blur = std::max(std::abs(last->slope), Significance.hint * last->error);
    if (blur < InScene.largestBlur && sharedDn2 < std::pow(InScene.largestBlur, 2) * last->structureDn2 &&
        showsScene(k) && showsScene(k + 1))
    {
      return k;
    }
    sharedDn2 = std::max(sharedDn2, last->covarianceDn2 - Significance.hint * last->covarianceError);
  }
  return 0;
}

std::optional<MaskedStrip>
FindStrip(const BorderLines & border, const char * words)
{
  const std::optional<RobustCentre> outermost = LevelsAlongLine(border.LevelsOf(0));
  if (!outermost || !(outermost->sd > 0.0))
  {
    return std::nullopt;
  }
  const std::size_t ofOneLevel = CountLines(border, *outermost);
  const std::size_t count = ofOneLevel > 0 ? ofOneLevel : CountLinesWithoutScene(border);
  if (count == 0)
  {
    return std::nullopt;
  }
  return MaskedStrip{ words, count, outermost->median, LevelsAlongLine(border.LevelsOf(count))->median };
}
} // namespace

MaskedBorder
FindMaskedBorder(const std::vector<double> &       mean,
                 const std::vector<std::uint8_t> & valid,
                 const FrameGeometry &             geometry)
{
  MaskedBorder      border;
  const std::size_t w = geometry.width;
  const std::size_t h = geometry.height;
  if (std::min(w, h) < InScene.leastBorderedSide)
  {
    return border;
  }
  const auto row = static_cast<std::ptrdiff_t>(w);
  const auto find = [&](const BorderLines & lines, const char * words) {
    const auto strip = FindStrip(lines, words);
    if (strip)
    {
      border.strips.push_back(*strip);
    }
    return strip ? strip->lines : 0;
  };
  border.left = find({ mean, valid, 0, 1, row, w, h }, "leftmost columns");
  border.right = find({ mean, valid, w - 1, -1, row, w, h }, "rightmost columns");
  border.top = find({ mean, valid, 0, row, 1, h, w }, "top rows");
  border.bottom = find({ mean, valid, (h - 1) * w, -row, 1, h, w }, "bottom rows");
  return border;
}

namespace
{
/** Marks the pixels of the masked border as not valid, so that they are no neighbours of other pixels. */
void
LeaveOutBorder(std::vector<std::uint8_t> & valid, const MaskedBorder & border, const FrameGeometry & geometry)
{
  for (std::size_t p = 0; p < valid.size() && !border.strips.empty(); ++p)
  {
    valid[p] = border.Holds(p % geometry.width, p / geometry.width, geometry) ? 0 : valid[p];
  }
}

/** Marks the pixels that may be saturated as not valid, so that they are no neighbours of other pixels. The level of
 * the wells becomes the upper clip level. */
void
LeaveOutFullWells(StackMaps & maps, const FullWells & wells, const std::vector<std::uint8_t> & userMask)
{
  std::size_t pixels = 0;
  for (std::size_t p = 0; p < maps.valid.size(); ++p)
  {
    const bool isFull = maps.valid[p] != 0 && maps.mean[p] > wells.firstLevelDn;
    maps.valid[p] = isFull ? 0 : maps.valid[p];
    pixels += isFull && (userMask.empty() || userMask[p] != 0) ? 1 : 0;
  }
  maps.summary.clipped += pixels;
  maps.summary.clippedHigh += pixels;
  DnRange &    dnRange = maps.summary.dnRange;
  const double step = dnRange.quantisationStepDn;
  dnRange.clipHighDn = step > 0.0 ? step * std::round(wells.levelDn / step) : wells.levelDn;
  dnRange.SetClipSources(dnRange.GetLowClipSource(), "full wells");
}

/** Sets to 0 what is 0 in \a userMask, which may be empty. */
void
ApplyMask(const std::vector<std::uint8_t> & userMask, std::vector<std::uint8_t> & map)
{
  for (std::size_t p = 0; p < userMask.size(); ++p)
  {
    map[p] = userMask[p] == 0 ? 0 : map[p];
  }
}

/** Sets the use of the pixels of the masked border, and of the pixels beside it, which have no centred difference. */
void
MarkBorder(StaticScene & scene)
{
  const FrameGeometry & geometry = scene.frame.geometry;
  const auto            widened = [](std::size_t lines) { return lines > 0 ? lines + StencilMargin : 0; };
  MaskedBorder          withMargin = scene.border;
  for (std::size_t * const side : { &withMargin.left, &withMargin.right, &withMargin.top, &withMargin.bottom })
  {
    *side = widened(*side);
  }
  for (std::size_t p = 0; p < scene.pixelUse.size() && !scene.border.strips.empty(); ++p)
  {
    const std::size_t x = p % geometry.width;
    const std::size_t y = p / geometry.width;
    if (withMargin.Holds(x, y, geometry) && scene.pixelUse[p] != static_cast<std::uint8_t>(PixelUse::Masked))
    {
      const bool isMasked = scene.border.Holds(x, y, geometry);
      scene.frame.usable[p] = 0;
      scene.pixelUse[p] = static_cast<std::uint8_t>(isMasked ? PixelUse::MaskedBorder : PixelUse::Border);
    }
  }
}

/** Excludes the region that a moving object crosses. Returns false if there is no moving object. */
bool
ExcludeTransientRegion(StaticScene & scene, const std::vector<CellVariance> & cellVariances)
{
  const std::vector<std::uint8_t> transient = FindTransientRegion(scene.frame, scene.model, cellVariances);
  for (std::size_t p = 0; p < transient.size(); ++p)
  {
    if (transient[p] != 0 && scene.frame.usable[p] != 0)
    {
      scene.frame.usable[p] = 0;
      scene.pixelUse[p] = static_cast<std::uint8_t>(PixelUse::NotStatic);
    }
  }
  return !transient.empty();
}
} // namespace

SceneAndOutliers
MakeStaticScene(StackMaps                         maps,
                const std::vector<std::uint8_t> & userMask,
                const FrameGeometry &             geometry,
                std::size_t                       frames,
                const std::vector<double> &       frameMeans,
                const std::vector<CellVariance> & cellVariances,
                std::optional<StrongChange>       strongChange,
                const ParallelFor &               parallelFor)
{
  std::vector<std::uint8_t> & valid = maps.valid;
  SceneAndOutliers            made;
  StaticScene &               scene = made.scene;
  scene.changesStrongly = strongChange.has_value();
  // Masked pixels have no influence on border and full wells, but may serve as neighbours.
  std::vector<std::uint8_t> withMasked = userMask.empty() ? std::vector<std::uint8_t>() : valid;
  ApplyMask(userMask, valid);
  scene.border = FindMaskedBorder(maps.mean, valid, geometry);
  LeaveOutBorder(valid, scene.border, geometry);
  scene.fullWells = FindFullWells(maps, geometry);
  if (!withMasked.empty())
  {
    valid = std::move(withMasked);
    LeaveOutBorder(valid, scene.border, geometry);
  }
  if (scene.fullWells)
  {
    LeaveOutFullWells(maps, *scene.fullWells, userMask);
  }
  scene.summary = maps.summary;
  scene.frame =
    MakeReferenceFrame(std::move(maps.mean), std::move(maps.variance), valid, geometry, frames, parallelFor);
  scene.pixelUse = FindPixelUse(scene.frame, valid, userMask, parallelFor);
  MarkBorder(scene);
  ApplyMask(userMask, valid);
  ApplyMask(userMask, scene.frame.usable);
  scene.valid = static_cast<std::size_t>(std::count(valid.begin(), valid.end(), std::uint8_t{ 1 }));
  try
  {
    RequireDistinctFrames(frames, valid);
    scene.model = FitInitialNoiseModel(scene.frame);
    if (ExcludeTransientRegion(scene, cellVariances))
    {
      scene.model = FitInitialNoiseModel(scene.frame);
    }
    // Under strong changes of the illumination the range of a pixel is known only roughly: in a flat field all pixels
    // or none are in the guard band.
    const DnRange         dnRange = scene.changesStrongly ? scene.summary.AttainedRange() : scene.summary.dnRange;
    std::optional<double> darkestNoiseDn2;
    if (strongChange)
    {
      darkestNoiseDn2 = strongChange->darkestNoiseDn2;
    }
    UsablePixels found = ExcludeCoarseAndGuarded(
      scene.frame, scene.model, dnRange, frameMeans, std::move(scene.pixelUse), parallelFor, darkestNoiseDn2);
    scene.frame.usable = std::move(found.usable);
    scene.pixelUse = std::move(found.pixelUse);
    scene.usable = found.count;
    scene.nearClip = found.nearClip;
    scene.coarse = found.coarse;
    RequireFineQuantization(found, scene.summary.dnRange.quantisationStepDn);
    made.outliers = FindOutlierPixels(scene.frame, scene.model, parallelFor);
  }
  catch (const NothingToMeasure & failureReason)
  {
    scene.failureReason = failureReason;
  }
  if (strongChange)
  {
    scene.frame.variance = std::move(strongChange->rawVariance);
  }
  return made;
}

} // namespace sensornoise
