// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_BoxSum_h
#define sensornoise_base_BoxSum_h

#include "sensornoise/base/Parallel.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Sum of \a map over a square of 2 \a radius + 1 pixels about each pixel, cut at the frame's border; \a result is
 * another map, whose memory is used again.
 *
 * Running sums along the columns, then along the rows: the cost does not depend on the radius.
 *
 * \tparam TValue std::uint8_t, float or double. */
template <typename TValue>
void
BoxSum(const std::vector<TValue> & map,
       std::size_t                 width,
       std::size_t                 height,
       std::size_t                 radius,
       const ParallelFor &         parallelFor,
       std::vector<double> &       result);

extern template SensorNoise_EXPORT void
BoxSum(const std::vector<std::uint8_t> &,
       std::size_t,
       std::size_t,
       std::size_t,
       const ParallelFor &,
       std::vector<double> &);
extern template SensorNoise_EXPORT void
BoxSum(const std::vector<float> &, std::size_t, std::size_t, std::size_t, const ParallelFor &, std::vector<double> &);
extern template SensorNoise_EXPORT void
BoxSum(const std::vector<double> &, std::size_t, std::size_t, std::size_t, const ParallelFor &, std::vector<double> &);

/** The same, in a new map. */
template <typename TValue>
std::vector<double>
BoxSum(const std::vector<TValue> & map,
       std::size_t                 width,
       std::size_t                 height,
       std::size_t                 radius,
       const ParallelFor &         parallelFor = SerialFor)
{
  std::vector<double> result;
  BoxSum(map, width, height, radius, parallelFor, result);
  return result;
}

} // namespace sensornoise

#endif
