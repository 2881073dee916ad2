// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_GroupProducts_h
#define sensornoise_series_GroupProducts_h

#include "SensorNoiseExport.h"
#include "base/Simd.h"
#include "series/FrameRegressors.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** Sums of one group of pixels: sums[series][column]. */
using GroupSums = std::array<FrameRegressors::WeightedColumns, FramesTogether>;

/** Factors of the products that are summed over a group of pixels. */
struct GroupFactors
{
  const FrameRegressors::WeightedColumns * columns; ///< columns of the pixels, group by group
  const std::uint32_t *                    order;   ///< places of the pixels in a series
  const double *                           series;  ///< FramesTogether series
  std::size_t                              pixels;  ///< distance from one series to the next
  std::size_t                              begin;   ///< first pixel of the group
  std::size_t                              end;     ///< pixel behind the last one
};

/** Computes the sums over the pixels of a group of their columns times the values of the series, with the SIMD
 * instructions of the processor. The bits are the same on all processors. */
SensorNoise_EXPORT void
MultiplyGroup(const GroupFactors & of, GroupSums & sums);

/** Computes the sums as MultiplyGroup() does, by loops for any processor. */
SensorNoise_EXPORT void
MultiplyGroupAnywhere(const GroupFactors & of, GroupSums & sums);

} // namespace sensornoise

#endif
