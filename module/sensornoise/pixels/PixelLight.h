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
#ifndef sensornoise_pixels_PixelLight_h
#define sensornoise_pixels_PixelLight_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** The projected stack and what is known of it when the light is looked at, pixel by pixel. */
struct PixelLight
{
  const ProjectedVariance &         projected;
  const VarianceLine &              line;
  const std::vector<std::uint8_t> & mask;
  double                            centreDn;
  double                            darkestDn;
  double                            rangeDn;
};

namespace detail
{
/** A way to cut the frame into patches. */
struct Patches
{
  std::size_t height;
  std::size_t width;
  std::size_t across;

  std::size_t
  Of(std::size_t p, std::size_t frameWidth) const
  {
    return p / frameWidth / height * across + p % frameWidth / width;
  }
};

/** Removes what motion leaked by chance into the responses: kappa_k times the derivatives, kappa common to the frame.
 * It is estimated against lines in the mean that are free in every 8 x 8 patch (Frisch & Waugh 1933), so that light
 * that differs over the frame does not bias it. Even derivatives resemble the mean locally and would shift the offset.
 */
inline std::vector<std::vector<double>>
ResponsesWithoutMotion(const PixelLight & data, const ParallelFor & parallelFor)
{
  constexpr std::size_t  derivatives = 5;
  const ReferenceFrame & frame = data.projected.GetFrame();
  const std::size_t      width = frame.geometry.width;
  const std::size_t      light = data.projected.GetBasis().NumberOfLightFactors();
  constexpr std::size_t  side = 8;
  const std::size_t      bands = (frame.geometry.height + side - 1) / side; // lines of patches
  const std::size_t      variables = derivatives + light;
  // Calls function(pixel, weight, mean minus the centre, its derivatives and coordinates).
  const auto forBand = [&](std::size_t band, auto function) {
    std::vector<double> z(variables);
    for (std::size_t p = side * band * width; p < std::min(data.mask.size(), side * (band + 1) * width); ++p)
    {
      if (data.mask[p] != 0)
      {
        std::copy_n(ApplyStencils(frame.mean.data(), width, p).begin(), derivatives, z.begin());
        for (std::size_t j = 0; j < light; ++j)
        {
          z[derivatives + j] = data.projected.GetCoordinates().At(p, j);
        }
        function(p, 1.0 / data.line.At(frame.neighbourMean[p]), frame.mean[p] - data.centreDn, z);
      }
    }
  };
  // The derivatives, freed of the patches' lines, times themselves and times the coordinates.
  std::vector<Eigen::MatrixXd> parts(bands, Eigen::MatrixXd::Zero(derivatives, static_cast<Eigen::Index>(variables)));
  parallelFor(bands, [&](std::size_t band) {
    // Per patch: n, w, wI, wII, then of each variable w z and w I z.
    const std::size_t   stride = 4 + 2 * variables;
    std::vector<double> sums((width + side - 1) / side * stride, 0.0);
    const auto          of = [&](std::size_t p) { return sums.data() + p % width / side * stride; };
    forBand(band, [&](std::size_t p, double w, double centred, const std::vector<double> & z) {
      double * s = of(p);
      s[0] += 1.0;
      s[1] += w;
      s[2] += w * centred;
      s[3] += w * centred * centred;
      for (std::size_t k = 0; k < variables; ++k)
      {
        s[4 + 2 * k] += w * z[k];
        s[5 + 2 * k] += w * centred * z[k];
      }
    });
    forBand(band, [&](std::size_t p, double w, double centred, std::vector<double> & z) {
      const double * s = of(p);
      const double   determinant = s[1] * s[3] - s[2] * s[2];
      if (s[0] > 20.0 && determinant > 1e-9 * s[1] * s[3])
      {
        for (std::size_t k = 0; k < variables; ++k)
        {
          const double slope = (s[1] * s[5 + 2 * k] - s[2] * s[4 + 2 * k]) / determinant;
          const double level = (s[3] * s[4 + 2 * k] - s[2] * s[5 + 2 * k]) / determinant;
          z[k] -= level + slope * centred;
        }
        const Eigen::Map<const Eigen::VectorXd> free(z.data(), static_cast<Eigen::Index>(variables));
        parts[band].noalias() += w * free.head<derivatives>() * free.transpose();
      }
    });
  });
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(derivatives, static_cast<Eigen::Index>(variables));
  for (const Eigen::MatrixXd & part : parts)
  {
    products += part;
  }
  const Eigen::MatrixXd                                   gram = products.leftCols<derivatives>();
  const Eigen::MatrixXd                                   right = products.rightCols(static_cast<Eigen::Index>(light));
  const Eigen::VectorXd                                   unit = (gram.diagonal().array() + 1e-300).rsqrt();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-6);
  solver.compute(unit.asDiagonal() * gram * unit.asDiagonal());
  const Eigen::MatrixXd leak = unit.asDiagonal() * solver.solve(unit.asDiagonal() * right);

  std::vector<std::vector<double>> responses(light, std::vector<double>(data.mask.size(), 0.0));
  parallelFor(bands, [&](std::size_t band) {
    forBand(band, [&](std::size_t p, double, double, const std::vector<double> & z) {
      for (std::size_t j = 0; j < light; ++j)
      {
        responses[j][p] = z[derivatives + j];
        for (std::size_t k = 0; k < derivatives; ++k)
        {
          responses[j][p] -= leak(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) * z[k];
        }
      }
    });
  });
  return responses;
}
} // namespace detail

} // namespace sensornoise

#endif
