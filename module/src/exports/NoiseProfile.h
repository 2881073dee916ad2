// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_NoiseProfile_h
#define sensornoise_exports_NoiseProfile_h

#include "exports/ExportFormats.h"
#include "sensornoise/NoiseExport.h"
#include "sensornoise/NoiseModel.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** \file
 * The noise model that a file of another program states, the readers of such files, and the comparison with the
 * variance of frames. */

namespace sensornoise
{

/** Longest name of a member of a profile [bytes]. The path of each member below it contains the name. Chosen
 * empirically: names have up to 40 bytes. */
inline constexpr std::size_t MostProfileNameBytes = 256;

/** The form in which a file gives the variance of a pixel at the level x. B is the black level, W the white level [DN].
 */
enum class ProfileForm : std::uint8_t
{
  Line,       ///< scale x + constant
  Normalised, ///< (W - B)^2 (scale y + constant) with y = (x - B) / (W - B)
  Sensor,     ///< (x - offset) / scale + (constant / scale)^2, with scale in e-/DN and constant in e-
  Root        ///< libcamera: G ((constant + scale / 1.4 sqrt(k (x - B))) / k)^2, k levels of 16 bits per DN, gain G
};

/** The numbers of one channel of a profile. ProfileForm defines their meaning. */
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

/** The noise model that a file of another program states. */
struct NoiseProfile
{
  std::string                   file;   ///< name of the file, for messages
  std::string                   format; ///< a name of ExportFormats(), or "report"
  ProfileForm                   form{ ProfileForm::Line };
  std::vector<ProfileChannel>   channels;
  std::optional<double>         blackLevelDn;         ///< black level in the file; none: the level of the camera
  std::optional<double>         whiteLevelDn;         ///< white level in the file; none: the level of the camera
  double                        floorDn2{ 0.0 };      ///< lowest variance that the program takes
  double                        roundingDn2{ 0.0 };   ///< largest error of the variance by rounding in the file
  double                        relativeError{ 0.0 }; ///< error of the variance, relative [1]
  std::optional<AndroidProfile> android;              ///< numbers of all ISO speeds, in place of the channels
  std::vector<DarktableNumbers> darktable;            ///< presets of all cameras, in place of the channels
};

/** Reads a noise profile from values by JSON Pointer, as a JSON or YAML file has them: a report, or a format of
 * libcamera, Android, darktable, ndsafir, anscombe-transform, deepinv, SMAP, ccdproc, LSST, PYME, picasso or DECODE.
 * Throws ExportError if the file has none of these formats, holds a number that its program does not accept, or does
 * not determine the variance. */
SensorNoise_EXPORT NoiseProfile
ReadNoiseProfile(const StoredReport & values);

/** Reads a noise profile from the bytes of a file that is no JSON: a DNG file with NoiseProfile or its numbers as text,
 * CAREamics' npz, YAML of PYME, picasso or DECODE, emva1288's XML, ThunderSTORM's macro, a FITS header. Throws
 * ExportError if the file has none of these formats, is damaged, or does not determine the variance. */
SensorNoise_EXPORT NoiseProfile
ReadNoiseProfile(const std::string & file, const std::string & bytes);

/** The values of a noise profile, by the names of its members, wherever they stand in the file. */
class ProfileValues
{
public:
  /** Takes the values of a file, by JSON Pointer. */
  explicit ProfileValues(StoredReport record)
    : m_Record(std::move(record))
  {}

  /** Returns the name of the file, for messages. */
  const std::string &
  File() const
  {
    return m_Record.name;
  }

  const StoredReport &
  Record() const
  {
    return m_Record;
  }

  /** Returns whether a member of this name is a number, or holds values. */
  bool
  Has(const std::string & member) const;

  /** Returns the only number with this name; none if there is none. A name may have several parts: "gain/value". Throws
   * ExportError if the file has several: a profile of several cameras or modes does not name the camera or mode that is
   * meant. */
  std::optional<double>
  Find(const std::string & member) const;

  /** Returns the only number with this name. Throws ExportError if there is none, or several, or it is not finite. */
  double
  Number(const std::string & member) const;

  /** Returns the only number with this name. Throws ExportError as Number(), or if it is not above 0. */
  double
  Positive(const std::string & member) const;

  /** Returns the only number with this name. Throws ExportError as Number(), or if it is negative. */
  double
  NotNegative(const std::string & member) const;

  /** Returns the numbers of a list, "/list/0", "/list/1" and so on. */
  std::vector<double>
  List(const std::string & list) const;

  /** Returns the texts of a list. */
  std::vector<std::string>
  Texts(const std::string & list) const;

private:
  StoredReport m_Record;
};

/** Returns the values of nested YAML mappings, "name: value" with indentation, as in records of cameras. Lists and flow
 * style are not read. */
StoredReport
ReadYamlValues(const std::string & file, const std::string & text);

/** Returns the arrays of a NumPy archive (.npz) by their names, the values in the order of the file. Throws ExportError
 * unless \a bytes are a whole ZIP file, whose members are not compressed and are arrays of float or double of little
 * endian. */
std::map<std::string, std::vector<double>>
ReadNpz(const std::string & bytes);

class ProfileValues;

/** Variance that darktable's noise profiles hold, over the variance of the pixels of the mosaic [1]. */
struct DarktableFactor
{
  double value{ 0.0 };
  double standardDeviation{ 0.0 }; ///< between levels, gains and colours of the illumination
};

// The source is `examples/python/calibrate_darktable.py --images 4`, with darktable-cli 4.2.1 and its default
// demosaicing, RCD. The tool of darktable takes the diagonal details of a Haar transform of demosaiced images. They are
// (p - q - r + s) / 4 for the four pixels of a tile. Where demosaicing has smoothed, their variance is below 1/4 of the
// variance of a pixel.

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

/** Returns the variance that a profile gives for the only channel of \a burst. If the file of a sensor lacks the offset
 * or the read noise, the burst supplies it. Throws ExportError if the profile has no such channel, or the burst lacks a
 * black or white level, bit depth, ISO speed or offset that the profile needs. */
ProfileVariance
VarianceOfProfile(const NoiseProfile & profile, const CameraNoise & burst);

/** Compares the variance of frames with the variance that a profile of another program gives, by intensity bands. A
 * band fits if the ratio is within 0.05 of 1 or within four standard errors; rounding in the file, and the error of the
 * form of libcamera, are added to these limits. The ratio is the variance of the frames over the variance of the
 * profile.
 *
 * If a band does not fit, the sentence names the mistakes with which the profile would agree in all bands. They are
 * transformations of the profile without free parameters: e-/ADU and ADU/e- exchanged, the variance in e-^2, another
 * black level, the read noise in another unit or as a variance, and a factor that is a power of two.
 * \param profile noise profile
 * \param frames report of the refined method on the frames, of one channel
 * \param burst this report as exports use it, with the black and the white level; its only channel
 * \throws ExportError if the burst lacks a number that the profile needs, see VarianceOfProfile(). */
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
 * \param noise this report as exports use it, with the black and the white level and all of its channels
 * \throws ExportError if the report has no noise curve. */
SensorNoise_EXPORT std::vector<ChannelProfileCheck>
CheckStoredFrames(const NoiseProfile & profile, const StoredReport & frames, const CameraNoise & noise);

} // namespace sensornoise

#endif
