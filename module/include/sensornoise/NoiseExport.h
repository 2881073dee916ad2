// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_NoiseExport_h
#define sensornoise_NoiseExport_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/** \file
 * A measured noise model, written for the programs that use one, in their units.
 */

namespace sensornoise
{

/** Error: a noise model cannot be exported. The message says what was found, what was expected, and what to do. */
class SensorNoise_EXPORT ExportError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** Error: the format, the number of reports or a setting cannot be meant, whatever the reports hold. */
class SensorNoise_EXPORT ExportUseError : public ExportError
{
public:
  using ExportError::ExportError;
};

/** The values of a stored report, by their JSON Pointer: "/gain/value", "/channels/0/channel". Values that are null
 * have no entry. */
struct StoredReport
{
  std::string                        name; ///< name of the file, for messages
  std::map<std::string, double>      numbers;
  std::map<std::string, std::string> texts;
};

/** Values that a report lacks, and values that replace its camera settings. */
struct ExportSettings
{
  std::optional<double> blackLevelDn;        ///< black level [DN]; default: the black level of the camera
  std::optional<double> whiteLevelDn;        ///< white level [DN]; default: the camera's
  std::string           channel;             ///< the only channel to be exported: "R", "G1", "G2" or "B"; empty: all
  double                analogueGain{ 1.0 }; ///< analogue gain of the measurement [1], above 0; only for libcamera
  std::optional<double> maxAnalogueIso; ///< ISO above which the gain is digital; only for android; default: none is
};

/** One quantity of a report. */
struct ReportedNumber
{
  std::optional<double> value;         ///< none unless it is identified
  std::optional<double> standardError; ///< none if the method has none
  std::string           status{ "missing" };
};

/** The noise of one channel. The variance of a pixel at the level x is slope times x plus intercept. */
struct ChannelNoise
{
  std::string           channel{ "mono" };       ///< "mono", "R", "G1" (green of the red rows), "G2", "B"
  ReportedNumber        varianceSlope;           ///< a [DN/e-]
  ReportedNumber        totalIntercept;          ///< b [DN^2]
  ReportedNumber        gain;                    ///< g [DN/e-]; it differs from a where the frames were smoothed
  ReportedNumber        offset;                  ///< mu [DN]
  ReportedNumber        readNoise;               ///< sigma [DN]
  std::optional<double> readNoiseElectronsError; ///< standard error of sigma / g [e-]
  std::optional<double> lowestDn;                ///< darkest measured level
  std::optional<double> highestDn;               ///< brightest measured level
  std::optional<double> clipHighDn;              ///< level at which pixels saturate
};

/** Maps of the pixels, row by row; empty where they were not measured. */
struct NoiseMaps
{
  std::size_t         width{ 0 };
  std::size_t         height{ 0 };
  std::vector<double> offsetDn;
  std::vector<double> readNoiseDn;
};

/** The noise of a camera at one setting: all that exports use. */
struct CameraNoise
{
  std::string                 name; ///< name of the report, for messages
  std::string                 camera;
  std::vector<ChannelNoise>   channels; ///< one, or R, G1, G2, B
  std::optional<double>       blackLevelDn;
  std::optional<double>       whiteLevelDn;
  std::optional<double>       isoSpeed;
  std::optional<double>       exposureSeconds; ///< exposure time [s]
  std::optional<unsigned int> bitDepth;        ///< bit depth of the digital numbers [bit]
  std::size_t                 width{ 0 };      ///< columns that were measured, of each plane of a mosaic; 0: not known
  std::size_t                 height{ 0 };     ///< rows that were measured, of each plane of a mosaic; 0: not known
  double                      analogueGain{ 1.0 };
  std::optional<double>       maxAnalogueIso;
  double                      excessNoiseFactor{ 1.0 }; ///< F [1]: the slope of the sensor's variance is F times g
  NoiseMaps                   maps;
};

/** Reads the noise of a camera from a stored report. Throws ExportError if it is no report, or if a setting is not
 * finite, the white level not above the black level, a gain or ISO not above 0, or there is no channel of that name. */
SensorNoise_EXPORT CameraNoise
ReadCameraNoise(const StoredReport & report, const ExportSettings & settings = {});

/** Kind of noise model that a program takes. */
enum class ExportTakes : std::uint8_t
{
  Line,   ///< the variance against the level, in the frames as they are: a and b
  Sensor, ///< parameters of the sensor: g, mu and sigma
  Maps    ///< offset and read noise of each pixel
};

/** Accuracy with which the file represents the model. */
enum class ExportExactness : std::uint8_t
{
  Exact,     ///< to the rounding of its numbers
  Rounded,   ///< a parameter is rounded to a whole number
  Fitted,    ///< the program has a model of another form, which is fitted
  Calibrated ///< the program's numbers differ from the model by a factor that was measured, with an error
};

/** A file to be written. */
struct ExportedFile
{
  std::string name; ///< without a folder
  std::string bytes;
};

/** A noise model in one format. */
struct NoiseExport
{
  std::vector<ExportedFile> files;
  std::string               note; ///< a sentence about the misfit or the use; may be empty
};

/** One format: a row of the table from which help, documentation and tests are made. */
struct ExportFormat
{
  const char *    name{ nullptr };
  const char *    consumer{ nullptr };
  ExportTakes     takes{ ExportTakes::Line };
  ExportExactness exactness{ ExportExactness::Exact };
  const char *    fields{ nullptr }; ///< content of the files
  bool            isText{ true };
  std::size_t     leastReports{ 1 };     ///< settings of the camera that it needs
  bool            takesSeveral{ false }; ///< whether it takes more settings than it needs; false: exactly one
  NoiseExport (*write)(const std::vector<CameraNoise> & settings){ nullptr };
};

/** All formats. */
SensorNoise_EXPORT const std::vector<ExportFormat> &
ExportFormats();

/** "line", "sensor" or "maps". */
SensorNoise_EXPORT const char *
NameOf(ExportTakes takes);

/** "exact", "rounded", "fitted" or "calibrated". */
SensorNoise_EXPORT const char *
NameOf(ExportExactness exactness);

/** The table of the formats as JSON: a list of objects with `name`, `consumer`, `takes`, `exactness`, `fields`,
 * `is_text`, `least_reports` and `takes_several`. */
SensorNoise_EXPORT std::string
ExportFormatsAsJson();

/** Writes the noise of a camera in the format of that name: of one setting, or of several in formats that take them.
 * Throws ExportError if there is no such format, or the noise cannot be written in it. */
SensorNoise_EXPORT NoiseExport
ExportNoise(const std::string & format, const std::vector<CameraNoise> & settings);

/** The pairs (scale, offset) of the tag NoiseProfile of DNG: the standard deviation at the level x is
 * sqrt(scale x + offset), where x is 0 at the black level and 1 at the white level. One pair, or a pair for each of the
 * planes R, G and B; greens are averaged. Throws ExportError as ExportNoise(). */
SensorNoise_EXPORT std::vector<std::pair<double, double>>
NoiseProfileOf(const CameraNoise & noise);

/** Returns a copy of a DNG file, or another TIFF file, with the tag NoiseProfile in its first directory, where Adobe's
 * DNG SDK reads it. Where the first directory is a preview, the tag is also in the raw directory of its SubIFDs (tag
 * 330). Tags that are there are replaced. The pixels and all other tags are the same. Throws ExportError unless \a file
 * is a classic TIFF whose first directory is whole, and so is each directory of a preview's SubIFDs up to the raw one.
 */
SensorNoise_EXPORT std::string
WithNoiseProfile(const std::string & file, const std::vector<std::pair<double, double>> & profile);

/** Sets the levels of an export into a DNG file: BlackLevel and WhiteLevel of its raw directory, to which NoiseProfile
 * refers; of several levels, of a pattern of pixels, their mean. Throws ExportError if \a file is no classic TIFF with
 * the tag DNGVersion, or its tags are damaged, and ExportUseError if \a settings have levels that differ from the
 * levels of the file. */
SensorNoise_EXPORT void
SetLevelsOfDng(const std::string & file, ExportSettings & settings);

} // namespace sensornoise

#endif
