// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_ProfileCheck_h
#define sensornoise_exports_ProfileCheck_h

#include "exports/NoiseProfile.h"
#include "sensornoise/NoiseModel.h"

namespace sensornoise
{

/** Compares the variance of frames with the variance that a profile of another program gives, by intensity bands. A
 * band fits if the ratio is within 0.05 of 1 or within four standard errors; rounding in the file, and the error of
 * libcamera's form, come on top. The ratio is the variance of the frames over the variance of the profile.
 *
 * If a band does not fit, the sentence names the mistakes with which the profile would agree in all bands. They are
 * transformations of the profile without free parameters: e-/ADU and ADU/e- exchanged, the variance in e-^2, another
 * black level, the read noise in another unit or as a variance, and a factor that is a power of two.
 * \param profile noise profile
 * \param frames report of the refined method on the frames, of one channel
 * \param burst the same report as exports use it, with the black and the white level; its only channel
 * \throws ExportError if the burst lacks what the profile needs, see VarianceOfProfile(). */
SensorNoise_EXPORT NoiseModelCheck
CheckNoiseProfile(const NoiseProfile & profile, const Report & frames, const CameraNoise & burst);

} // namespace sensornoise

#endif
