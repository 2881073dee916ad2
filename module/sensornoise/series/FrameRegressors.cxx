// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/series/FrameRegressors.h"

#include "sensornoise/base/Quantiles.h"
#include "sensornoise/series/Constants.h"

#include <numeric>
#include <utility>

namespace sensornoise
{

FrameRegressors::FrameRegressors(const ReferenceFrame &            frame,
                                 const ProvisionalModel &          model,
                                 const std::vector<std::uint8_t> & take,
                                 ShiftInstruments                  instruments,
                                 const ParallelFor &               parallelFor)
  : m_Frame(&frame)
  , m_Model(model)
  , m_ClassOf(frame.mean.size(), Unused)
  , m_Instruments(std::move(instruments))
{
  this->ClassifyPixels(take, parallelFor);
}

void
FrameRegressors::ClassifyPixels(const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor)
{
  const std::size_t width = m_Frame->geometry.width;
  const double *    mean = m_Frame->mean.data();
  const auto        roughness = [&](std::size_t p) {
    return StencilEnergyAt(mean, width, p) / m_Model.NoiseVariance(m_Frame->neighbourMean[p]);
  };
  std::vector<double> values;
  for (const std::size_t p : SamplePixels(take))
  {
    values.push_back(roughness(p));
  }
  std::array<double, GradientClasses - 1> edges = InSeries.classEdges;
  for (double & edge : edges)
  {
    edge = values.empty() ? 0.0 : Quantile(values, edge);
  }
  ForBlocks(take.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (take[p] != 0)
      {
        // All edges are compared: a search would branch by chance, which costs more.
        const double rough = roughness(p);
        m_ClassOf[p] = static_cast<std::uint8_t>(std::accumulate(
          edges.begin(), edges.end(), 0, [rough](int count, double edge) { return count + (edge < rough); }));
      }
    }
  });
}

} // namespace sensornoise
