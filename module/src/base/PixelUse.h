// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_PixelUse_h
#define sensornoise_base_PixelUse_h

#include <cstdint>

namespace sensornoise
{

/** Why a pixel takes part in the estimate of the gain or not: the values of the pixel-use map. */
enum class PixelUse : std::uint8_t
{
  Used = 0,
  Clipped = 1,        ///< a frame holds a clip level
  NotFinite = 2,      ///< a frame holds NaN or infinity
  Vibration = 3,      ///< its gradient is more than noise explains
  Border = 4,         ///< it has no centred difference
  Constant = 5,       ///< it never varies
  FlickerUnknown = 6, ///< the bright set does not reach its row
  Masked = 7,         ///< the user left it out
  NearClip = 8,       ///< it could have come to a clip level, or a neighbour is clipped or not finite
  NotStatic = 9,      ///< its variance does not fit, nor does that of its surroundings: something moved
  Outlier = 10,       ///< its variance is too far from the line, or dark frames show it defective
  CoarseCodes = 11,   ///< its noise is below half a code step
  OutsideRange = 12,  ///< its level is not one that the user wants
  Edge = 13,          ///< frames were filtered, and neighbours of another level mixed their noise in
  MaskedBorder = 14   ///< of a strip along the border that is no part of the scene, as optical-black columns
};

} // namespace sensornoise

#endif
