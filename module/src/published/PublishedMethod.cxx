// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/PublishedMethod.h"

#include "published/PublishedPasses.h"

#include <memory>
#include <utility>

namespace sensornoise
{

template <typename TPixel>
PublishedMethod<TPixel>::PublishedMethod(const PublishedSettings &         settings,
                                         const FrameGeometry &             geometry,
                                         std::size_t                       frames,
                                         const std::vector<std::uint8_t> & mask,
                                         ParallelFor                       parallelFor)
  : StackMethod<TPixel>(
      std::make_unique<PublishedPasses<TPixel>>(settings, geometry, frames, mask, std::move(parallelFor)))
{}

#define SensorNoise_INSTANTIATE(TPixel) template class PublishedMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
