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
 * The paper is https://doi.org/10.1137/140977035. Pass 1 sums the temporal moments, which give mean, variance, clip
 * levels, the vibration mask and the iso-intensity sets. Pass 2 sums each frame over these sets, which gives flicker
 * and offset. Pass 3 sums the corrected variance, which gives gain and intercept. Several processes exchange sums of 32
 * bytes per frame and 8 bytes per frame and row in pass 2, and of 8 bytes per pixel in pass 3.
 *
 * Equal frames are counted once. The flicker is reported for all of them.
 *
 * The result has the same bits for any number of threads and any chunks. The method needs 40 bytes per pixel and 8
 * bytes per frame and row. A stack that cannot be measured gives a report whose quantities have `failed`, with a
 * warning that names the reason. Wrong use throws std::invalid_argument. */
template <typename TPixel>
class PublishedMethod final : public StackMethod<TPixel>
{
public:
  using Settings = PublishedSettings;

  /** Starts the first pass.
   * \param settings settings of the method
   * \param geometry size of a frame, at least 3 x 3 pixels
   * \param frames number of frames of the stack, at least 5
   * \param mask for each pixel a nonzero value if it is to be used; empty: all
   * \param parallelFor spreads the work over threads
   * \throws std::invalid_argument for settings out of range, see PublishedSettings::Validate(), for fewer frames or
   * smaller frames, and for a mask of another size. */
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
