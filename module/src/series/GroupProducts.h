// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_GroupProducts_h
#define sensornoise_series_GroupProducts_h

#include "series/FrameRegressors.h"
#include "series/RegressorBand.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** Factors of the products that are summed over a group. */
struct GroupFactors
{
  const FrameRegressors::WeightedColumns * columns; ///< columns of the pixels, group by group
  const std::uint32_t *                    order;   ///< places of the pixels in a series
  const double *                           series;  ///< RegressorBand::Together series
  std::size_t                              pixels;  ///< distance from one series to the next
};

/** Computes the sums over the pixels of \a group of their columns times the values of the series, with the SIMD
 * instructions of the processor. The bits are the same on all processors. */
void
MultiplyGroup(const RegressorBand::Group & group, const GroupFactors & of, RegressorBand::Sums & sums);

} // namespace sensornoise

#endif
