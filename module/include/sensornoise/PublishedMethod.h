// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_PublishedMethod_h
#define sensornoise_PublishedMethod_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "sensornoise/StackMethod.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \class PublishedMethod
 * \brief Runs the algorithm of Figure 2 of Sur & Gredi\'ac 2015 in three passes over the stack.
 *
 * https://doi.org/10.1137/140977035. Pass 1 gathers the temporal moments, which give mean, variance, clip levels, the
 * vibration mask and the iso-intensity sets; pass 2 the sums of each frame over the sets, which give flicker and
 * offset; pass 3 the sums of the corrected variance, which gives gain and intercept. Several processes share sums of 32
 * bytes a frame and 8 a frame and row in pass 2, and of 8 bytes a pixel in pass 3.
 *
 * Equal frames are counted once; the flicker is reported for all of them.
 *
 * The bits are the same for any number of threads and any chunks. Memory: 40 bytes a pixel, 8 bytes a frame and row. A
 * stack that cannot be measured ends in a report whose quantities are `failed`, with a warning that says why; wrong use
 * throws std::invalid_argument. */
template <typename TPixel>
class PublishedMethod final : public StackMethod<TPixel>
{
public:
  using Settings = PublishedSettings;

  /** \a mask, if given, has a nonzero value at the pixels to be used; \a parallelFor spreads the work over threads.
   * Throws std::invalid_argument for settings out of range, see PublishedSettings::Validate(), for fewer than 5 frames,
   * frames under 3 x 3 pixels, and a mask of another size. */
  PublishedMethod(const PublishedSettings &         settings,
                  const FrameGeometry &             geometry,
                  std::size_t                       frames,
                  const std::vector<std::uint8_t> & mask = {},
                  ParallelFor                       parallelFor = SerialFor);
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT PublishedMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
