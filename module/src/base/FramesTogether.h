// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_FramesTogether_h
#define sensornoise_base_FramesTogether_h

#include <cstddef>

namespace sensornoise
{

/** Frames that the second pass multiplies together, at the cost of one: their sums fill the vector registers. So many
 * are handed on at a time at least, however large they are. */
inline constexpr std::size_t FramesTogether = 4;

} // namespace sensornoise

#endif
