// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_RefinedMethod_h
#define sensornoise_RefinedMethod_h

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

/** \class RefinedMethod
 * \brief Estimates gain, offset and read noise at the theoretical limit, in three passes over the stack.
 *
 * Pass 1 gathers the temporal moments: the mean image, an initial noise model, the clipped pixels. Pass 2 regresses
 * every frame on the mean image and its derivatives: the temporal components of flicker, local illumination and motion,
 * and the offset. Pass 3 projects the time series of every pixel on these components; the rest is sensor noise, whose
 * regression on the mean gives gain and intercept. Where the illumination changes strongly, the stack is read once more
 * between passes 1 and 2. Several processes share sums of 16 kB a frame in pass 2, of 8 bytes a pixel and component in
 * pass 3, and of 8 bytes a pixel in the additional one.
 *
 * The result of a stack with repeated frames is that of the distinct frames. The series of the report repeat the values
 * of the first of equal frames.
 *
 * The bits are the same for any number of threads and any chunks. Memory: 56 bytes a pixel and 8 more for each
 * component of illumination and motion that is found (2 to 20), 20 kB a frame, and 32 MiB. A stack that cannot be
 * measured ends in a report whose quantities are `failed`, with a warning that says why; wrong use throws
 * std::invalid_argument. */
template <typename TPixel>
class RefinedMethod final : public StackMethod<TPixel>
{
public:
  using Settings = RefinedSettings;

  /** \a mask, if given, has a nonzero value at the pixels to be used; \a parallelFor spreads the work over threads.
   * Throws std::invalid_argument for settings out of range, see RefinedSettings::Validate(), for fewer than 5 frames,
   * frames under 3 x 3 pixels, and a mask of another size. */
  RefinedMethod(const RefinedSettings &           settings,
                const FrameGeometry &             geometry,
                std::size_t                       frames,
                const std::vector<std::uint8_t> & mask = {},
                ParallelFor                       parallelFor = SerialFor);

  /** Promises that no sums of the third pass will be saved or merged. Where all frames are added to it together, it
   * then needs no memory for sums. Call it before the third pass. */
  void
  DisableMerging();
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT RefinedMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
