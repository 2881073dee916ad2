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
  double              slope{ 0.0 };
  std::vector<double> offsetsDn;       ///< offsets of the parts, minus the centre [DN]
  double              offsetDn{ 0.0 }; ///< their mean over the pixels [DN]
  double              variance{ 0.0 }; ///< variance of this mean, in units of the variance of a response [DN^2]
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
  ParallelLines lines;
  lines.slope = product / contrast;
  double response = 0.0;
  for (const ResponseSums & part : parts)
  {
    const double fraction = part.pixels / pixels;
    lines.offsetsDn.push_back((part.line.x - part.line.y / lines.slope) / part.line.w);
    lines.offsetDn += fraction * lines.offsetsDn.back();
    lines.variance += fraction * fraction / part.line.w;
    response += fraction * part.line.y / part.line.w;
  }
  lines.variance = (lines.variance + std::pow(response / lines.slope, 2) / contrast) / (lines.slope * lines.slope);
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

/** Compares the offsets of the parts of \a partition. \a information is the squared norm of the flicker [1]. */
PartOffsets
CompareOffsets(Partition partition, const std::vector<ResponseSums> & cells, std::size_t across, double information)
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
      const double         offset = within->offsetsDn[*partOf[c]];
      chi2 +=
        information / cell.line.w * std::pow(cell.line.y - within->slope * (cell.line.x - offset * cell.line.w), 2);
      dof += 1.0;
    }
  }
  PartOffsets found;
  found.differenceDn = within->offsetDn - common->offsetDn;
  found.varianceDn2 =
    std::max(1.0, chi2 / std::max(1.0, dof)) * std::max(0.0, within->variance - common->variance) / information;
  return found;
}
} // namespace

PartOffsets
FindPartOffsets(const FrameSums & sums, const OffsetLine & line, const MotionSeries & motion, double gain)
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
  const std::vector<ResponseSums> cells = SumCells(sums, ofFlicker / information, gain, line.offset);
  PartOffsets                     largest;
  for (const Partition partition : { Partition::LeftRight, Partition::UpperLower, Partition::Quadrants })
  {
    const PartOffsets found = CompareOffsets(partition, cells, sums.CellsPerRow(), information);
    if (found.BeyondChanceDn(Significance.hint) > largest.BeyondChanceDn(Significance.hint))
    {
      largest = found;
    }
  }
  return largest;
}

double
PartOffsets::BeyondChanceDn(double z) const
{
  return varianceDn2 > 0.0 ? SizeBeyondChance(differenceDn, varianceDn2, z) : 0.0;
}

} // namespace sensornoise
