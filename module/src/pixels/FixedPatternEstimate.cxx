// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/FixedPatternEstimate.h"

#include "base/Simd.h"
#include "base/Eigen.h"
#include "base/Constants.h"
#include "base/Quantiles.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/VarianceFit.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Variance of a pixel minus its diagonal mean, relative to the variance of a pixel [1]. */
constexpr double DifferenceVariance = 1.125;

/** Sums over the differences from their diagonal means of every second pixel of a tile, as on a chequerboard. */
struct HalfTile
{
  double pixels{ 0.0 };  // number of pixels
  double level{ 0.0 };   // sum of the levels; after MakeSquares() their mean [DN]
  double squares{ 0.0 }; // sum of the squared differences [DN^2]
  double noise{ 0.0 };   // expectation of squares by the noise of the means [DN^2]

  double
  Pattern() const
  {
    return (squares - noise) / (DifferenceVariance * pixels);
  }
  /** Standard error of Pattern(). */
  double
  Error() const
  {
    return std::sqrt(2.0 / pixels) * squares / (DifferenceVariance * pixels);
  }
};

struct Square
{
  HalfTile
    half[2]; // one selects tiles, the other measures them: a value selected for being small is small by chance, too

  /** Returns an upper limit of the pattern's variance, by the half that selects [DN^2]. */
  double
  Roughness(std::size_t chooser) const
  {
    return half[chooser].Pattern() + Significance.hint * half[chooser].Error();
  }
  /** Returns Roughness() relative to the square of the signal [1]. */
  double
  RelativeRoughness(std::size_t chooser, double blackDn) const
  {
    const double signalDn = half[chooser].level - blackDn;
    return this->Roughness(chooser) / std::max(smallestDivisor, signalDn * signalDn);
  }
};

/** Squared differences of a row of pixels from their diagonal means [DN^2], and whether the diagonal pixels are all
 * usable. Computed with SIMD instructions; the sums over the row are not. */
struct PatternRow
{
  double       square[InPixels.tileSide]{};
  std::uint8_t counts[InPixels.tileSide]{};

  void
  Compare(const ReferenceFrame & frame, const std::uint8_t * mask, std::size_t first, std::size_t pixels)
  {
    const std::size_t          width = frame.geometry.width;
    const double * const       mean = frame.mean.data();
    const std::uint8_t * const usable = frame.usable.data();
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const double difference = mean[first + i] - DiagonalMean(mean, width, first + i);
      square[i] = difference * difference;
    }
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const std::uint8_t isUsable = HasDiagonals(usable, width, first + i) ? 1 : 0;
      counts[i] = std::min(mask[first + i], isUsable);
    }
  }
};

void
SumPatternTile(const ReferenceFrame & frame,
               const VarianceData &   data,
               std::size_t            left,
               std::size_t            top,
               std::size_t            side,
               Square &               square)
{
  const auto frames = static_cast<double>(frame.frames);
  const auto before = [side](std::size_t first, std::size_t size) {
    return std::min(first + side, size - std::min(size, DiagonalReach));
  };
  PatternRow        row;
  const std::size_t begin = std::max(left, DiagonalReach); // pixels nearer to the border are not used
  const std::size_t end = std::max(begin, before(left, frame.geometry.width));
  for (std::size_t y = std::max(top, DiagonalReach); y < before(top, frame.geometry.height); ++y)
  {
    row.Compare(frame, data.mask, y * frame.geometry.width + begin, end - begin);
    for (std::size_t x = begin; x < end; ++x)
    {
      if (row.counts[x - begin] != 0)
      {
        // Diagonal neighbours are in the same half, so the halves have no pixel in common.
        const std::size_t p = y * frame.geometry.width + x;
        HalfTile &        half = square.half[(x + y) % 2];
        half.pixels += 1.0;
        half.level += frame.mean[p];
        half.squares += row.square[x - begin];
        half.noise += DifferenceVariance * data.variance[p] / frames;
      }
    }
  }
  for (HalfTile & half : square.half)
  {
    half.level /= std::max(1.0, half.pixels);
  }
}

std::vector<Square>
MakeSquares(const ReferenceFrame & frame, const VarianceData & data, const ParallelFor & parallelFor)
{
  const std::size_t side =
    frame.geometry.Pixels() < InPattern.largeFramePixels ? InPattern.smallTileSide : InPixels.tileSide;
  const std::size_t   across = (frame.geometry.width + side - 1) / side;
  const std::size_t   down = (frame.geometry.height + side - 1) / side;
  std::vector<Square> squares(across * down);
  parallelFor(down, [&](std::size_t row) {
    CallWithAvx2([&] {
      for (std::size_t column = 0; column < across; ++column)
      {
        SumPatternTile(frame, data, column * side, row * side, side, squares[row * across + column]);
      }
    });
  });
  squares.erase(std::remove_if(squares.begin(),
                               squares.end(),
                               [](const Square & square) {
                                 return square.half[0].pixels < InPattern.leastHalfPixels ||
                                        square.half[1].pixels < InPattern.leastHalfPixels;
                               }),
                squares.end());
  return squares;
}

/** Returns the \a count tiles of the smallest \a value, in rising order. */
template <typename TValue>
std::vector<const Square *>
SmallestTiles(const std::vector<Square> & squares, std::size_t count, TValue value)
{
  std::vector<std::pair<double, const Square *>> sorted(squares.size());
  std::transform(squares.begin(), squares.end(), sorted.begin(), [&](const Square & square) {
    return std::make_pair(value(square), &square);
  });
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(count);
  std::partial_sort(sorted.begin(), end, sorted.end());
  std::vector<const Square *> smallest(count);
  std::transform(sorted.begin(), end, smallest.begin(), [](const auto & entry) { return entry.second; });
  return smallest;
}

/** Returns the weighted mean of \a value over tiles, at least 0, plus its standard error. */
template <typename TValue, typename TError>
double
UpperMean(const std::vector<const Square *> & squares, TValue value, TError error)
{
  double weight = 0.0;
  double sum = 0.0;
  for (const Square * square : squares)
  {
    const double w = 1.0 / std::max(1e-300, error(*square) * error(*square));
    weight += w;
    sum += w * value(*square);
  }
  return std::max(0.0, sum / weight) + 1.0 / std::sqrt(weight);
}
} // namespace

FixedPatternEstimate
EstimateFixedPattern(const ReferenceFrame & frame,
                     const VarianceData &   data,
                     const VarianceLine &   line,
                     double                 blackDn,
                     const ParallelFor &    parallelFor)
{
  const double              noiseDn2 = line.At(line.pivotDn) / static_cast<double>(frame.frames);
  const double              fluxDn = line.pivotDn - blackDn;
  FixedPatternEstimate      pattern;
  const std::vector<Square> squares = MakeSquares(frame, data, parallelFor);
  pattern.levelVarianceDn2 = std::max(0.0, line.spreadDn2 / line.weightSum - noiseDn2);
  if (squares.empty() || !(pattern.levelVarianceDn2 > 0.0))
  {
    pattern.gainFraction = pattern.offsetFraction = std::numeric_limits<double>::infinity();
    return pattern;
  }
  const auto count =
    std::min(squares.size(),
             std::max(InPattern.fewestPatternTiles,
                      static_cast<std::size_t>(InPattern.flattestFraction * static_cast<double>(squares.size()))));
  // Tiles at the black level do not determine the pattern of the gain. A guard against division by 0.
  constexpr double leastSignal = 1e-6; // relative to the standard deviation of the levels
  const double     leastDn = leastSignal * std::sqrt(pattern.levelVarianceDn2);
  // Each half measures once, so that a mirrored frame has the same pattern.
  double gainSquare = 0.0;
  double offsetSquareDn2 = 0.0;
  for (const std::size_t chooser : { 0, 1 })
  {
    const auto   measured = [&](const Square & square) -> const HalfTile & { return square.half[1 - chooser]; };
    const auto   fluxOf = [&](const Square & square) { return std::max(leastDn, measured(square).level - blackDn); };
    const auto   relative = [&](const Square & square) { return square.RelativeRoughness(chooser, blackDn); };
    const auto   roughness = [&](const Square & square) { return square.Roughness(chooser); };
    const double gain = UpperMean(
      SmallestTiles(squares, count, relative),
      [&](const Square & square) { return measured(square).Pattern() / (fluxOf(square) * fluxOf(square)); },
      [&](const Square & square) { return measured(square).Error() / (fluxOf(square) * fluxOf(square)); });
    gainSquare += 0.5 * std::min(gain, InPattern.largestGain * InPattern.largestGain);
    const auto   smoothest = SmallestTiles(squares, count, roughness);
    const double offsetDn2 = UpperMean(
      smoothest,
      [&](const Square & square) { return measured(square).Pattern(); },
      [&](const Square & square) { return measured(square).Error(); });
    const double largestDn2 =
      InPattern.largestOffset * InPattern.largestOffset * line.At(measured(*smoothest.front()).level);
    offsetSquareDn2 += 0.5 * std::min(offsetDn2, largestDn2);
  }
  pattern.gainFraction = gainSquare * (fluxDn * fluxDn + pattern.levelVarianceDn2) / pattern.levelVarianceDn2;
  pattern.offsetFraction = offsetSquareDn2 / pattern.levelVarianceDn2;
  return pattern;
}

InstrumentalFit
FitInstrumental(const VarianceFit & fit, const VarianceData & data, const ReferenceFrame & frame)
{
  // Sums of the weight times x and v, the mean and the variance above the line at its pivot, and z, the mean of the
  // diagonal neighbours.
  enum : std::size_t
  {
    W,
    WX,
    WZ,
    WV,
    WZX,
    WZV,
    Sums
  };
  InstrumentalFit found{ fit.GetLine() };
  VarianceLine &  instrumental = found.line;
  const double    pivot = instrumental.pivotDn;
  const auto      diagonalOf = [&](std::size_t p) {
    return DiagonalMean(frame.mean.data(), frame.geometry.width, p) - pivot;
  };
  const auto   s = fit.SumWeighed<Sums>([&](std::size_t p, const VarianceFit::Weighed & weighed, auto & sums) {
    if (HasDiagonals(frame.usable.data(), frame.geometry.width, p))
    {
      const auto [w, value] = weighed;
      const double x = data.mean[p] - pivot;
      const double z = diagonalOf(p);
      sums[W] += w;
      sums[WX] += w * x;
      sums[WZ] += w * z;
      sums[WV] += w * value;
      sums[WZX] += w * z * x;
      sums[WZV] += w * z * value;
    }
  });
  const double zMean = s[WZ] / s[W];
  const double common = s[WZX] - zMean * s[WX];
  instrumental.isDetermined = common > 0.0;
  if (!instrumental.isDetermined)
  {
    return found;
  }
  instrumental.gain = (s[WZV] - zMean * s[WV]) / common;
  instrumental.pivotDn = pivot + s[WX] / s[W];
  instrumental.intercept = s[WV] / s[W] - instrumental.gain * instrumental.pivotDn;
  // Sums of the squared scores, for the sandwich covariance; and of the squared products of x and z.
  const auto      squares = fit.SumWeighed<4>([&](std::size_t p, const VarianceFit::Weighed & weighed, auto & sums) {
    if (HasDiagonals(frame.usable.data(), frame.geometry.width, p))
    {
      const auto [w, value] = weighed;
      const double score = w * (value - instrumental.intercept - instrumental.gain * data.mean[p]);
      const double z = diagonalOf(p) - zMean;
      sums[0] += score * score * z * z;
      sums[1] += score * score * z;
      sums[2] += score * score;
      const double product = w * z * (data.mean[p] - instrumental.pivotDn);
      sums[3] += product * product;
    }
  });
  Eigen::Matrix2d atPivot;
  atPivot << squares[0] / (common * common), squares[1] / (common * s[W]), squares[1] / (common * s[W]),
    squares[2] / (s[W] * s[W]);
  Eigen::Matrix2d toIntercept;
  toIntercept << 1.0, 0.0, -instrumental.pivotDn, 1.0;
  instrumental.covariance = toIntercept * atPivot * toIntercept.transpose();
  // The mean of a ratio by a weak instrument does not exist: Staiger & Stock 1997 demand F > 10.
  instrumental.isDetermined = common * common > InCommon.strongEvidence * squares[3] &&
                              std::isfinite(instrumental.gain) && instrumental.covariance.allFinite();
  found.instrumentDn = pivot + zMean;
  found.squaredScores = squares[0];
  return found;
}

VarianceCurve
CurveByInstrument(const VarianceLine &   line,
                  const VarianceFit &    fit,
                  const VarianceData &   data,
                  const ReferenceFrame & frame)
{
  const std::size_t   width = frame.geometry.width;
  const auto          hasInstrument = [&](std::size_t p) { return HasDiagonals(frame.usable.data(), width, p); };
  const auto          instrumentOf = [&](std::size_t p) { return DiagonalMean(frame.mean.data(), width, p); };
  std::vector<double> levels;
  for (const std::size_t p : SamplePixels(data.mask, data.pixels))
  {
    if (hasInstrument(p))
    {
      levels.push_back(instrumentOf(p));
    }
  }
  const std::vector<double> edges = EdgesOfEqualCount(std::move(levels), VarianceCurve::Bins);
  const std::vector<double> sums = fit.SumWeighed(
    VarianceCurve::Bins * CurveBin::Sums, [&](std::size_t p, const VarianceFit::Weighed & weighed, double * all) {
      if (weighed.weight > 0.0 && hasInstrument(p))
      {
        double * own = all + CurveBin::Sums * BinOf(edges, instrumentOf(p));
        own[0] += 1.0;
        own[1] += weighed.weight;
        own[2] += weighed.weight * (data.mean[p] - line.pivotDn);
        own[3] += weighed.weight * (weighed.value - line.At(data.mean[p]));
      }
    });
  return VarianceCurve::Of(line, sums.data());
}

double
WideningOfInstrumental(const InstrumentalFit & instrumental,
                       const VarianceFit &     fit,
                       const VarianceData &    data,
                       const ReferenceFrame &  frame)
{
  const VarianceLine & line = instrumental.line;
  const std::size_t    width = frame.geometry.width;
  const std::size_t    lines = width + frame.geometry.height;
  const ScoreCells     cells(frame.geometry);
  const auto           alike =
    fit.SumWeighed(lines + cells.Count(), [&](std::size_t p, const VarianceFit::Weighed & weighed, double * sums) {
      if (HasDiagonals(frame.usable.data(), width, p))
      {
        const double residual = weighed.value - line.intercept - line.gain * data.mean[p];
        const double score =
          weighed.weight * residual * (DiagonalMean(frame.mean.data(), width, p) - instrumental.instrumentDn);
        sums[p % width] += score;
        sums[width + p / width] += score;
        sums[lines + cells.Of(p)] += score;
      }
    });
  const auto   squaresOf = [&](auto first, auto last) { return std::inner_product(first, last, first, 0.0); };
  const auto   middle = alike.begin() + static_cast<std::ptrdiff_t>(width);
  const auto   end = alike.begin() + static_cast<std::ptrdiff_t>(lines);
  const double most = std::max(squaresOf(alike.begin(), middle), squaresOf(middle, end));
  if (squaresOf(end, alike.end()) > most) // a pattern is alike within cells, too, but more so along its lines
  {
    return WideningOfExcess({ end, alike.end() }, instrumental.squaredScores);
  }
  return most > InPattern.leastLikeness * instrumental.squaredScores ? most / instrumental.squaredScores : 1.0;
}

VarianceLine
FindInstrumentalLine(const VarianceLine &                                      line,
                     const FixedPatternEstimate &                              pattern,
                     const VarianceFit &                                       fit,
                     const VarianceData &                                      data,
                     const ReferenceFrame &                                    frame,
                     const std::function<VarianceLine(const VarianceLine &)> & settle)
{
  const bool hasPattern =
    pattern.LargestFraction() * std::abs(line.gain) > InPixels.negligiblePattern * std::sqrt(line.covariance(0, 0));
  const auto mayReplace = [&](const VarianceLine & other) {
    return other.isDetermined && (hasPattern || DoContradict(line, other, 1.0));
  };
  InstrumentalFit fitted = FitInstrumental(fit, data, frame);
  VarianceLine    instrumental = settle(fitted.line);
  if (mayReplace(instrumental)) // wider errors make no contradiction
  {
    fitted.line.covariance *= WideningOfInstrumental(fitted, fit, data, frame);
    instrumental = settle(fitted.line);
  }
  instrumental.isDetermined = mayReplace(instrumental);
  return instrumental;
}

} // namespace sensornoise
