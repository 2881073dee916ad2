// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef Burst_h
#define Burst_h

#include "sensornoise/FrameFile.h"
#include "sensornoise/FrameGeometry.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <string>

namespace sensornoise::browser
{

/** Frames of a burst, from files or simulated. */
struct Burst
{
  FramePixel     pixel{ FramePixel::UnsignedShort };
  FrameGeometry  geometry{};
  std::size_t    frames{ 0 };
  CameraSettings camera{};
  std::string    arguments{ "FRAMES" }; ///< arguments of estimate-sensor-noise for the same files and options
  /** Reads consecutive frames into a buffer, which has room for them. Throws FileError if they cannot be read. */
  std::function<void(std::size_t first, std::size_t count, void * buffer)> read{};
};

/** Options of an estimate, as the options of estimate-sensor-noise with these names. */
struct BurstOptions
{
  std::string  method{ "refined" };                                  ///< "refined", "published" or "single-image"
  std::string  bayer{ "auto" };                                      ///< a pattern, "auto" or "none"
  unsigned int bitDepth{ 0 };                                        ///< [bit]; 0: found
  double       offsetDn{ std::numeric_limits<double>::quiet_NaN() }; ///< dark offset [DN]; NaN: not known
};

/** Function that is called before frames are read: with the pass, from 0, and the fraction of it that is done [1]. */
using BurstProgress = std::function<void(unsigned int pass, double fraction)>;

} // namespace sensornoise::browser

#endif
