// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_FramesTogether_h
#define sensornoise_base_FramesTogether_h

#include <cstddef>

namespace sensornoise
{

/** Number of frames that the second pass multiplies together, at the cost of one: their sums fill the SIMD registers.
 * At least this number of frames is passed on at a time, for any size of frames. */
inline constexpr std::size_t FramesTogether = 4;

} // namespace sensornoise

#endif
