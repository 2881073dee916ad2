// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/PartGains.h"

#include "base/Constants.h"
#include "pixels/Constants.h"
#include "pixels/PartRegression.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the phase of a pixel in the pattern, see PartOf(). */
std::size_t
PhaseOf(std::size_t x, std::size_t y)
{
  return LargestPeriod * (y % LargestPeriod) + x % LargestPeriod;
}

/** Returns the fraction of the line's variance at a level that is shot noise [1]. */
double
ShotFractionAt(const PartReference & reference, double meanDn)
{
  const double expected = reference.line.At(meanDn);
  return expected > 0.0 ? std::clamp(reference.line.gain * (meanDn - reference.blackDn) / expected, 0.0, 1.0) : 0.0;
}
} // namespace

double
PartGains::RatioAt(double x, double y, std::size_t phase, double shotFraction) const
{
  const std::size_t part = PartOf(partition, x, y, phase);
  const auto        at = [&](const Eigen::VectorXd & smooth, const std::vector<double> & ofParts) {
    return smooth.size() > 0 ? PartRegression::FieldAt(x, y).dot(smooth) : ofParts[part];
  };
  return std::max(InCommon.leastVarianceRatio,
                  1.0 + shotFraction * at(field, excess) + (1.0 - shotFraction) * at(darkField, dark));
}

Eigen::VectorXd
PartGains::DarkDerivativesAt(double x, double y, std::size_t phase, double shotFraction) const
{
  Eigen::VectorXd terms = -meanOfTerms;
  if (darkField.size() > 0)
  {
    terms += PartRegression::FieldAt(x, y);
  }
  else
  {
    terms(terms.size() == 1 ? 0 : static_cast<Eigen::Index>(PartOf(partition, x, y, phase))) += 1.0;
  }
  return (1.0 - shotFraction) * terms;
}

bool
PartGains::Differ() const
{
  return size > InParts.leastDifference && z > Significance.manyTests;
}

bool
PartGains::DarkVariancesDiffer() const
{
  return darkSize > InCommon.leastDarkDifference && darkZ > Significance.severalTests;
}

bool
PartGains::DifferMuch() const
{
  return ((this->Differ() && size > InParts.largeDifference) || this->DarkVariancesDiffer()) &&
         scale < InParts.largestScatter;
}

std::vector<float>
MapOfRatios(const GainByParts &         parts,
            const std::vector<double> & mean,
            const FrameGeometry &       geometry,
            const PartReference &       reference,
            const ParallelFor &         parallelFor)
{
  std::vector<float> ratios(mean.size(), 1.0F);
  const auto         width = static_cast<double>(geometry.width);
  const auto         height = static_cast<double>(geometry.height);
  parallelFor(geometry.height, [&](std::size_t row) {
    const double y = (static_cast<double>(row) + 0.5) / height;
    for (std::size_t column = 0; column < geometry.width; ++column)
    {
      const std::size_t p = row * geometry.width + column;
      const double      x = (static_cast<double>(column) + 0.5) / width;
      const double      shot = ShotFractionAt(reference, mean[p]);
      double            ratio = 1.0;
      for (const auto * const own : { &parts.places, &parts.phases })
      {
        ratio *= *own ? (*own)->RatioAt(x, y, PhaseOf(column, row), shot) : 1.0;
      }
      ratios[p] = static_cast<float>(ratio);
    }
  });
  return ratios;
}

namespace
{
/** Computes CovarianceByRatios() of one partition. */
Eigen::Matrix2d
CovarianceByOne(const PartGains &     own,
                const VarianceData &  data,
                const FrameGeometry & geometry,
                const PartReference & reference,
                const ParallelFor &   parallelFor)
{
  const VarianceLine & line = reference.line;
  const auto           width = static_cast<double>(geometry.width);
  const auto           height = static_cast<double>(geometry.height);
  // The derivatives of the line's value at the pivot and of its gain, by rows, so that no sum depends on the threads.
  std::vector<Eigen::MatrixXd> ofRows(geometry.height, Eigen::MatrixXd::Zero(2, own.darkCovariance.rows()));
  std::vector<Eigen::Vector2d> weightsOfRows(geometry.height, Eigen::Vector2d::Zero());
  const std::size_t every = std::max<std::size_t>(1, geometry.Pixels() / (LargestPeriod * InParts.pixelsOfDerivatives));
  parallelFor(geometry.height, [&](std::size_t row) {
    if (row / LargestPeriod % every != 0)
    {
      return;
    }
    const double y = (static_cast<double>(row) + 0.5) / height;
    // Every fourth pixel of a row; sixteen rows have all phases.
    for (std::size_t column = (row + row / LargestPeriod) % LargestPeriod; column < geometry.width;
         column += LargestPeriod)
    {
      const std::size_t p = row * geometry.width + column;
      if (data.mask[p] != 0)
      {
        const double          x = (static_cast<double>(column) + 0.5) / width;
        const double          shot = ShotFractionAt(reference, data.mean[p]);
        const double          variance = line.At(data.mean[p]);
        const double          beside = data.mean[p] - line.pivotDn;
        const Eigen::VectorXd change = own.DarkDerivativesAt(x, y, PhaseOf(column, row), shot) / variance;
        ofRows[row].row(0) += change.transpose();
        ofRows[row].row(1) += beside * change.transpose();
        weightsOfRows[row] += Eigen::Vector2d(1.0, beside * beside) / (variance * variance);
      }
    }
  });
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(2, own.darkCovariance.rows());
  Eigen::Vector2d weights = Eigen::Vector2d::Zero();
  for (std::size_t row = 0; row < geometry.height; ++row)
  {
    derivatives += ofRows[row];
    weights += weightsOfRows[row];
  }
  if (!(weights.minCoeff() > 0.0))
  {
    return Eigen::Matrix2d::Zero();
  }
  Eigen::Matrix2d toLine; // gain and intercept, from the value at the pivot and the gain
  toLine << 0.0, 1.0, 1.0, -line.pivotDn;
  derivatives = toLine * weights.cwiseInverse().asDiagonal() * derivatives;
  const Eigen::Matrix2d covariance = derivatives * own.darkCovariance * derivatives.transpose();
  // The square of differences less its chance may be negative.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
}
} // namespace

Eigen::Matrix2d
CovarianceByRatios(const std::vector<PartGains> & parts,
                   const VarianceData &           data,
                   const FrameGeometry &          geometry,
                   const PartReference &          reference,
                   const ParallelFor &            parallelFor)
{
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const PartGains & own : parts)
  {
    covariance += CovarianceByOne(own, data, geometry, reference, parallelFor);
  }
  return covariance;
}

} // namespace sensornoise
