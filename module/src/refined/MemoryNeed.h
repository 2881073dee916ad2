// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_MemoryNeed_h
#define sensornoise_refined_MemoryNeed_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "correlation/FrameSample.h"
#include "pixels/ProjectionSums.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

/** \class MemoryNeed
 * \brief Memory of RefinedMethod for frames of a size, without the frames that are handed to it [bytes].
 *
 * Computed from the data that are held at the same time, and measured to be enough: documentation/performance.md. */
struct MemoryNeed
{
  std::size_t pixels;
  std::size_t frames;

  /** Returns the memory that is needed for any number of temporal components: the maps, and the data between the
   * passes. It is the least memory limit. */
  double
  Least() const
  {
    return leastBytesPerPixel * static_cast<double>(pixels) + this->OfFrames();
  }
  /** Returns the memory of the third pass without its sums: mean and variance, residual squares and masks. */
  double
  BesideProjections() const
  {
    return mapBytesPerPixel * static_cast<double>(pixels) + this->OfFrames();
  }
  /** Returns the memory of the third pass's sums, for all pixels and \a series temporal components. */
  double
  OfProjections(std::size_t series, SumWidth width) const
  {
    return static_cast<double>(BytesOf(width) * pixels * series);
  }

private:
  static constexpr double leastBytesPerPixel = 64.0;
  static constexpr double mapBytesPerPixel = 34.0;
  static constexpr double bytesPerFrame = 20e3; // the products of pass 2, and a thumbnail

  double
  OfFrames() const
  {
    const std::size_t sample = std::min(SampleTiles::MostValuesOf(pixels), SampleTiles::MostPixels * frames);
    return bytesPerFrame * static_cast<double>(frames) + 4.0 * static_cast<double>(sample);
  }
};

/** Throws std::invalid_argument if \a limitBytes is less than the memory that \a planes frames of the size \a geometry
 * need at once. */
SensorNoise_EXPORT void
RequireMemoryLimit(double limitBytes, const FrameGeometry & geometry, std::size_t frames, std::size_t planes);

} // namespace sensornoise

#endif
