// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_ChosenFrames_h
#define sensornoise_moments_ChosenFrames_h

#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Calls function(frames, number) with the frames that \a isChosen selects, in order and contiguous in memory. If all
 * frames are chosen, they are passed in place. Otherwise copies are passed, at most 32 MiB or one frame at a time.
 * \a frames holds as many frames as \a isChosen has flags. */
template <typename TPixel, typename TFunction>
void
ForChosenFrames(const TPixel *                    frames,
                std::size_t                       pixels,
                const std::vector<std::uint8_t> & isChosen,
                const ParallelFor &               parallelFor,
                TFunction                         function)
{
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < isChosen.size(); ++k)
  {
    if (isChosen[k] != 0)
    {
      chosen.push_back(k);
    }
  }
  if (chosen.empty() || chosen.size() == isChosen.size())
  {
    if (!chosen.empty())
    {
      function(frames, chosen.size());
    }
    return;
  }
  const std::size_t   together = std::max<std::size_t>(1, (std::size_t{ 32 } << 20) / (pixels * sizeof(TPixel)));
  std::vector<TPixel> copies(std::min(together, chosen.size()) * pixels);
  for (std::size_t first = 0; first < chosen.size(); first += together)
  {
    const std::size_t number = std::min(together, chosen.size() - first);
    parallelFor(number, [&](std::size_t k) {
      std::copy_n(frames + chosen[first + k] * pixels, pixels, copies.data() + k * pixels);
    });
    function(static_cast<const TPixel *>(copies.data()), number);
  }
}

} // namespace sensornoise

#endif
