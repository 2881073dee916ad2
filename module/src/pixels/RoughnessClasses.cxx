// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/RoughnessClasses.h"

#include "base/BoxSum.h"
#include "base/FirstTouch.h"
#include "base/Quantiles.h"
#include "base/Stencils.h"
#include "pixels/Constants.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace sensornoise
{

namespace
{
/** Limits of the classes in rising order. They are infinite if there are no pixels, so that all pixels are of class
 * 0. */
using ClassEdges = std::array<double, RoughnessClasses - 1>;

/** Returns the energy of the derivatives of every usable pixel, which a motion turns into variance; 0 for other
 * pixels. */
std::vector<float>
EnergyMap(const ReferenceFrame & frame, const ParallelFor & parallelFor)
{
  const std::size_t width = frame.geometry.width;
  auto              energy = MakeMap<float>(frame.mean.size(), parallelFor);
  ForBoxBands(frame.geometry.height, parallelFor, [&](std::size_t first, std::size_t last) {
    last = std::min(last, frame.geometry.height - StencilMargin);
    for (std::size_t y = std::max(first, StencilMargin); y < last; ++y)
    {
      const double * const       mean = frame.mean.data() + y * width;
      const std::uint8_t * const usable = frame.usable.data() + y * width;
      float * const              own = energy.data() + y * width;
      for (std::size_t x = StencilMargin; x + StencilMargin < width; ++x)
      {
        const auto found = static_cast<float>(StencilEnergyAt(mean, width, x));
        own[x] = usable[x] != 0 ? found : 0.0F;
      }
    }
  });
  return energy;
}

/** Returns the sum of a map over the square about a pixel, cut at the frame's border. */
double
SumAbout(const std::vector<float> & map, const FrameGeometry & geometry, std::size_t p, std::size_t radius)
{
  const std::size_t x = p % geometry.width;
  const std::size_t y = p / geometry.width;
  const std::size_t left = x - std::min(x, radius);
  const std::size_t right = std::min(x + radius, geometry.width - 1);
  double            sum = 0.0;
  for (std::size_t row = y - std::min(y, radius); row <= std::min(y + radius, geometry.height - 1); ++row)
  {
    for (std::size_t k = row * geometry.width + left; k <= row * geometry.width + right; ++k)
    {
      sum += map[k];
    }
  }
  return sum;
}

/** Returns the limits of 15 classes up to the quantile 0.9 and of 9 classes above, 8 of them up to 0.995. */
ClassEdges
EdgesOf(std::vector<double> roughness)
{
  ClassEdges edges;
  edges.fill(std::numeric_limits<double>::infinity());
  std::sort(roughness.begin(), roughness.end());
  for (std::size_t c = 1; c < RoughnessClasses && !roughness.empty(); ++c)
  {
    const double rank = c <= 15 ? 0.06 * static_cast<double>(c) : 0.92 + 0.075 * static_cast<double>(c - 16) / 7.0;
    edges[c - 1] = SortedQuantile(roughness, rank);
  }
  return edges;
}

/** Sets the classes of a row of pixels from their sums of the energy. All limits are compared, without branches. */
void
ClassifyRow(const double *            sums,
            const double *            neighbourMean,
            const InitialNoiseModel & model,
            const ClassEdges &        edges,
            std::size_t               width,
            std::uint8_t *            classOf)
{
  constexpr std::size_t together = 64; // pixels whose counts stay in the first-level cache
  for (std::size_t first = 0; first < width; first += together)
  {
    const std::size_t pixels = std::min(together, width - first);
    double            roughness[together] = {};
    double            below[together] = {}; // number of limits below the roughness
    for (std::size_t k = 0; k < pixels; ++k)
    {
      roughness[k] = sums[first + k] / model.NoiseVariance(neighbourMean[first + k]);
    }
    for (const double edge : edges)
    {
      for (std::size_t k = 0; k < together; ++k)
      {
        below[k] += edge < roughness[k] ? 1.0 : 0.0;
      }
    }
    for (std::size_t k = 0; k < pixels; ++k)
    {
      classOf[first + k] = static_cast<std::uint8_t>(static_cast<int>(below[k]));
    }
  }
}
} // namespace

std::vector<std::uint8_t>
ClassifyRoughness(const ReferenceFrame &            frame,
                  const InitialNoiseModel &         model,
                  const std::vector<std::uint8_t> & mask,
                  const ParallelFor &               parallelFor)
{
  const std::size_t width = frame.geometry.width;
  const double      sd = std::sqrt(std::max(model.vibrationXPixels2, model.vibrationYPixels2));
  const auto        radius = static_cast<std::size_t>(
    sd < InPixels.smallMotion ? 2.0 : 2.0 + std::ceil(InPixels.motionSds * std::min(sd, InPixels.largestMotion)));
  const std::vector<float>       energy = EnergyMap(frame, parallelFor);
  const std::vector<std::size_t> pixels = SamplePixels(mask);
  std::vector<double>            sample(pixels.size());
  ForPixels(pixels.size(), parallelFor, [&](std::size_t k) {
    const std::size_t p = pixels[k];
    sample[k] = SumAbout(energy, frame.geometry, p, radius) / model.NoiseVariance(frame.neighbourMean[p]);
  });
  const ClassEdges edges = EdgesOf(std::move(sample));
  auto             classOf = MakeMap<std::uint8_t>(mask.size(), parallelFor);
  const auto       rows = [&] { return RowsOf(energy, width); };
  ForBoxRows(rows, width, frame.geometry.height, radius, parallelFor, [&](std::size_t y, const double * sums) {
    ClassifyRow(sums, frame.neighbourMean.data() + y * width, model, edges, width, classOf.data() + y * width);
  });
  return classOf;
}

} // namespace sensornoise
