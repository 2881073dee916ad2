// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameRegressors.h"

#include "base/Quantiles.h"
#include "base/Stencils.h"
#include "scene/InnerBlocks.h"
#include "series/Constants.h"

#include <algorithm>
#include <utility>

namespace sensornoise
{

namespace
{
using Edges = std::array<double, GradientClasses - 1>;

/** Sets the classes of the pixels of [first, last) that \a take selects, whose roughness is separated by \a edges.
 * Small arguments are passed by value: by reference they could alias the output, which prevents vectorization. */
void
FillClasses(const ReferenceFrame & frame,
            InitialNoiseModel      model,
            Edges                  edges,
            const std::uint8_t *   take,
            std::size_t            first,
            std::size_t            last,
            std::uint8_t *         classes)
{
  const double * const mean = frame.mean.data();
  const double * const neighbourMean = frame.neighbourMean.data();
  const std::size_t    width = frame.geometry.width;
  for (std::size_t p = first; p < last; ++p)
  {
    // All edges are compared: a search would have unpredictable branches, which cost more.
    const double rough = StencilEnergyAt(mean, width, p) / model.NoiseVariance(neighbourMean[p]);
    unsigned int above = 0;
    for (const double edge : edges)
    {
      above += edge < rough ? 1 : 0;
    }
    classes[p] = static_cast<std::uint8_t>(take[p] != 0 ? above : FrameRegressors::Unused);
  }
}
} // namespace

FrameRegressors::FrameRegressors(const ReferenceFrame &            frame,
                                 const InitialNoiseModel &         model,
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
  Edges edges = InSeries.classEdges;
  for (double & edge : edges)
  {
    edge = values.empty() ? 0.0 : Quantile(values, edge);
  }
  ForInnerBlocks(m_Frame->geometry, parallelFor, [&](std::size_t begin, std::size_t end) {
    FillClasses(*m_Frame, m_Model, edges, take.data(), begin, end, m_ClassOf.data());
  });
  m_PixelsOfClass = SumBlocks<GradientClasses>(
    m_ClassOf.size(), parallelFor, [this](std::size_t begin, std::size_t end, auto & counts) {
      for (std::size_t c = 0; c < GradientClasses; ++c)
      {
        counts[c] = static_cast<double>(
          std::count(m_ClassOf.data() + begin, m_ClassOf.data() + end, static_cast<std::uint8_t>(c)));
      }
    });
}

} // namespace sensornoise
