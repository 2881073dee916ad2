// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/SampledVariance.h"

#include "base/Quantiles.h"

namespace sensornoise
{

SampledVariance::SampledVariance(const VarianceData & data, std::size_t most, const ParallelFor & parallelFor)
{
  const std::vector<std::size_t> pixels = SamplePixels(data.mask, data.pixels, most);
  m_Mean.resize(pixels.size());
  m_NeighbourMean.resize(pixels.size());
  m_Variance.resize(pixels.size());
  m_Dof.resize(pixels.size());
  m_Mask.assign(pixels.size(), 1);
  ForPixels(pixels.size(), parallelFor, [&](std::size_t i) {
    const std::size_t p = pixels[i];
    m_Mean[i] = data.mean[p];
    m_NeighbourMean[i] = data.neighbourMean[p];
    m_Variance[i] = data.variance[p];
    m_Dof[i] = data.dof[p];
  });
}

VarianceData
SampledVariance::GetData() const
{
  return { m_Mean.data(), m_NeighbourMean.data(), m_Variance.data(), m_Dof.data(), m_Mask.data(), m_Mask.size() };
}

} // namespace sensornoise
