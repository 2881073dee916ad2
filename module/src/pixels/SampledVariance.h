// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_SampledVariance_h
#define sensornoise_pixels_SampledVariance_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \class SampledVariance
 * \brief The maps of VarianceData at evenly spread pixels of the mask: what draws a line that judges pixels, or from
 * which a fit of all pixels starts. Its cost does not grow with the frame. */
class SensorNoise_EXPORT SampledVariance
{
public:
  /** All pixels of the mask, or of twice as many as \a most or more, between \a most and twice as many. */
  SampledVariance(const VarianceData & data, std::size_t most, const ParallelFor & parallelFor);

  /** All of its pixels count. Stays as long as the object. */
  VarianceData
  GetData() const;

private:
  std::vector<double>       m_Mean;
  std::vector<double>       m_NeighbourMean;
  std::vector<double>       m_Variance;
  std::vector<float>        m_Freedom;
  std::vector<std::uint8_t> m_Mask;
};

} // namespace sensornoise

#endif
