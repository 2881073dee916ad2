// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_InnerBlocks_h
#define sensornoise_scene_InnerBlocks_h

#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "base/Stencils.h"
#include "base/Avx2.h"

#include <cstddef>

namespace sensornoise
{

/** Calls function(begin, end) for blocks of the pixels of all rows except those next to the border, in any order and
 * possibly at the same time. Within these blocks a stencil reads nothing outside of the map, not even at the ends of
 * the rows, where its value has no meaning. Loops over whole blocks therefore need no test, and are compiled to SIMD
 * instructions (AVX2). */
template <typename TFunction>
void
ForInnerBlocks(const FrameGeometry & geometry, const ParallelFor & parallelFor, TFunction function)
{
  if (geometry.height > 2 * StencilMargin)
  {
    const std::size_t first = StencilMargin * geometry.width;
    ForBlocks(geometry.Pixels() - 2 * first, parallelFor, [&function, first](std::size_t begin, std::size_t end) {
      CallWithAvx2([&] { function(first + begin, first + end); });
    });
  }
}

} // namespace sensornoise

#endif
