// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_RequiredFlickerZ_h
#define sensornoise_base_RequiredFlickerZ_h

namespace sensornoise
{

/** The flicker tells offset and read noise if its variance exceeds that of its sampling noise by more than this many
 * standard deviations of the latter: of v^* (published), or of the frames along the offset line (refined). */
inline constexpr double RequiredFlickerZ = 6.0;

} // namespace sensornoise

#endif
