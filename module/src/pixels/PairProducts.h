// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_PairProducts_h
#define sensornoise_pixels_PairProducts_h

#include "SensorNoiseExport.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Integer weights of two frames, |w| <= 2^20, split as w = low + 2048 high. Products of the halves and of 16-bit
 * values stay below 2^25, so that 32 bits hold the sums over 32 frames. Each pair is stored eight times, as SIMD
 * instructions need it. */
struct PairWeights
{
  static constexpr double Step = 2048.0;

  alignas(32) std::int16_t low[16]{};
  alignas(32) std::int16_t high[16]{};

  /** Splits two whole numbers of at most 2^20. */
  PairWeights(double first, double second)
  {
    const double weights[2] = { first, second };
    for (std::size_t k = 0; k < 16; ++k)
    {
      const double above = std::floor(weights[k % 2] / Step + 0.5);
      low[k] = static_cast<std::int16_t>(weights[k % 2] - Step * above);
      high[k] = static_cast<std::int16_t>(above);
    }
  }
};

/** Values of up to 32 frames in up to 256 pixels. For each pair of frames, the two values of a pixel are adjacent.
 * Values beyond Padded() pixels are not used. */
struct FramePairs
{
  static constexpr std::size_t MostPairs = 16;
  static constexpr std::size_t MostPixels = 256;

  /** Returns the number of pixels that are computed for \a pixels: the next multiple of 32. */
  static constexpr std::size_t
  Padded(std::size_t pixels)
  {
    return (pixels + 31) / 32 * 32;
  }

  alignas(32) std::int16_t values[MostPairs][2 * MostPixels];
};

/** Adds to \a sums of \a pixels pixels \a more and the sum over the pairs of frames of weights times values. All
 * numbers are whole, so the result has the same bits on every processor, with or without SIMD instructions. */
SensorNoise_EXPORT void
AddPairProducts(const FramePairs &               frames,
                const std::vector<PairWeights> & weights,
                double                           more,
                std::size_t                      pixels,
                double *                         sums);

/** Adds the same sums as AddPairProducts(), without SIMD instructions: for unknown processors, and to test the other
 * versions. */
SensorNoise_EXPORT void
AddPairProductsOneByOne(const FramePairs &               frames,
                        const std::vector<PairWeights> & weights,
                        double                           more,
                        std::size_t                      pixels,
                        double *                         sums);

} // namespace sensornoise

#endif
