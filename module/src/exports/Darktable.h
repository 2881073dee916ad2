// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_Darktable_h
#define sensornoise_exports_Darktable_h

#include "exports/NoiseProfile.h"
#include "sensornoise/NoiseExport.h"

#include <vector>

namespace sensornoise
{

class ProfileValues;

/** Variance that darktable's noise profiles hold, over the variance of the pixels of the mosaic [1]. */
struct DarktableFactor
{
  double value{ 0.0 };
  double standardDeviation{ 0.0 }; ///< between levels, gains and colours of the illumination
};

// Source: examples/python/calibrate_darktable.py --images 4, with darktable-cli 4.2.1 and its default demosaicing, RCD.
// darktable's tool takes the diagonal details of a Haar transform of demosaiced images, (p - q - r + s) / 4 of the four
// pixels of a square, which are smaller than 1/4 of the variance where demosaicing has smoothed.

/** Factor of green, under illumination of any colour. */
inline constexpr DarktableFactor darktableGreen{ 0.0463, 0.0007 };
/** Factor of green by the demosaicing PPG, with which a preset may have been measured [1]. */
inline constexpr double darktableGreenPpg = 0.0783;
/** Factor of red and of blue, under illumination in which R, G and B are equal. The details of red and blue contain
 * noise of green: where red or blue have a fraction of green's level, the factor is larger, 0.15 at a third. */
inline constexpr DarktableFactor darktableRedBlue{ 0.0730, 0.0002 };
/** Factor of pixels that are not demosaiced: exact for white noise. */
inline constexpr DarktableFactor darktableMono{ 0.25, 0.0 };

/** The presets of a camera, JSON in the form of darktable's noiseprofiles.json: for each ISO speed a and b of R, G and
 * B, the scale and the offset of NoiseProfile times darktable's factors. darktable 4.2 takes the numbers of green for
 * all channels. The note has the errors of the factors. Throws ExportError if a report has no ISO speed, two have the
 * same, or their channels differ. */
NoiseExport
ExportDarktable(const std::vector<CameraNoise> & settings);

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
