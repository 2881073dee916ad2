// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_NoiseProfile_h
#define sensornoise_exports_NoiseProfile_h

#include "sensornoise/NoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Longest name of a member of a profile [bytes], which the path of each member below it holds, too. Chosen: names have
 * 40. */
inline constexpr std::size_t MostProfileNameBytes = 256;

/** The form in which a file gives the variance of a pixel at the level x. B is the black level, W the white level [DN].
 */
enum class ProfileForm : std::uint8_t
{
  Line,       ///< scale x + constant
  Normalised, ///< (W - B)^2 (scale y + constant) with y = (x - B) / (W - B)
  Sensor,     ///< (x - offset) / scale + (constant / scale)^2, with scale in e-/DN and constant in e-
  Root        ///< libcamera: ((constant + scale / 1.4 sqrt(k (x - B))) / k)^2, k levels of 16 bits per DN
};

/** The numbers of one channel of a profile. ProfileForm says what they mean. */
struct ProfileChannel
{
  std::string           channel{ "mono" }; ///< "mono": of all channels; else "R", "G", "G1", "G2", "B"
  double                scale{ 0.0 };
  std::optional<double> constant; ///< none: the file has no read noise
  std::optional<double> offsetDn; ///< dark offset, only of sensors; none: the file has none
};

/** Noise model of Android, which depends on the ISO speed: S = A iso + B, O = C iso^2 + D d^2 with d = max(1, iso /
 * max). */
struct AndroidProfile
{
  std::vector<std::string> channels;
  std::vector<double>      a;
  std::vector<double>      b;
  std::vector<double>      c;
  std::vector<double>      d;
  std::optional<double>    maxAnalogueIso;
};

/** Numbers of green in a preset of darktable: the variance of the details of demosaiced images, a x + b on [0, 1]. */
struct DarktableNumbers
{
  std::string camera; ///< maker and model
  double      isoSpeed{ 0.0 };
  double      a{ 0.0 };
  double      b{ 0.0 };
};

/** The noise that a file of another program claims. */
struct NoiseProfile
{
  std::string                   file;   ///< its name, for messages
  std::string                   format; ///< of ExportFormats(), or "report"
  ProfileForm                   form{ ProfileForm::Line };
  std::vector<ProfileChannel>   channels;
  std::optional<double>         blackLevelDn;         ///< the file's own; none: the camera's
  std::optional<double>         whiteLevelDn;         ///< the file's own; none: the camera's
  double                        floorDn2{ 0.0 };      ///< lowest variance that the program takes
  double                        roundingDn2{ 0.0 };   ///< largest error of the variance by rounding in the file
  double                        relativeError{ 0.0 }; ///< error of the variance, relative [1]
  std::optional<AndroidProfile> android;              ///< numbers of all ISO speeds, in place of the channels
  std::vector<DarktableNumbers> darktable;            ///< presets of all cameras, in place of the channels
};

/** Reads a noise profile from values by JSON Pointer, as a JSON or YAML file has them: a report, or a format of
 * libcamera, Android, darktable, ndsafir, anscombe-transform, deepinv, SMAP, ccdproc, LSST, PYME, picasso or DECODE.
 * Throws ExportError if it is of none, holds a number that its program does not take, or does not determine the
 * variance. */
SensorNoise_EXPORT NoiseProfile
ReadNoiseProfile(const StoredReport & values);

/** Reads a noise profile from the bytes of a file that is no JSON: a DNG file with NoiseProfile or its numbers as text,
 * CAREamics' npz, YAML of PYME, picasso or DECODE, emva1288's XML, ThunderSTORM's macro, a FITS header. Throws
 * ExportError if it is of none, is damaged, or does not determine the variance. */
SensorNoise_EXPORT NoiseProfile
ReadNoiseProfile(const std::string & file, const std::string & bytes);

} // namespace sensornoise

#endif
