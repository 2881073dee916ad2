// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameEquations.h"

#include "base/Stencils.h"
#include "series/Constants.h"
#include "series/FrameRegressors.h"
#include "series/FrameSums.h"

#include <cmath>
#include <cstddef>

namespace sensornoise
{

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
    series.ofIllumination.resize(0, 2);
    return series;
  }
  const Eigen::MatrixXd  inverse = equations.gram.bottomRightCorner(motion, motion).inverse();
  const Eigen::MatrixX2d columns = equations.gram.bottomLeftCorner(motion, 2);
  const Eigen::VectorXd  illumination = columns * Eigen::Vector2d(-offset, 1.0);
  const Eigen::VectorXd  flicker = Eigen::Map<const Eigen::VectorXd>(gamma.data(), frames);
  series.coefficients = (equations.right.rightCols(motion) - flicker * illumination.transpose()) * inverse;
  series.inverseGram = inverse;
  series.ofIllumination = inverse * columns;
  const bool hasX = equations.Find(2 + StencilX).has_value();
  if (hasX != equations.Find(2 + StencilY).has_value())
  {
    const Eigen::Index own = 2 + (hasX ? StencilX : StencilY);
    series.ofOtherAxis = equations.allGram(2 + StencilX, 2 + StencilY) / equations.allGram(own, own);
  }
  series.covariance = inverse * equations.rawGram.bottomRightCorner(motion, motion) * inverse;
  return series;
}

namespace
{
/** Returns the error of the shifts along one axis, relative to least squares in all derivatives [1]: see
 * ScaleErrorsOf(). \a series are the shifts by least squares, \a column the column of the first derivative. */
double
ScaleError(const FrameSums &       sums,
           const RegressorNoise &  noise,
           const Eigen::VectorXd & series,
           const Eigen::VectorXd & flicker,
           double                  offset,
           Eigen::Index            column)
{
  const Stencil & stencil = MotionStencils()[static_cast<std::size_t>(column - 2)];
  const double    ofNoise = InnerProduct(stencil, stencil) / static_cast<double>(series.size());
  double          weights = 0.0;
  double          squares = 0.0;
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    const auto & gram = sums.GetClassGram(c);
    const double energy = gram(column, column) - noise.variance[c] * ofNoise;
    if (energy > InSeries.leastSignalFraction * gram(column, column))
    {
      const double illumination = gram(column, 1) - offset * gram(column, 0);
      double       product = -illumination * flicker.dot(series);
      for (Eigen::Index t = 0; t < series.size(); ++t)
      {
        product += sums.GetClassSums(static_cast<std::size_t>(t), c)(column) * series(t);
      }
      weights += energy;
      squares += energy * std::pow(product / (energy * series.squaredNorm()) - 1.0, 2);
    }
  }
  return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
}
} // namespace

Eigen::Vector2d
ScaleErrorsOf(const FrameSums &           sums,
              const RegressorNoise &      noise,
              const MotionSeries &        motion,
              const std::vector<double> & gamma,
              double                      offset)
{
  const Eigen::VectorXd flicker =
    Eigen::Map<const Eigen::VectorXd>(gamma.data(), static_cast<Eigen::Index>(gamma.size()));
  Eigen::Vector2d errors = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < motion.stencils.size(); ++i)
  {
    const auto axis = static_cast<Eigen::Index>(motion.stencils[i]);
    if (MotionStencils()[motion.stencils[i]].order == 1)
    {
      errors(axis) =
        ScaleError(sums, noise, motion.coefficients.col(static_cast<Eigen::Index>(i)), flicker, offset, 2 + axis);
    }
  }
  return errors;
}

} // namespace sensornoise
