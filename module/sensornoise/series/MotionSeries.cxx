// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/series/MotionSeries.h"

#include "sensornoise/base/Stencils.h"
#include "sensornoise/series/Constants.h"
#include "sensornoise/series/FrameProducts.h"
#include "sensornoise/series/ShiftInstruments.h"

namespace sensornoise
{

namespace
{
using InstrumentGram = Eigen::Matrix<double, FrameSums::Instruments, FrameColumns>;

/** The products of the instruments with the columns, without the noise that they share. */
InstrumentGram
GramWithoutNoise(const FrameSums & sums, const InstrumentNoise & noise)
{
  // The triangle of two boxes of side s has the height 1 / s, and (s - 2) / s^2 two pixels away; a central difference
  // smoothed by it and the plain one share (height - that) / 2 of the noise, along the other axis the height again.
  const double   side = 2.0 * static_cast<double>(InSeries.instrumentRadius) + 1.0;
  const double   shared = 0.5 * (1.0 / side - (side - 2.0) / (side * side)) / side;
  const auto     frames = sums.GetFrame().frames;
  InstrumentGram gram = sums.GetInstrumentGram();
  gram(0, 2 + StencilX) -= shared * noise.variance / static_cast<double>(frames);
  gram(1, 2 + StencilY) -= shared * noise.variance / static_cast<double>(frames);
  return gram;
}
} // namespace

double
MotionSeries::Get(std::size_t t, std::size_t k) const
{
  for (std::size_t i = 0; i < stencils.size(); ++i)
  {
    if (stencils[i] == k)
    {
      return coefficients(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(i));
    }
  }
  return 0.0;
}

MotionSeries
SolveMotion(const FrameEquations & equations, const std::vector<double> & gamma, double offset)
{
  MotionSeries series;
  for (std::size_t k = 2; k < equations.active.size(); ++k)
  {
    series.stencils.push_back(equations.active[k] - 2);
  }
  const auto motion = static_cast<Eigen::Index>(series.stencils.size());
  const auto frames = equations.right.rows();
  if (motion == 0)
  {
    series.coefficients.resize(frames, 0);
    series.covariance.resize(0, 0);
    series.inverseGram.resize(0, 0);
    return series;
  }
  const Eigen::MatrixXd inverse = equations.gram.bottomRightCorner(motion, motion).inverse();
  const Eigen::VectorXd light = equations.gram.bottomLeftCorner(motion, 2) * Eigen::Vector2d(-offset, 1.0);
  const Eigen::VectorXd flicker = Eigen::Map<const Eigen::VectorXd>(gamma.data(), frames);
  series.coefficients = (equations.right.rightCols(motion) - flicker * light.transpose()) * inverse;
  series.inverseGram = inverse;
  series.covariance = inverse * equations.rawGram.bottomRightCorner(motion, motion) * inverse;
  return series;
}

std::optional<InstrumentShifts>
SolveShifts(const FrameSums &           sums,
            const MotionSeries &        motion,
            const InstrumentNoise &     noise,
            const std::vector<double> & gamma,
            double                      offset)
{
  bool hasX = false;
  bool hasY = false;
  for (const std::size_t k : motion.stencils)
  {
    hasX = hasX || k == StencilX;
    hasY = hasY || k == StencilY;
  }
  if (!hasX || !hasY)
  {
    return std::nullopt;
  }
  const auto           frames = sums.GetFrame().frames;
  const InstrumentGram gram = GramWithoutNoise(sums, noise);
  Eigen::Matrix2d      gradient;
  gradient << gram(0, 2 + StencilX), gram(0, 2 + StencilY), gram(1, 2 + StencilX), gram(1, 2 + StencilY);
  const Eigen::Vector2d light = gram.leftCols<2>() * Eigen::Vector2d(-offset, 1.0);
  if (!(gradient.diagonal().prod() > 0.0 &&
        gradient.determinant() > InSeries.leastDeterminant * gradient.diagonal().prod()))
  {
    return std::nullopt; // too little of the scene is whole
  }
  const Eigen::Matrix2d inverse = gradient.inverse();
  InstrumentShifts      shifts;
  shifts.coefficients.resize(static_cast<Eigen::Index>(frames), 2);
  for (std::size_t t = 0; t < frames; ++t)
  {
    const auto &    sum = sums.GetInstrumentSums(t);
    Eigen::Vector2d rest = Eigen::Vector2d(sum[0], sum[1]) - gamma[t] * light;
    for (std::size_t i = 0; i < motion.stencils.size(); ++i)
    {
      const std::size_t k = motion.stencils[i];
      if (k != StencilX && k != StencilY)
      {
        rest -= motion.coefficients(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(i)) *
                gram.col(static_cast<Eigen::Index>(2 + k));
      }
    }
    shifts.coefficients.row(static_cast<Eigen::Index>(t)) = inverse * rest;
  }
  shifts.covariance = inverse * noise.squares * inverse.transpose();
  return shifts;
}

} // namespace sensornoise
