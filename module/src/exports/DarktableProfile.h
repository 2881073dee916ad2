// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_DarktableProfile_h
#define sensornoise_exports_DarktableProfile_h

#include "exports/NoiseProfile.h"

namespace sensornoise
{

class ProfileValues;

/** Reads the presets of all cameras from darktable's noiseprofiles.json. Throws ExportError if a preset has no ISO
 * speed, or no numbers of green, which darktable takes for all channels. */
NoiseProfile
ReadDarktablePresets(const ProfileValues & values);

/** Returns the scale and the offset of NoiseProfile that darktable takes for a burst: the numbers of green over
 * darktable's factor, on a line between the ISO speeds next to the burst's. Throws ExportError if the burst has no ISO
 * speed, or the file no presets of its camera around this speed. A file of one camera is taken for all names. */
ProfileChannel
DarktableChannelAt(const NoiseProfile & profile, const CameraNoise & burst);

} // namespace sensornoise

#endif
