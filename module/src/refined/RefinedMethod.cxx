// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"

#include "base/FreeMemory.h"
#include "base/Text.h"
#include "moments/Exposures.h"
#include "refined/PixelProjections.h"
#include "refined/RefinedPasses.h"
#include "report/StackReport.h"
#include "sensornoise/Settings.h"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{

void
RefinedSettings::Validate() const
{
  ValidateDnSettings(dnSettings);
  ValidateExposures(exposures);
  ValidateExcessNoiseFactor(excessNoiseFactor);
  if (levelRangeDn)
  {
    ValidateLevelRange(*levelRangeDn);
  }
  if (offset &&
      !(std::isfinite(offset->valueDn) && std::isfinite(offset->standardErrorDn) && offset->standardErrorDn >= 0.0))
  {
    throw std::invalid_argument("the offset is " + Text(offset->valueDn) + " DN with a standard error of " +
                                Text(offset->standardErrorDn) +
                                " DN; expected a finite number and a standard error of 0 or more");
  }
}

void
RefinedSettings::RequireOffsetWithin(double limitDn, const std::string & whatOf) const
{
  if (offset && !(std::abs(offset->valueDn) <= limitDn && offset->standardErrorDn <= limitDn))
  {
    throw std::invalid_argument("the offset is " + Text(offset->valueDn) + " DN with a standard error of " +
                                Text(offset->standardErrorDn) + " DN; expected both within " + Text(limitDn) +
                                " DN of 0, " + whatOf);
  }
}

void
RequireMemoryLimit(double limitBytes, const FrameGeometry & geometry, std::size_t frames, std::size_t planes)
{
  const double least = static_cast<double>(planes) * MemoryNeed{ geometry.Pixels(), frames }.Least();
  if (limitBytes < least)
  {
    throw std::invalid_argument("the memory limit is " + TextOfBytes(limitBytes) + "; expected at least " +
                                TextOfBytes(least) + " for " +
                                (planes == 1 ? std::string("frames") : std::to_string(planes) + " planes") + " of " +
                                std::to_string(geometry.width) + " x " + std::to_string(geometry.height) + " pixels");
  }
}

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
