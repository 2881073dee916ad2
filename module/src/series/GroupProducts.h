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

/** What the sums of a group are made of. */
struct GroupFactors
{
  const FrameRegressors::WeightedColumns * columns; ///< of the pixels, group by group
  const std::uint32_t *                    order;   ///< the pixels' places in a series
  const double *                           series;  ///< RegressorBand::Together of them
  std::size_t                              pixels;  ///< from one series to the next
};

/** Sums over the pixels of \a group of their columns times the values of the series, by the vectors that the processor
 * has. Same bits on each. */
void
MultiplyGroup(const RegressorBand::Group & group, const GroupFactors & of, RegressorBand::Sums & sums);

} // namespace sensornoise

#endif
