// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/ResidualSquares.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/FirstTouch.h"
#include "sensornoise/pixels/PixelCoordinates.h"
#include "sensornoise/scene/ReferenceFrame.h"
#include "sensornoise/series/TemporalBasis.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

void
AppendResidualSquares(const ReferenceFrame & frame,
                      const TemporalBasis &  basis,
                      PixelCoordinates &     coordinates,
                      bool                   keepCoordinates,
                      const ParallelFor &    parallelFor,
                      ResidualSquares &      squares)
{
  const Eigen::MatrixXd & q = basis.GetBasis();
  const Eigen::VectorXd   skew = q.transpose() * q.cwiseAbs2().rowwise().sum();
  const auto              freedom = static_cast<double>(frame.frames - 1);
  squares.rss.reserve(frame.mean.size());
  squares.skew.reserve(frame.mean.size());
  const auto append = [&](std::size_t firstPixel, std::size_t lastPixel) {
    GrowMap(squares.rss, lastPixel, parallelFor);
    GrowMap(squares.skew, lastPixel, parallelFor);
    ForBlocks(lastPixel - firstPixel, parallelFor, [&](std::size_t begin, std::size_t end) {
      end += firstPixel;
      for (std::size_t first = begin + firstPixel; first < end; first += PixelCoordinates::BlockPixels)
      {
        const std::size_t    pixels = std::min(PixelCoordinates::BlockPixels, end - first);
        const double * const variance = frame.variance.data() + first;
        double * const       rss = squares.rss.data() + first;
        std::transform(variance, variance + pixels, rss, [freedom](double own) { return freedom * own; });
        for (std::size_t j = 0; j < basis.Size(); ++j)
        {
          const double * own = coordinates.Of(first, j);
          const double   factor = skew(static_cast<Eigen::Index>(j));
          for (std::size_t i = 0; i < pixels; ++i)
          {
            rss[i] -= own[i] * own[i];
            squares.skew[first + i] += static_cast<float>(factor * own[i]);
          }
        }
      }
    });
  };
  const std::size_t last = coordinates.LastPixel();
  for (std::size_t first = coordinates.FirstPixel(); first < last; first += ProjectionSums::SlabPixels)
  {
    append(first, std::min(last, first + ProjectionSums::SlabPixels));
    if (!keepCoordinates)
    {
      coordinates.ReleaseFirstSlab();
    }
  }
}

} // namespace sensornoise
