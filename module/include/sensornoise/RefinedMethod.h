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
 * Pass 1 sums the temporal moments, which give the mean image, an initial noise model and the clipped pixels. Pass 2
 * regresses every frame on the mean image and its derivatives. It gives the offset and the temporal components of
 * flicker, local illumination and motion. Pass 3 projects the time series of every pixel on these components. The
 * residual is sensor noise, and the regression of its variance on the mean gives gain and intercept. If the
 * illumination changes strongly, the stack is read once more between passes 1 and 2. Several processes exchange sums of
 * 16 kB per frame in pass 2, of 4 or 8 bytes per pixel and component in pass 3, and of 8 bytes per pixel in the
 * additional pass.
 *
 * A stack with repeated frames has the result of its distinct frames. The series of the report have the same value for
 * equal frames.
 *
 * The result has the same bits for any number of threads and any chunks. The method needs 56 bytes per pixel, 4 bytes
 * per pixel and component of illumination and motion (2 to 20 are found), or 8 bytes (large changes of the illumination
 * at 16 bits, floating-point pixels), 20 kB per frame, and 32 MiB. A stack that cannot be measured gives a report whose
 * quantities have `failed`, with a warning that names the reason. Wrong use throws std::invalid_argument. */
template <typename TPixel>
class RefinedMethod final : public StackMethod<TPixel>
{
public:
  using Settings = RefinedSettings;

  /** Starts the first pass.
   * \param settings settings of the method
   * \param geometry size of a frame, at least 3 x 3 pixels
   * \param frames number of frames of the stack, at least 5
   * \param mask for each pixel a nonzero value if it is to be used; empty: all
   * \param parallelFor spreads the work over threads
   * \throws std::invalid_argument for settings out of range, see RefinedSettings::Validate(), for fewer or smaller
   * frames, for a mask or exposures of another size, and for a memory limit below the least need. */
  RefinedMethod(const RefinedSettings &           settings,
                const FrameGeometry &             geometry,
                std::size_t                       frames,
                const std::vector<std::uint8_t> & mask = {},
                ParallelFor                       parallelFor = SerialFor);

  /** Declares that no sums of the third pass will be saved or merged. If all frames are then added to this pass in one
   * call of AddFrames(), it needs no memory for sums. Call it before the third pass. If it is called before the first
   * pass ends, it holds for the additional pass under strongly changing illumination, too. */
  void
  DisableMerging();
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT RefinedMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
