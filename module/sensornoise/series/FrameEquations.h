/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_series_FrameEquations_h
#define sensornoise_series_FrameEquations_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/series/FrameProducts.h"
#include "sensornoise/series/FrameSums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Sums over the pixels of each gradient class of what the noise of the regressors adds to the normal equations: with
 * weights w, of w V (V the noise variance of a frame) and of w g q (g q its part that flickers). */
struct RegressorNoise
{
  std::array<double, GradientClasses> variance{};
  std::array<double, GradientClasses> shot{};
};

/** Normal equations of the regression of every frame on the active columns. */
struct FrameEquations
{
  std::vector<std::size_t> active;   ///< columns: 0 and 1 (light), then 2 + index in MotionStencils (motion)
  Eigen::MatrixXd          rawGram;  ///< as summed
  Eigen::MatrixXd          gram;     ///< without the noise of the regressors
  Eigen::MatrixXd          right;    ///< frames x active
  Eigen::Matrix2d          light;    ///< of columns 0 and 1, the motion partialled out (Schur complement)
  Eigen::MatrixX2d         response; ///< frames x 2, the same

  /** Place of a column among the active ones. */
  std::optional<std::size_t>
  Find(std::size_t column) const
  {
    const auto found = std::find(active.begin(), active.end(), column);
    return found == active.end() ? std::nullopt : std::optional<std::size_t>(found - active.begin());
  }
};

namespace detail
{
/** What white noise of variance 1 in the mean adds to the Gram matrix. */
inline FrameSums::ClassMatrix
KernelGram()
{
  const auto &           stencils = MotionStencils();
  FrameSums::ClassMatrix kernels = FrameSums::ClassMatrix::Zero();
  kernels(1, 1) = 1.0;
  for (std::size_t i = 0; i < NumberOfStencils; ++i)
  {
    const auto row = static_cast<Eigen::Index>(2 + i);
    kernels(1, row) = kernels(row, 1) = stencils[i].CentreWeight();
    for (std::size_t j = 0; j < NumberOfStencils; ++j)
    {
      kernels(row, static_cast<Eigen::Index>(2 + j)) = InnerProduct(stencils[i], stencils[j]);
    }
  }
  return kernels;
}

inline Eigen::MatrixXd
Select(const Eigen::MatrixXd & matrix, const std::vector<std::size_t> & rows, const std::vector<std::size_t> & columns)
{
  Eigen::MatrixXd part(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
      part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
        matrix(static_cast<Eigen::Index>(rows[i]), static_cast<Eigen::Index>(columns[j]));
    }
  }
  return part;
}

/** Columns that the data support: those of the first order whose signal exceeds their noise, and those of higher order
 * whose series over the frames is also significant; eliminated one by one, the third order first. */
inline std::vector<std::size_t>
FindActiveColumns(const Eigen::MatrixXd & rawGram,
                  const Eigen::MatrixXd & gram,
                  const Eigen::MatrixXd & right,
                  int                     largestOrder)
{
  const auto &             stencils = MotionStencils();
  const auto               freedom = static_cast<double>(right.rows() - 1);
  std::vector<std::size_t> active{ 0, 1 };
  for (std::size_t k = 2; k < FrameColumns; ++k)
  {
    const auto i = static_cast<Eigen::Index>(k);
    if (stencils[k - 2].order <= largestOrder && gram(i, i) > 0.5 * rawGram(i, i))
    {
      active.push_back(k);
    }
  }
  for (;;)
  {
    const Eigen::MatrixXd a = Select(gram, active, active);
    const Eigen::VectorXd unit = a.diagonal().array().abs().max(1e-300).rsqrt();
    const double          smallest =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(unit.asDiagonal() * a * unit.asDiagonal()).eigenvalues()(0);
    std::size_t worst = 0;
    double      worstScore = 0.0;
    if (smallest > 1e-6)
    {
      const Eigen::MatrixXd inverse = a.inverse();
      const Eigen::VectorXd variance = (inverse * Select(rawGram, active, active) * inverse).diagonal();
      for (std::size_t k = 2; k < active.size(); ++k)
      {
        const int order = stencils[active[k] - 2].order;
        if (order > 1)
        {
          double energy = 0.0;
          for (Eigen::Index t = 0; t < right.rows(); ++t)
          {
            double coefficient = 0.0;
            for (std::size_t j = 0; j < active.size(); ++j)
            {
              coefficient += inverse(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) * right(t, active[j]);
            }
            energy += coefficient * coefficient;
          }
          const double z = (energy / variance(static_cast<Eigen::Index>(k)) - freedom) / std::sqrt(2.0 * freedom);
          const double score = z - (order == 3 ? 100.0 : 0.0);
          if (z < 4.0 && (worst == 0 || score < worstScore))
          {
            worst = k;
            worstScore = score;
          }
        }
      }
    }
    else if (stencils[active.back() - 2].order > 1)
    {
      worst = active.size() - 1;
    }
    if (worst == 0)
    {
      return active;
    }
    active.erase(active.begin() + static_cast<std::ptrdiff_t>(worst));
  }
}
} // namespace detail

/** The normal equations of all frames over the gradient classes 0 ... \a lastClass. Estimator.md, 3.3.
 *
 * The columns are made of the mean, whose noise has the variance V / T. It adds sum w V / T times the kernels' inner
 * products to the Gram matrix, which is taken off; and where the frame's own noise is larger or smaller than the
 * average's by gamma_t g q, its product with a column's centre weight adds to the right-hand side, which is taken off
 * where \a gamma is given. Frames fewer than 20 get no third order. */
inline FrameEquations
MakeFrameEquations(const FrameSums &           sums,
                   const RegressorNoise &      noise,
                   std::size_t                 lastClass,
                   const std::vector<double> & gamma = {})
{
  const auto      frames = sums.GetFrame().frames;
  const auto &    stencils = MotionStencils();
  Eigen::MatrixXd rawGram = Eigen::MatrixXd::Zero(FrameColumns, FrameColumns);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(frames), FrameColumns);
  double          variance = 0.0;
  double          shot = 0.0;
  for (std::size_t c = 0; c <= lastClass; ++c)
  {
    rawGram += sums.GetClassGram(c);
    variance += noise.variance[c] / static_cast<double>(frames);
    shot += noise.shot[c] / static_cast<double>(frames);
    for (std::size_t t = 0; t < frames; ++t)
    {
      right.row(static_cast<Eigen::Index>(t)) += sums.GetClassSums(t, c).transpose();
    }
  }
  const Eigen::MatrixXd gram = rawGram - variance * detail::KernelGram();
  for (std::size_t t = 0; t < gamma.size(); ++t)
  {
    for (std::size_t k = 1; k < FrameColumns; ++k)
    {
      const double centre = k == 1 ? 1.0 : stencils[k - 2].CentreWeight();
      right(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) -= gamma[t] * centre * shot;
    }
  }

  FrameEquations equations;
  equations.active = detail::FindActiveColumns(rawGram, gram, right, frames < 20 ? 2 : 3);
  std::vector<std::size_t> rows(frames);
  for (std::size_t t = 0; t < frames; ++t)
  {
    rows[t] = t;
  }
  equations.rawGram = detail::Select(rawGram, equations.active, equations.active);
  equations.gram = detail::Select(gram, equations.active, equations.active);
  equations.right = detail::Select(right, rows, equations.active);
  const auto motion = static_cast<Eigen::Index>(equations.active.size() - 2);
  equations.light = equations.gram.topLeftCorner<2, 2>();
  equations.response = equations.right.leftCols<2>();
  if (motion > 0)
  {
    const Eigen::MatrixXd partial =
      equations.gram.bottomRightCorner(motion, motion).ldlt().solve(equations.gram.bottomLeftCorner(motion, 2));
    equations.light -= equations.gram.topRightCorner(2, motion) * partial;
    equations.response -= equations.right.rightCols(motion) * partial;
  }
  return equations;
}

} // namespace sensornoise

#endif
