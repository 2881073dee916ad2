// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameEquations.h"

#include "base/Stencils.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

namespace
{
/** Number of different elements of a symmetric matrix of the columns. */
constexpr std::size_t Products = FrameColumns * (FrameColumns + 1) / 2;

/** Returns the columns of pixel \a p: 1, the mean minus the centre, and the derivatives of the mean. */
std::array<double, FrameColumns>
ColumnsOf(const FrameRegressors & regressors, std::size_t p)
{
  const ReferenceFrame &           frame = regressors.GetFrame();
  std::array<double, FrameColumns> columns{ 1.0, frame.mean[p] - regressors.GetModel().centreDn };
  const auto                       derivatives = ApplyStencils(frame.mean.data(), frame.geometry.width, p);
  std::copy(derivatives.begin(), derivatives.end(), columns.begin() + 2);
  return columns;
}

} // namespace

std::vector<FrameSums::ClassMatrix>
CovarianceOfProducts(const FrameRegressors & regressors, const PixelMap & variance, const ParallelFor & parallelFor)
{
  const std::vector<float> & level = regressors.GetFrame().neighbourMean;
  const std::vector<double>  sums =
    SumOverBlocks(level.size(), parallelFor, GradientClasses * Products, [&](std::size_t p, double * sum) {
      const std::size_t c = regressors.ClassOf(p);
      if (c == FrameRegressors::Unused)
      {
        return;
      }
      const double ofModel = regressors.GetModel().NoiseVariance(level[p]);
      const double own = std::isfinite(variance[p]) ? variance[p] : ofModel;
      const double weight = own / (ofModel * ofModel);
      const auto   columns = ColumnsOf(regressors, p);
      double *     product = sum + c * Products;
      for (std::size_t i = 0; i < FrameColumns; ++i)
      {
        const double weighted = weight * columns[i];
        for (std::size_t j = 0; j <= i; ++j)
        {
          *product++ += weighted * columns[j];
        }
      }
    });
  std::vector<FrameSums::ClassMatrix> covariance(GradientClasses);
  const double *                      product = sums.data();
  for (FrameSums::ClassMatrix & ofClass : covariance)
  {
    for (Eigen::Index i = 0; i < ofClass.rows(); ++i)
    {
      for (Eigen::Index j = 0; j <= i; ++j)
      {
        ofClass(i, j) = ofClass(j, i) = *product++;
      }
    }
  }
  return covariance;
}

} // namespace sensornoise
