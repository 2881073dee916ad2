// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/GainByParts.h"

#include "base/Quantiles.h"
#include "pixels/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sensornoise
{

namespace
{
constexpr int FieldDegree = 4;

std::array<double, FieldDegree + 1>
Legendre(double place)
{
  const double                        u = 2.0 * place - 1.0;
  std::array<double, FieldDegree + 1> values{ 1.0, u };
  for (int n = 1; n < FieldDegree; ++n)
  {
    values[n + 1] = ((2 * n + 1) * u * values[n] - n * values[n - 1]) / (n + 1);
  }
  return values;
}

/** Returns the terms of every tile, which all rounds of a regression use. */
std::vector<PartRegression::Terms>
TermsOf(const std::vector<TileExcess> & tiles, const PartRegression & fit)
{
  std::vector<PartRegression::Terms> terms(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    fit.FillTerms(tiles[i], terms[i]);
  }
  return terms;
}

/** Returns the residuals in units of the sampling error [1]. */
std::vector<double>
ComputeResiduals(const std::vector<TileExcess> &            tiles,
                 const std::vector<PartRegression::Terms> & terms,
                 const Eigen::VectorXd &                    theta)
{
  std::vector<double> residuals;
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    double residual = tiles[i].excess;
    for (const auto & [column, value] : terms[i])
    {
      residual -= value * theta(column);
    }
    residuals.push_back(residual / tiles[i].error);
  }
  return residuals;
}

/** Returns the prior precision of the coefficients: weak, so that it matters only for coefficients that the tiles do
 * not determine. */
Eigen::VectorXd
PriorPrecision(const PartRegression & fit)
{
  const auto         knots = static_cast<Eigen::Index>(fit.knotsDn.size());
  const Eigen::Index step = fit.stepDn ? 1 : 0;
  Eigen::VectorXd    precision(fit.gains + fit.darks + knots + step);
  precision.head(fit.gains).setConstant(std::pow(InParts.priorOfParts, -2));
  precision.segment(fit.gains, fit.darks).setConstant(std::pow(InParts.priorOfParts, -2));
  precision.tail(knots + step).setConstant(std::pow(InParts.priorOfCurve, -2));
  return precision;
}

/** Solves one step of re-weighted least squares. The inverse of the normal equations becomes the covariance. */
void
Solve(const std::vector<TileExcess> &            tiles,
      const std::vector<PartRegression::Terms> & terms,
      const std::vector<double> &                weights,
      PartRegression &                           fit)
{
  Eigen::MatrixXd normal = PriorPrecision(fit).asDiagonal();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(normal.rows());
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    const double w = weights[i] / (tiles[i].error * tiles[i].error);
    if (w > 0.0)
    {
      for (const auto & [a, value] : terms[i])
      {
        right(a) += w * value * tiles[i].excess;
        for (const auto & [b, other] : terms[i])
        {
          normal(a, b) += w * value * other;
        }
      }
    }
  }
  const auto solver = normal.ldlt();
  fit.theta = solver.solve(right);
  fit.covariance = solver.solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
}

double
ScaleOf(const std::vector<double> & residuals)
{
  std::vector<double> sizes;
  std::transform(residuals.begin(), residuals.end(), std::back_inserter(sizes), [](double r) { return std::abs(r); });
  return std::max(1.0, Quantile(sizes, 0.5) / MedianOfNormal);
}

/** Minimizes absolute deviations first, which tolerates outliers in up to half of the tiles, then Tukey's bisquare. */
void
FitRobustly(const std::vector<TileExcess> & tiles, PartRegression & fit, std::size_t knots = InParts.knots)
{
  std::vector<double> levels;
  std::transform(
    tiles.begin(), tiles.end(), std::back_inserter(levels), [](const TileExcess & tile) { return tile.levelDn; });
  std::sort(levels.begin(), levels.end());
  for (std::size_t k = 0; k < knots; ++k)
  {
    const double knot = SortedQuantile(levels, static_cast<double>(k) / static_cast<double>(knots - 1));
    if (fit.knotsDn.empty() || knot > fit.knotsDn.back())
    {
      fit.knotsDn.push_back(knot);
    }
  }
  const auto          terms = TermsOf(tiles, fit);
  std::vector<double> weights(tiles.size(), 1.0);
  for (int round = 0; round < InParts.rounds; ++round)
  {
    Solve(tiles, terms, weights, fit);
    const std::vector<double> residuals = ComputeResiduals(tiles, terms, fit.theta);
    fit.scale = ScaleOf(residuals);
    const bool isLast = 2 * round >= InParts.rounds;
    std::transform(residuals.begin(), residuals.end(), weights.begin(), [&](double residual) {
      const double own = std::abs(residual) / fit.scale;
      const double near = std::max(0.0, 1.0 - std::pow(own / InParts.tukey, 2));
      return isLast ? near * near : 1.0 / std::max(1.0, own);
    });
  }
  Solve(tiles, terms, weights, fit);
  fit.covariance *= fit.scale * fit.scale;
  fit.isDetermined = fit.theta.allFinite() && fit.covariance.allFinite();
}
} // namespace

Eigen::VectorXd
PartRegression::FieldAt(double x, double y)
{
  const auto      ofX = Legendre(x);
  const auto      ofY = Legendre(y);
  Eigen::VectorXd values((FieldDegree + 1) * (FieldDegree + 2) / 2);
  Eigen::Index    k = 0;
  for (int degree = 0; degree <= FieldDegree; ++degree)
  {
    for (int j = 0; j <= degree; ++j)
    {
      values(k++) = ofX[degree - j] * ofY[j];
    }
  }
  return values;
}

Eigen::MatrixXd
PartRegression::ToParts(const std::vector<TileExcess> & tiles, Eigen::Index first, Eigen::Index count) const
{
  const auto      parts = static_cast<Eigen::Index>(KindOf(partition).parts);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(parts, theta.size());
  if (count == 1)
  {
    matrix.col(first).setOnes();
    return matrix;
  }
  if (!this->IsSmooth())
  {
    matrix.middleCols(first, parts).setIdentity();
    return matrix;
  }
  Eigen::VectorXd pixels = Eigen::VectorXd::Constant(parts, 1e-9);
  for (const TileExcess & tile : tiles)
  {
    const auto part = static_cast<Eigen::Index>(PartOf(partition, tile.x, tile.y, tile.phase));
    matrix.row(part).segment(first, count) += tile.pixels * FieldAt(tile.x, tile.y).transpose();
    pixels(part) += tile.pixels;
  }
  return pixels.cwiseInverse().asDiagonal() * matrix;
}

double
PartRegression::Criterion(const std::vector<TileExcess> & tiles, double common) const
{
  const double limit = InParts.tukey * InParts.tukey;
  double       loss = 0.0;
  for (const double residual : ComputeResiduals(tiles, TermsOf(tiles, *this), theta))
  {
    const double left = std::max(0.0, 1.0 - residual * residual / (common * common * limit));
    loss += limit / 3.0 * (1.0 - left * left * left);
  }
  const std::size_t ofStep = stepDn ? 2 : 0; // height and level of the step
  const std::size_t ofCurve = std::max(knotsDn.size(), InParts.knots) - InParts.knots;
  return loss + std::log(static_cast<double>(tiles.size())) * static_cast<double>(gains + darks + ofStep + ofCurve);
}

void
PartRegression::FillTerms(const TileExcess & tile, Terms & terms) const
{
  terms.clear();
  const Eigen::VectorXd field = this->IsSmooth() ? FieldAt(tile.x, tile.y) : Eigen::VectorXd();
  const auto            part = static_cast<Eigen::Index>(PartOf(partition, tile.x, tile.y, tile.phase));
  const auto            add = [&](Eigen::Index first, Eigen::Index count, double fraction) {
    if (count > 1 && this->IsSmooth())
    {
      for (Eigen::Index k = 0; k < count; ++k)
      {
        terms.emplace_back(first + k, fraction * field(k));
      }
    }
    else
    {
      terms.emplace_back(first + (count == 1 ? 0 : part), fraction);
    }
  };
  add(0, gains, tile.shotFraction);
  add(gains, darks, 1.0 - tile.shotFraction);
  if (stepDn && tile.levelDn > *stepDn)
  {
    terms.emplace_back(gains + darks + static_cast<Eigen::Index>(knotsDn.size()), 1.0);
  }
  // The curve is linear between its knots.
  const std::size_t last = knotsDn.size() - 1;
  std::size_t       k = 0;
  while (k < last && tile.levelDn > knotsDn[k + 1])
  {
    ++k;
  }
  const Eigen::Index first = gains + darks;
  if (last == 0 || k == last)
  {
    terms.emplace_back(first + static_cast<Eigen::Index>(last), 1.0);
    return;
  }
  const double right = std::clamp((tile.levelDn - knotsDn[k]) / (knotsDn[k + 1] - knotsDn[k]), 0.0, 1.0);
  terms.emplace_back(first + static_cast<Eigen::Index>(k), 1.0 - right);
  terms.emplace_back(first + static_cast<Eigen::Index>(k) + 1, right);
}

PartRegression
FitParts(Partition partition, PartsDiffer differ, const std::vector<TileExcess> & tiles)
{
  PartRegression fit;
  fit.partition = partition;
  const auto parts =
    fit.IsSmooth() ? PartRegression::FieldAt(0.0, 0.0).size() : static_cast<Eigen::Index>(KindOf(partition).parts);
  fit.gains = differ == PartsDiffer::InTheDark ? 1 : parts;
  fit.darks = differ == PartsDiffer::InGain ? 1 : parts;
  FitRobustly(tiles, fit);
  return fit;
}

PartRegression
FitUniform(const std::vector<TileExcess> & tiles, std::optional<double> stepDn, std::size_t knots)
{
  PartRegression fit;
  fit.gains = fit.darks = 1;
  fit.stepDn = stepDn;
  FitRobustly(tiles, fit, knots);
  return fit;
}

} // namespace sensornoise
