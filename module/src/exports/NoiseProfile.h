// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_NoiseProfile_h
#define sensornoise_exports_NoiseProfile_h

#include "sensornoise/NoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** \file
 * The noise that a file of another program claims, and the readers of such files. */

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
  std::string                   format; ///< a name of ExportFormats(), or "report"
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
   * ExportError if the file has several: a profile of several cameras or modes does not say which one is meant. */
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

/** Returns the values of YAML of nested mappings, "name: value" with indentation: what cameras' records are made of.
 * Lists and flow style are not read. */
StoredReport
ReadYamlValues(const std::string & file, const std::string & text);

/** Returns the arrays of a NumPy archive (.npz) by their names, the values in the order of the file. Throws ExportError
 * unless \a bytes are a whole ZIP file, whose members are not compressed and are arrays of float or double of little
 * endian. */
std::map<std::string, std::vector<double>>
ReadNpz(const std::string & bytes);

} // namespace sensornoise

#endif
