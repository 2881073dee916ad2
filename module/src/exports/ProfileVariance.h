// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_ProfileVariance_h
#define sensornoise_exports_ProfileVariance_h

#include "exports/FittedExports.h"
#include "exports/NoiseProfile.h"

#include <optional>

namespace sensornoise
{

inline double
Squared(double value)
{
  return value * value;
}

/** The variance that a profile gives for one channel of a burst: slope (x - level) + dark at the level x [DN]. */
struct ProfileVariance
{
  ProfileForm form{ ProfileForm::Line };
  double      slope{ 0.0 };           ///< [DN/e-]
  double      levelDn{ 0.0 };         ///< black level or dark offset; 0 for a line whose black level is not known
  double      darkDn2{ 0.0 };         ///< variance at that level
  double      unitDn{ 1.0 };          ///< unit in which the file has the root of darkDn2
  double      smoothing{ 1.0 };       ///< variance of smoothed frames over the variance of the sensor [1]
  double      floorDn2{ 0.0 };        ///< lowest variance that the program takes
  double      roundingDn2{ 0.0 };     ///< largest error by rounding in the file
  double      relativeError{ 0.0 };   ///< error of the variance, relative [1]
  bool        isOfDarktable{ false }; ///< whether the variance depends on the demosaicing of darktable
  bool        hasReadNoise{ true };   ///< false: darkDn2 is the variance of the burst
  /** Whether the dark offset of the file changes the variance. False: neither a read noise nor a dark level is known.
   */
  bool           isOffsetTested{ true };
  LibcameraNoise root;   ///< in place of slope and darkDn2, if the form is Root
  CameraNoise    camera; ///< of the burst: the levels of libcamera's model

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

} // namespace sensornoise

#endif
