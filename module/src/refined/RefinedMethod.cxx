// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/RefinedMethod.h"

#include "refined/RefinedPasses.h"

#include <memory>
#include <utility>

namespace sensornoise
{

template <typename TPixel>
RefinedMethod<TPixel>::RefinedMethod(const RefinedSettings &           settings,
                                     const FrameGeometry &             geometry,
                                     std::size_t                       frames,
                                     const std::vector<std::uint8_t> & mask,
                                     ParallelFor                       parallelFor)
  : StackMethod<TPixel>(
      std::make_unique<RefinedPasses<TPixel>>(settings, geometry, frames, mask, std::move(parallelFor)))
{}

template <typename TPixel>
void
RefinedMethod<TPixel>::DisableMerging()
{
  static_cast<RefinedPasses<TPixel> &>(*this->m_Passes).DisableMerging();
}

#define SensorNoise_INSTANTIATE(TPixel) template class RefinedMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
