// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/PublishedMethod.h"

#include "base/Text.h"
#include "published/PublishedPasses.h"
#include "published/Vibration.h"
#include "report/StackSettings.h"
#include "sensornoise/Settings.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{

void
PublishedSettings::Validate() const
{
  ChiSquare2Quantile(level);
  if (!(darkQuantile >= 0.0 && darkQuantile < brightQuantile && brightQuantile <= 1.0))
  {
    throw std::invalid_argument("the dark and bright quantiles are " + Text(darkQuantile) + " and " +
                                Text(brightQuantile) + "; expected 0 <= dark < bright <= 1");
  }
  if (rollingShutter == RollingShutter::Fixed)
  {
    ValidateShutterRows(sigmaRows);
  }
  if (shutterAxis > 1)
  {
    throw std::invalid_argument("the shutter axis is " + std::to_string(shutterAxis) + "; expected 0 (x) or 1 (y)");
  }
  ValidateCodeSettings(codes);
  ValidateExcessNoiseFactor(excessNoiseFactor);
}

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
