// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedResults.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/RegressionSums.h"
#include "pixels/GainByParts.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"
#include "series/LocalIllumination.h"
#include "series/OffsetLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{
/** Sums over the pixels of a cell or part, with I, the mean minus the centre, and z, the response to the flicker: the
 * line z = k (I - mu), where mu is the dark offset minus the centre. */
struct ResponseSums
{
  double         pixels{ 0.0 };
  RegressionSums line; ///< z over I, without the noise that they share; the weight is one over the variance [1/DN^2]

  ResponseSums &
  operator+=(const ResponseSums & other)
  {
    pixels += other.pixels;
    line += other.line;
    return *this;
  }
};

/** Returns the sums of every cell. The series \a ofFlicker is orthogonal to the motion, and its product with the
 * flicker is 1 [1]. \a gain is the gain of the line [DN/e-], \a offset the offset minus the centre [DN]. */
std::vector<ResponseSums>
SumCells(const FrameSums & sums, const Eigen::VectorXd & ofFlicker, double gain, double offset)
{
  const double              frames = static_cast<double>(sums.GetFrame().frames);
  std::vector<ResponseSums> cells(sums.GetCells().size());
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    const FrameSums::Cell & of = sums.GetCells()[c];
    ResponseSums &          own = cells[c];
    own.pixels = static_cast<double>(of.pixels);
    own.line.w = of.sum[0];
    own.line.x = of.sum[1];
    // The mean has the noise V / T, and the covariance of the response with it is the shot noise g (I - mu) / T.
    own.line.xx = of.sumI[1] - own.pixels / frames;
    own.line.xy = -gain * (own.line.x - offset * own.line.w) / frames;
    for (Eigen::Index t = 0; t < ofFlicker.size(); ++t)
    {
      const auto & products = sums.GetCellSums(static_cast<std::size_t>(t), c);
      own.line.y += ofFlicker(t) * products[0];
      own.line.xy += ofFlicker(t) * products[1];
    }
  }
  return cells;
}

/** Lines of the parts, which have one slope k and an offset each. */
struct ParallelLines
{
  double          slope{ 0.0 };
  Eigen::VectorXd offsetsDn;  ///< offsets of the parts, minus the centre [DN]
  Eigen::VectorXd fractions;  ///< fraction of the pixels in each part [1]
  Eigen::MatrixXd covariance; ///< covariance of the offsets, in units of the variance of a response [DN^2]

  /** Returns the mean of the offsets over the pixels, minus the centre [DN]. */
  double
  OffsetDn() const
  {
    return fractions.dot(offsetsDn);
  }
  /** Returns the variance of this mean, in units of the variance of a response [DN^2]. */
  double
  Variance() const
  {
    return fractions.dot(covariance * fractions);
  }
};

/** Returns the lines. Null: the levels within the parts do not determine the slope. */
std::optional<ParallelLines>
FitParallelLines(const std::vector<ResponseSums> & parts)
{
  double pixels = 0.0;
  double contrast = 0.0;
  double product = 0.0;
  for (const ResponseSums & part : parts)
  {
    if (!(part.line.w > 0.0))
    {
      return std::nullopt;
    }
    pixels += part.pixels;
    contrast += part.line.Spread();
    product += part.line.Product();
  }
  if (!(contrast > 0.0) || !(product > 0.0))
  {
    return std::nullopt;
  }
  const auto    count = static_cast<Eigen::Index>(parts.size());
  ParallelLines lines;
  lines.slope = product / contrast;
  lines.offsetsDn.resize(count);
  lines.fractions.resize(count);
  lines.covariance.setZero(count, count);
  Eigen::VectorXd response(count);
  for (Eigen::Index k = 0; k < count; ++k)
  {
    const ResponseSums & part = parts[static_cast<std::size_t>(k)];
    lines.fractions(k) = part.pixels / pixels;
    lines.offsetsDn(k) = (part.line.x - part.line.y / lines.slope) / part.line.w;
    lines.covariance(k, k) = 1.0 / part.line.w;
    response(k) = part.line.y / part.line.w / lines.slope;
  }
  lines.covariance += response * response.transpose() / contrast;
  lines.covariance /= lines.slope * lines.slope;
  return lines;
}

/** Returns the part of a cell, which is none where the cell lies in several. */
std::optional<std::size_t>
PartOfCell(Partition partition, std::size_t c, std::size_t across, std::size_t down)
{
  const auto        column = static_cast<double>(c % across);
  const auto        row = static_cast<double>(c / across);
  const auto        x = [&](double beside) { return (column + beside) / static_cast<double>(across); };
  const auto        y = [&](double beside) { return (row + beside) / static_cast<double>(down); };
  constexpr double  inside = 1e-6;
  const std::size_t first = PartOf(partition, x(inside), y(inside), 0);
  return first == PartOf(partition, x(1.0 - inside), y(1.0 - inside), 0) ? std::optional<std::size_t>(first)
                                                                         : std::nullopt;
}

/** Sums over the pixels of each quadrant that determine the line of the variance: of the weight, and of its products
 * with the level above the line's pivot and with the square of it. */
using QuadrantSums = std::array<RegressionSums, 4>;

QuadrantSums
SumQuadrants(const ReferenceFrame & frame, const StaticVariance & variance, const ParallelFor & parallelFor)
{
  const VarianceLine & line = variance.line;
  const double         half = 0.5 * (static_cast<double>(frame.frames) - 1.0);
  const std::size_t    width = frame.geometry.width;
  const auto           s = SumOverBlocks<12>(variance.mask.size(), parallelFor, [&](std::size_t p, auto & sums) {
    if (variance.mask[p] != 0)
    {
      const double      expected = line.At(frame.neighbourMean[p]);
      const double      w = half / (expected * expected + half * line.noiseDispersionDn4);
      const double      x = frame.mean[p] - line.pivotDn;
      const std::size_t first =
        3 * PartOf(Partition::Quadrants,
                   (static_cast<double>(p % width) + 0.5) / static_cast<double>(width),
                   (static_cast<double>(p / width) + 0.5) / static_cast<double>(frame.geometry.height),
                   0);
      sums[first] += w;
      sums[first + 1] += w * x;
      sums[first + 2] += w * x * x;
    }
  });
  QuadrantSums         quadrants;
  for (std::size_t q = 0; q < quadrants.size(); ++q)
  {
    quadrants[q].w = s[3 * q];
    quadrants[q].x = s[3 * q + 1];
    quadrants[q].xx = s[3 * q + 2];
  }
  return quadrants;
}

/** Returns what an offset of 1 DN in each part adds to gain and intercept of \a line, whose sums are \a quadrants:
 * a row for the gain [1/e-] and a row for the intercept [DN]. The line takes all levels for signal. */
Eigen::MatrixXd
EffectOfOffsets(Partition partition, const QuadrantSums & quadrants, const VarianceLine & line)
{
  RegressionSums all;
  for (const RegressionSums & quadrant : quadrants)
  {
    all += quadrant;
  }
  Eigen::MatrixXd effect = Eigen::MatrixXd::Zero(2, static_cast<Eigen::Index>(KindOf(partition).parts));
  for (std::size_t q = 0; q < quadrants.size() && all.Spread() > 0.0; ++q)
  {
    const double x = q % 2 == 0 ? 0.25 : 0.75;
    const double y = q / 2 == 0 ? 0.25 : 0.75;
    const double slope = (quadrants[q].x - all.x / all.w * quadrants[q].w) / all.Spread();
    const double atPivot = (quadrants[q].w - slope * all.x) / all.w;
    effect.col(static_cast<Eigen::Index>(PartOf(partition, x, y, 0))) -=
      line.gain * Eigen::Vector2d(slope, atPivot - slope * line.pivotDn);
  }
  return effect;
}

/** Compares the offsets of the parts of \a partition. \a effects is the result of EffectOfOffsets(). \a information is
 * the squared norm of the flicker [1]. */
PartOffsets
CompareOffsets(Partition                         partition,
               const std::vector<ResponseSums> & cells,
               std::size_t                       across,
               const Eigen::MatrixXd &           effects,
               double                            information)
{
  std::vector<ResponseSums>               parts(KindOf(partition).parts);
  std::vector<std::optional<std::size_t>> partOf;
  ResponseSums                            whole;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    partOf.push_back(cells[c].line.w > 0.0 ? PartOfCell(partition, c, across, cells.size() / across) : std::nullopt);
    if (partOf.back())
    {
      parts[*partOf.back()] += cells[c];
      whole += cells[c];
    }
  }
  const auto within = FitParallelLines(parts);
  const auto common = FitParallelLines({ whole });
  if (!within || !common)
  {
    return {};
  }
  double chi2 = 0.0;
  double dof = -1.0 - static_cast<double>(parts.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    if (partOf[c])
    {
      const ResponseSums & cell = cells[c];
      const double         offset = within->offsetsDn(static_cast<Eigen::Index>(*partOf[c]));
      chi2 +=
        information / cell.line.w * std::pow(cell.line.y - within->slope * (cell.line.x - offset * cell.line.w), 2);
      dof += 1.0;
    }
  }
  const double perResponse = std::max(1.0, chi2 / std::max(1.0, dof)) / information;
  PartOffsets  found;
  found.differenceDn = within->OffsetDn() - common->OffsetDn();
  found.varianceDn2 = perResponse * std::max(0.0, within->Variance() - common->Variance());
  const Eigen::MatrixXd toLine = effects - effects.rowwise().sum() * within->fractions.transpose();
  const Eigen::Vector2d ofLine = toLine * within->offsetsDn;
  const Eigen::Matrix2d chance = perResponse * toLine * within->covariance * toLine.transpose();
  for (const Eigen::Index k : { 0, 1 })
  {
    found.ofLine(k) = std::copysign(SizeBeyondChance(ofLine(k), chance(k, k), Significance.hint), ofLine(k));
  }
  return found;
}
} // namespace

PartOffsets
FindPartOffsets(const FrameSums &      sums,
                const OffsetLine &     line,
                const MotionSeries &   motion,
                const StaticVariance & variance,
                const ParallelFor &    parallelFor)
{
  const auto frames = static_cast<Eigen::Index>(line.gamma.size());
  if (!line.DeterminesOffset() || sums.GetCells().empty() || frames < 3)
  {
    return {};
  }
  const Eigen::Map<const Eigen::VectorXd> gamma(line.gamma.data(), frames);
  const Eigen::MatrixXd                   motions = Orthonormalise(motion.coefficients, frames - 2);
  Eigen::VectorXd                         ofFlicker = gamma.array() - gamma.mean();
  ofFlicker -= motions * (motions.transpose() * ofFlicker);
  const double information = ofFlicker.squaredNorm();
  if (!(information > 0.0))
  {
    return {};
  }
  const std::vector<ResponseSums> cells = SumCells(sums, ofFlicker / information, variance.line.gain, line.offset);
  const QuadrantSums              quadrants = SumQuadrants(sums.GetFrame(), variance, parallelFor);
  const Eigen::Matrix2d           inverse = variance.line.covariance.inverse();
  PartOffsets                     largest;
  Eigen::Vector2d                 ofLine = Eigen::Vector2d::Zero(); // the largest, in units of the error of the line
  for (const Partition partition : { Partition::LeftRight, Partition::UpperLower, Partition::Quadrants })
  {
    const Eigen::MatrixXd effects = EffectOfOffsets(partition, quadrants, variance.line);
    const PartOffsets     found = CompareOffsets(partition, cells, sums.CellsPerRow(), effects, information);
    if (found.ofLine.dot(inverse * found.ofLine) > ofLine.dot(inverse * ofLine))
    {
      ofLine = found.ofLine;
    }
    if (found.BeyondChanceDn(Significance.hint) > largest.BeyondChanceDn(Significance.hint))
    {
      largest = found;
    }
  }
  largest.ofLine = ofLine;
  return largest;
}

double
PartOffsets::BeyondChanceDn(double z) const
{
  return varianceDn2 > 0.0 ? SizeBeyondChance(differenceDn, varianceDn2, z) : 0.0;
}

} // namespace sensornoise
