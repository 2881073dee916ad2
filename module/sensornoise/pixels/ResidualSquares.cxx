// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/ResidualSquares.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/FirstTouch.h"
#include "sensornoise/base/WideVectors.h"
#include "sensornoise/pixels/ProjectionSums.h"
#include "sensornoise/scene/ReferenceFrame.h"
#include "sensornoise/series/TemporalBasis.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr std::size_t BlockPixels = ProjectionSums::BlockPixels;

/** The squares of the pixels of a block, whose \a coordinates on each series lie side by side. */
void
FillSquares(const std::vector<double> & factors, // of the coordinates in the skew
            double                      freedom,
            const double *              coordinates,
            const double *              variance,
            std::size_t                 pixels,
            double *                    rss,
            float *                     skew)
{
  WithWideVectors([&] {
    double squares[BlockPixels]; // no pointer can point into them
    float  skews[BlockPixels] = {};
    for (std::size_t i = 0; i < pixels; ++i)
    {
      squares[i] = freedom * variance[i];
    }
    for (std::size_t j = 0; j < factors.size(); ++j)
    {
      const double * const own = coordinates + j * BlockPixels;
      const double         factor = factors[j];
      for (std::size_t i = 0; i < pixels; ++i)
      {
        squares[i] -= own[i] * own[i];
        skews[i] += static_cast<float>(factor * own[i]);
      }
    }
    std::copy_n(squares, pixels, rss);
    std::copy_n(skews, pixels, skew);
  });
}
} // namespace

void
AppendResidualSquares(const ReferenceFrame & frame,
                      const TemporalBasis &  basis,
                      ProjectionSums &       sums,
                      bool                   keepCoordinates,
                      const ParallelFor &    parallelFor,
                      ResidualSquares &      squares)
{
  const Eigen::MatrixXd &   q = basis.GetBasis();
  const Eigen::VectorXd     skew = q.transpose() * q.cwiseAbs2().rowwise().sum();
  const std::vector<double> factors(skew.data(), skew.data() + skew.size());
  const auto                freedom = static_cast<double>(frame.frames - 1);
  squares.rss.reserve(frame.mean.size());
  squares.skew.reserve(frame.mean.size());
  const auto append = [&](std::size_t firstPixel, std::size_t lastPixel) {
    GrowMap(squares.rss, lastPixel, parallelFor);
    GrowMap(squares.skew, lastPixel, parallelFor);
    ForBlocks(lastPixel - firstPixel, parallelFor, [&](std::size_t begin, std::size_t end) {
      std::vector<double> copy(BlockPixels * basis.Size()); // what is given back is not written to
      end += firstPixel;
      for (std::size_t first = begin + firstPixel; first < end; first += BlockPixels)
      {
        const std::size_t pixels = std::min(BlockPixels, end - first);
        double *          own = copy.data();
        if (basis.Size() > 0 && keepCoordinates)
        {
          own = &sums.At(first, 0);
        }
        else if (basis.Size() > 0)
        {
          std::copy_n(&sums.At(first, 0), copy.size(), own);
        }
        basis.ToCoordinates(own, BlockPixels, frame.mean.data() + first, pixels);
        FillSquares(factors,
                    freedom,
                    own,
                    frame.variance.data() + first,
                    pixels,
                    squares.rss.data() + first,
                    squares.skew.data() + first);
      }
    });
  };
  const std::size_t last = sums.LastPixel();
  for (std::size_t first = sums.FirstPixel(); first < last; first += ProjectionSums::SlabPixels)
  {
    append(first, std::min(last, first + ProjectionSums::SlabPixels));
    if (!keepCoordinates)
    {
      sums.ReleaseFirstSlab();
    }
  }
}

} // namespace sensornoise
