// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_ProfileCheck_h
#define sensornoise_exports_ProfileCheck_h

#include "sensornoise/NoiseModel.h"
#include "exports/ExportFormats.h"
#include "exports/NoiseProfile.h"

#include <optional>
#include <string>
#include <vector>

/** \file
 * Comparison of a noise profile with the variance of frames. */

namespace sensornoise
{

inline double
Squared(double value)
{
  return value * value;
}

/** The variance that a profile gives for one channel of a burst: smoothing (excess slope (x - level) + dark) at the
 * level x [DN]. */
struct ProfileVariance
{
  ProfileForm form{ ProfileForm::Line };
  double      slope{ 0.0 };           ///< [DN/e-]
  double      levelDn{ 0.0 };         ///< black level or dark offset; 0 for a line whose black level is not known
  double      darkDn2{ 0.0 };         ///< variance at that level
  double      unitDn{ 1.0 };          ///< unit in which the file has the root of darkDn2
  double      smoothing{ 1.0 };       ///< variance of smoothed frames over the variance of the sensor [1]
  double      excess{ 1.0 };          ///< excess noise factor of the burst [1], which a sensor's record does not have
  double      floorDn2{ 0.0 };        ///< lowest variance that the program takes
  double      roundingDn2{ 0.0 };     ///< largest error by rounding in the file
  double      relativeError{ 0.0 };   ///< error of the variance, relative [1]
  bool        isOfDarktable{ false }; ///< whether the variance depends on the demosaicing of darktable
  bool        hasReadNoise{ true };   ///< false: darkDn2 is the variance of the burst
  /** Whether the dark offset of the file changes the variance. False: neither a read noise nor a dark level is known.
   */
  bool           isOffsetTested{ true };
  LibcameraNoise root;   ///< model that replaces slope and darkDn2, if the form is Root
  CameraNoise    camera; ///< camera of the burst, which has the levels of libcamera's model

  /** Returns the variance at a level [DN^2]. */
  double
  At(double levelDn) const;

  /** Returns the relative error of the variance at a level that the file cannot avoid: its rounding, the error of
   * darktable's factor, and in libcamera's form the deviation from the line of the burst [1]. */
  double
  UnavoidableErrorAt(double levelDn) const;
};

/** Returns the dark level of the burst: its offset if it is identified, else its black level; none: neither. */
std::optional<double>
DarkLevelOf(const CameraNoise & burst);

/** Returns the variance that a profile gives for the only channel of \a burst. A sensor's file that lacks the offset or
 * the read noise gets it from the burst. Throws ExportError if the profile has no such channel, or the burst lacks a
 * black or white level, bit depth, ISO speed or offset that the profile needs. */
ProfileVariance
VarianceOfProfile(const NoiseProfile & profile, const CameraNoise & burst);

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

/** The check of a profile on one channel of the frames: a result, or the reason why there is none. */
struct ChannelProfileCheck
{
  std::string                    channel; ///< "mono", "R", "G1", "G2" or "B"
  std::optional<NoiseModelCheck> check;
  std::string                    reason; ///< a sentence; "": there is a check
};

/** Compares the variance of frames with the variance that a profile of another program gives, channel by channel, by
 * CheckNoiseProfile().
 * \param profile noise profile
 * \param frames stored report of the refined method on the frames
 * \param noise the same report as exports use it, with the black and the white level and all of its channels
 * \throws ExportError if the report has no noise curve. */
SensorNoise_EXPORT std::vector<ChannelProfileCheck>
CheckStoredFrames(const NoiseProfile & profile, const StoredReport & frames, const CameraNoise & noise);

} // namespace sensornoise

#endif
