// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/LocalIllumination.h"

#include "base/Constants.h"
#include "base/Quantiles.h"
#include "series/Constants.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sensornoise
{

namespace
{
/** The cells that are used, and for each the inverse variance of the illumination of one frame, v' G v with v =
 * (-offset, 1). */
struct UsedCells
{
  std::vector<std::size_t> cells;
  std::vector<double>      precision;
  std::vector<double>      signal; ///< mean signal of the cell [DN]

  Eigen::Index
  Count() const
  {
    return static_cast<Eigen::Index>(cells.size());
  }
};

UsedCells
FindUsedCells(const FrameSums & sums, double offset)
{
  const auto & cells = sums.GetCells();
  double       pixels = 0.0;
  for (const FrameSums::Cell & cell : cells)
  {
    pixels += static_cast<double>(cell.pixels) / static_cast<double>(cells.size());
  }
  UsedCells used;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    const double p = cells[c].sumI[1] - 2.0 * offset * cells[c].sum[1] + offset * offset * cells[c].sum[0];
    if (static_cast<double>(cells[c].pixels) >
          std::max(InSeries.fewestPixelsOfCell, InCommon.leastCoveredFraction * pixels) &&
        p > 0.0)
    {
      used.cells.push_back(c);
      used.precision.push_back(p);
      const double weighted = cells[c].sum[1] - offset * cells[c].sum[0];
      used.signal.push_back(weighted > 0.0 ? p / weighted : 0.0);
    }
  }
  return used;
}

/** Returns the residuals of the signal of the cells after global flicker and motion, frames x cells, in units of their
 * noise. */
Eigen::MatrixXd
RestOfCells(const FrameSums &           sums,
            const UsedCells &           used,
            const MotionSeries &        motion,
            const std::vector<double> & gamma,
            double                      offset)
{
  const auto      frames = static_cast<Eigen::Index>(sums.GetFrame().frames);
  Eigen::MatrixXd whole(frames, used.Count());
  for (Eigen::Index i = 0; i < used.Count(); ++i)
  {
    const std::size_t       c = used.cells[static_cast<std::size_t>(i)];
    const FrameSums::Cell & cell = sums.GetCells()[c];
    const double            p = used.precision[static_cast<std::size_t>(i)];
    for (Eigen::Index t = 0; t < frames; ++t)
    {
      const auto & sum = sums.GetCellSums(static_cast<std::size_t>(t), c);
      double       response = sum[1] - offset * sum[0] - gamma[static_cast<std::size_t>(t)] * p;
      for (std::size_t k = 0; k < motion.stencils.size(); ++k)
      {
        const std::size_t stencil = motion.stencils[k];
        response -= motion.coefficients(t, static_cast<Eigen::Index>(k)) *
                    (cell.sumI[2 + stencil] - offset * cell.sum[2 + stencil]);
      }
      whole(t, i) = response / std::sqrt(p);
    }
  }
  return whole;
}

/** Scales each cell by its typical size, if that is above the median of the cells: a single noisy cell must not make a
 * factor. \a rest is \a whole without the part that resembles flicker and motion. */
void
ScaleCells(Eigen::MatrixXd & rest, Eigen::MatrixXd & whole)
{
  const Eigen::Index  frames = rest.rows();
  const Eigen::Index  count = rest.cols();
  std::vector<double> sizes(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < count; ++i)
  {
    std::vector<double> squares(static_cast<std::size_t>(frames));
    for (Eigen::Index t = 0; t < frames; ++t)
    {
      squares[static_cast<std::size_t>(t)] = rest(t, i) * rest(t, i);
    }
    sizes[static_cast<std::size_t>(i)] = std::sqrt(std::max(1e-30, Quantile(squares, 0.5) / 0.455));
  }
  const double typical = QuantileOf(sizes, 0.5);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const double size = std::max(sizes[static_cast<std::size_t>(i)], typical);
    rest.col(i) /= size;
    whole.col(i) /= size;
  }
}

/** The eigenvalues of the products of the series of the cells, the largest first, and the edge of the eigenvalues of
 * noise (Marchenko and Pastur), from their median. */
struct Eigenvalues
{
  std::vector<double> values;
  double              noise{ 0.0 };
  double              edge{ 0.0 };

  Eigenvalues(const Eigen::VectorXd & rising, Eigen::Index dof, Eigen::Index count)
  {
    const auto shorter = std::min(dof, count);
    const auto longer = static_cast<double>(std::max(dof, count));
    for (Eigen::Index i = 0; i < shorter; ++i)
    {
      values.push_back(rising(rising.size() - 1 - i));
    }
    const double ratio = static_cast<double>(shorter) / longer;
    noise = QuantileOf(values, 0.5) / (MedianNoiseEigenvalue(ratio) * longer);
    edge = InSeries.edgeOfNoise * noise * std::pow(std::sqrt(static_cast<double>(shorter)) + std::sqrt(longer), 2);
  }
};

/** Returns the Gram matrix of the shorter side of \a rest. */
Eigen::MatrixXd
GramOf(const Eigen::MatrixXd & rest)
{
  return rest.rows() > rest.cols() ? Eigen::MatrixXd(rest.transpose() * rest)
                                   : Eigen::MatrixXd(rest * rest.transpose());
}

/** Returns whether several frames have a factor in common: an eigenvalue is still above the edge after much noisier
 * frames are scaled to a typical size. A few frames of another gain exceed the edge by the size of their noise alone,
 * but have no factor in common. */
bool
HaveFramesCommonFactors(Eigen::MatrixXd rest, Eigen::Index dof)
{
  std::vector<double> sizes(static_cast<std::size_t>(rest.rows()));
  for (Eigen::Index t = 0; t < rest.rows(); ++t)
  {
    const Eigen::VectorXd squares = rest.row(t).cwiseAbs2().transpose();
    sizes[static_cast<std::size_t>(t)] =
      std::sqrt(QuantileOf(std::vector<double>(squares.data(), squares.data() + squares.size()), 0.5));
  }
  const double typical = QuantileOf(sizes, 0.5);
  for (Eigen::Index t = 0; t < rest.rows(); ++t)
  {
    const double size = sizes[static_cast<std::size_t>(t)];
    rest.row(t) *= size > InSeries.noisyFrame * typical ? typical / size : 1.0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(GramOf(rest), Eigen::EigenvaluesOnly);
  const Eigenvalues                                    found(eigen.eigenvalues(), dof, rest.cols());
  return found.values.front() > found.edge;
}

/** Finds the factors of \a rest above the edge of the noise, at most \a most; \a dof is the degrees of freedom of
 * \a rest over the frames. */
LocalIllumination
FindFactors(const Eigen::MatrixXd & rest, const Eigen::MatrixXd & whole, Eigen::Index dof, std::size_t most)
{
  const Eigen::Index                                   frames = rest.rows();
  const bool                                           isTall = frames > rest.cols();
  const Eigen::MatrixXd                                gram = GramOf(rest);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
  const auto [values, noise, edge] = Eigenvalues(eigen.eigenvalues(), dof, rest.cols());

  LocalIllumination found;
  found.excess = values.front() / edge;
  Eigen::Index factors = 0;
  while (factors < static_cast<Eigen::Index>(std::min(values.size(), most)) &&
         values[static_cast<std::size_t>(factors)] > edge)
  {
    ++factors;
  }
  if (values.front() > edge && !HaveFramesCommonFactors(rest, dof))
  {
    factors = 0;
  }
  else if (static_cast<std::size_t>(factors) < values.size())
  {
    const double next = values[static_cast<std::size_t>(factors)] / edge;
    found.beyond = next > 1.0 ? next : 0.0;
  }
  found.series.resize(frames, factors);
  for (Eigen::Index j = 0; j < factors; ++j)
  {
    const Eigen::VectorXd vector = eigen.eigenvectors().col(gram.rows() - 1 - j);
    // Projects all series of the cells, including the part that resembles motion, onto the spatial pattern of the
    // factor.
    found.series.col(j) = whole * (isTall ? vector : Eigen::VectorXd(rest.transpose() * vector));
  }
  return found;
}

/** Finds factors like FindFactors(), for cells whose noise differs from frame to frame. The factors are found one by
 * one, the strongest first: each is free in the next estimate of the noise, and is projected out of each cell before
 * the next search. Weights differ from cell to cell, so that the residuals of one factor form more than one. */
LocalIllumination
FindFactorsOfUnequalFrames(const Eigen::MatrixXd & whole,
                           const Eigen::MatrixXd & basis,
                           const Eigen::VectorXd & gamma,
                           const Eigen::VectorXd & signal,
                           std::size_t             most)
{
  const Eigen::Index frames = whole.rows();
  const Eigen::Index largest = frames - 1 - InSeries.leastDofOfCells;
  Eigen::MatrixXd    columns = basis;
  LocalIllumination  found;
  found.series.resize(frames, 0);
  while (columns.cols() <= largest)
  {
    const bool      isLast = found.series.cols() == static_cast<Eigen::Index>(most); // only to test against the edge
    Eigen::MatrixXd scaled = whole;
    Eigen::MatrixXd rest =
      WhitenedResiduals(whole, columns, gamma, EstimateShotFractions(whole, columns, gamma, signal));
    ScaleCells(rest, scaled);
    const LocalIllumination next = FindFactors(rest, scaled, frames - 1 - columns.cols(), isLast ? 0 : 1);
    found.beyond = isLast ? next.beyond : 0.0;
    found.excess = std::max(found.excess, next.excess);
    if (isLast || next.series.cols() == 0)
    {
      break;
    }
    found.series.conservativeResize(Eigen::NoChange, found.series.cols() + 1);
    found.series.rightCols(1) = next.series;
    Eigen::MatrixXd all(frames, basis.cols() + found.series.cols());
    all << basis, found.series;
    columns = Orthonormalise(all, frames);
  }
  return found;
}

/** Returns the dispersion of the size of the global flicker over the cells. The size of a cell, in units of its noise,
 * is compared with a line in the signal that is common to all cells: an offset that is not known makes no difference.
 * \a rest is \a whole without flicker and motion, and determines the noise. */
Unevenness
MeasureUnevenness(const Eigen::MatrixXd & whole,
                  const Eigen::MatrixXd & rest,
                  const UsedCells &       used,
                  const Eigen::VectorXd & gamma,
                  Eigen::Index            dof)
{
  const Eigen::VectorXd flicker = gamma.array() - gamma.mean();
  const double          energy = flicker.squaredNorm();
  const Eigen::Index    count = used.Count();
  if (!(energy > 0.0))
  {
    return {};
  }
  Eigen::VectorXd size = whole.transpose() * flicker / std::sqrt(energy);
  Eigen::MatrixXd line(count, 2); // the signal, and a change of the level of all pixels
  double          precision = 0.0;
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const auto   cell = static_cast<std::size_t>(i);
    const double root = std::sqrt(used.precision[cell]);
    line.row(i) << root, used.signal[cell] > 0.0 ? root / used.signal[cell] : 0.0;
    precision += used.precision[cell];
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(line);
  const Eigen::MatrixXd                             columns =
    Eigen::MatrixXd(fit.householderQ() * Eigen::MatrixXd::Identity(count, 2)).leftCols(fit.rank());
  size -= columns * (columns.transpose() * size);
  // Each cell has its own noise: in a dark scene, the initial model may be wrong by a factor in the bright cells.
  const Eigen::VectorXd noise = rest.colwise().squaredNorm().transpose() / static_cast<double>(dof);
  const Eigen::VectorXd left = Eigen::VectorXd::Ones(count) - columns.rowwise().squaredNorm(); // 1 - leverage
  const double          excess = size.squaredNorm() - left.dot(noise);
  const double          variance = 2.0 * (1.0 + 1.0 / static_cast<double>(dof)) * left.dot(noise.cwiseAbs2());
  return { std::sqrt(std::max(0.0, excess) / (precision * energy)), excess / std::sqrt(variance) };
}
} // namespace

Eigen::MatrixXd
Orthonormalise(const Eigen::MatrixXd & columns, Eigen::Index most)
{
  Eigen::MatrixXd basis(columns.rows(), columns.cols());
  Eigen::Index    count = 0;
  for (Eigen::Index j = 0; j < columns.cols() && count < most; ++j)
  {
    Eigen::VectorXd column = columns.col(j);
    const double    before = column.norm();
    for (int twice = 0; twice < 2; ++twice)
    {
      column.array() -= column.mean();
      for (Eigen::Index i = 0; i < count; ++i)
      {
        column -= basis.col(i).dot(column) * basis.col(i);
      }
    }
    const double after = column.norm();
    if (after > 1e-6 * before && before > 0.0)
    {
      basis.col(count++) = column / after;
    }
  }
  return basis.leftCols(count);
}

double
MedianNoiseEigenvalue(double ratio)
{
  const double        low = std::pow(1.0 - std::sqrt(ratio), 2);
  const double        high = std::pow(1.0 + std::sqrt(ratio), 2);
  constexpr int       steps = 2000;
  std::vector<double> cumulative(steps + 1, 0.0);
  const auto at = [&](int i) { return low + (high - low) * 0.5 * (1.0 - std::cos(3.14159265358979 * i / steps)); };
  for (int i = 0; i < steps; ++i)
  {
    const double middle = 0.5 * (at(i) + at(i + 1));
    cumulative[static_cast<std::size_t>(i + 1)] =
      cumulative[static_cast<std::size_t>(i)] +
      std::sqrt(std::max(0.0, (high - middle) * (middle - low))) / middle * (at(i + 1) - at(i));
  }
  const auto half = std::lower_bound(cumulative.begin(), cumulative.end(), 0.5 * cumulative.back());
  return at(static_cast<int>(half - cumulative.begin()));
}

LocalIllumination
FindLocalIllumination(const FrameSums &           sums,
                      const MotionSeries &        motion,
                      const Eigen::MatrixXd &     motionColumns,
                      const std::vector<double> & gamma,
                      double                      offset,
                      std::size_t                 most)
{
  const auto        frames = static_cast<Eigen::Index>(sums.GetFrame().frames);
  LocalIllumination none;
  none.series.resize(frames, 0);
  const UsedCells used = FindUsedCells(sums, offset);
  if (used.Count() < 8 || most == 0)
  {
    return none;
  }
  Eigen::MatrixXd whole = RestOfCells(sums, used, motion, gamma, offset);
  Eigen::MatrixXd known(frames, 1 + motionColumns.cols());
  known.col(0) = Eigen::Map<const Eigen::VectorXd>(gamma.data(), frames);
  known.rightCols(motionColumns.cols()) = motionColumns;
  const Eigen::MatrixXd basis = Orthonormalise(known, frames);
  const Eigen::Index    dof = frames - 1 - basis.cols();
  if (dof < InSeries.leastDofOfCells)
  {
    return none;
  }
  const Eigen::Map<const Eigen::VectorXd> illumination(gamma.data(), frames);
  Eigen::MatrixXd                         rest = whole.rowwise() - whole.colwise().mean();
  rest -= basis * (basis.transpose() * rest);
  const Unevenness  unevenness = MeasureUnevenness(whole, rest, used, illumination, dof);
  LocalIllumination found;
  if (illumination.cwiseAbs().maxCoeff() > InSeries.equalFrameNoise)
  {
    const Eigen::Map<const Eigen::VectorXd> signal(used.signal.data(), used.Count());
    found = FindFactorsOfUnequalFrames(whole, basis, illumination, signal, most);
  }
  else
  {
    ScaleCells(rest, whole);
    found = FindFactors(rest, whole, dof, most);
  }
  found.unevenness = unevenness;
  return found;
}

} // namespace sensornoise
