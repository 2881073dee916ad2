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
 * \brief Copies of the maps of VarianceData at evenly spread pixels of the mask. A line that pixels are tested against,
 * and the start of a fit of all pixels, are fitted to them. The cost does not grow with the size of the frame. */
class SensorNoise_EXPORT SampledVariance
{
public:
  /** Copies all pixels of the mask. If it has twice \a most or more, copies evenly spread ones, between \a most and
   * twice as many. */
  SampledVariance(const VarianceData & data, std::size_t most, const ParallelFor & parallelFor);

  /** Returns the maps, all of whose pixels count. They are valid as long as the object. */
  VarianceData
  GetData() const;

private:
  std::vector<double>       m_Mean;
  std::vector<double>       m_NeighbourMean;
  std::vector<double>       m_Variance;
  std::vector<float>        m_Dof;
  std::vector<std::uint8_t> m_Mask;
};

} // namespace sensornoise

#endif
