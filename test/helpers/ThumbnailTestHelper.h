// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_ThumbnailTestHelper_h
#define sensornoise_test_ThumbnailTestHelper_h

#include "moments/FrameThumbnails.h"

#include <cstddef>
#include <numeric>
#include <vector>

namespace sensornoise::test
{

inline std::vector<std::size_t>
AllFrames(const FrameThumbnails & thumbnails)
{
  std::vector<std::size_t> frames(thumbnails.NumberOfFrames());
  std::iota(frames.begin(), frames.end(), std::size_t{ 0 });
  return frames;
}

} // namespace sensornoise::test

#endif
