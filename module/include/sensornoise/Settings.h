// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Settings_h
#define sensornoise_Settings_h

#include "SensorNoiseExport.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** \file
 * Parameters of both methods, prior knowledge of the dark offset and of the digital numbers, and the camera settings
 * that a file records. */

namespace sensornoise
{

struct DarkMaps; // private

/** Variation of the flicker within a frame. */
enum class RollingShutter : std::uint8_t
{
  Off,  ///< one gamma_t per frame
  Auto, ///< gamma_t(y) if the data show it; sigma_y is found by cross-validation
  Fixed ///< gamma_t(y) with the given sigma_y, section 3.5 of Sur & Gredi\'ac 2015
};

/** Returns the mode with this name: "off", "auto" or "fixed". Throws std::invalid_argument for any other name. */
SensorNoise_EXPORT RollingShutter
RollingShutterOf(const std::string & name);

/** Returns the name of the mode, as RollingShutterOf() reads it. */
SensorNoise_EXPORT const char *
NameOf(RollingShutter mode);

/** Largest absolute level of a setting [DN]. Its powers up to the fourth are finite. */
inline constexpr double LargestLevelDn = 1e30;
/** Largest quantization step of a setting [DN]. It fits into 32 bits. */
inline constexpr double LargestStepDn = 1e9;

/** Given properties of the digital numbers. A property that is null is found from the data. */
struct DnSettings
{
  std::optional<int>    bitDepth;           ///< bit depth of the sensor [bit], 1 to 16
  std::optional<double> clipLowDn;          ///< lowest level that the sensor attains [DN], within LargestLevelDn of 0
  std::optional<double> clipHighDn;         ///< highest level that the sensor attains [DN], above clipLowDn
  std::optional<double> quantisationStepDn; ///< quantization step [DN], above 0, at most LargestStepDn
};

/** Returns the settings for plain numbers. A bit depth or step of 0, or a clip level of NaN, is null in the settings.
 */
SensorNoise_EXPORT DnSettings
MakeDnSettings(unsigned int bitDepth, double clipLowDn, double clipHighDn, double quantisationStepDn);

/** Throws std::invalid_argument if a given property is out of its range. */
SensorNoise_EXPORT void
ValidateDnSettings(const DnSettings & settings);

/** Deprecated: the name of DnSettings in earlier versions. */
using CodeSettings [[deprecated("use DnSettings")]] = DnSettings;

/** Deprecated: the name of MakeDnSettings() in earlier versions. */
[[deprecated("use MakeDnSettings()")]] inline DnSettings
MakeCodeSettings(unsigned int bitDepth, double clipLowDn, double clipHighDn, double quantisationStepDn)
{
  return MakeDnSettings(bitDepth, clipLowDn, clipHighDn, quantisationStepDn);
}

/** Deprecated: the name of ValidateDnSettings() in earlier versions. */
[[deprecated("use ValidateDnSettings()")]] inline void
ValidateCodeSettings(const DnSettings & settings)
{
  ValidateDnSettings(settings);
}

/** Temporal variance of dark frames, with quantization noise: the mean over all pixels that are not defective. Noisy
 * pixels in the tail of the distribution are included. */
struct DarkVariance
{
  double valueDn2{ 0.0 };         ///< mean variance [DN^2]
  double standardErrorDn2{ 0.0 }; ///< standard error of the mean variance [DN^2]
};

/** Read noise of the median pixel, without quantization noise. */
struct MedianReadNoise
{
  double valueDn{ 0.0 };         ///< read noise [DN]
  double standardErrorDn{ 0.0 }; ///< standard error of the read noise [DN]
};

/** Frequency of a sine wave across the frame. */
struct WaveFrequency
{
  double cyclesPerColumn{ 0.0 }; ///< along x [cycles/pixel]
  double cyclesPerRow{ 0.0 };    ///< along y [cycles/pixel]
};

/** Noise of dark frames that pixels have in common: of whole rows, of whole columns, and periodic interference. */
struct StructuredNoise
{
  DarkVariance               variance; ///< the sum of all, which is a part of the variance of the dark frames
  std::vector<WaveFrequency> waves;    ///< the waves of the interference
};

/** Dark offset that is given, or measured with dark frames. Dark frames determine the read noise, too. */
struct KnownOffset
{
  double                         valueDn{ 0.0 };         ///< dark offset [DN], finite
  double                         standardErrorDn{ 0.0 }; ///< standard error of the offset [DN], 0 or more
  std::size_t                    darkFrames{ 0 };        ///< number of dark frames; 0: the offset is given
  std::optional<DarkVariance>    variance{};             ///< null: fewer than two dark frames
  std::optional<MedianReadNoise> readNoiseMedian{};      ///< null: not known
  std::size_t                    numberDefective{ 0 };   ///< number of pixels left out as defective
  double driftVarianceDn2{ 0.0 };                        ///< temporal variance of the common level of all pixels [DN^2]
  std::shared_ptr<const DarkMaps> maps{};                ///< results of every pixel; null: fewer than two dark frames
  std::optional<StructuredNoise>  structured{};          ///< null: not measured
};

/** Range of levels, bounds included. */
struct LevelRange
{
  double lowDn;  ///< lower bound [DN]
  double highDn; ///< upper bound [DN], above lowDn
};

/** All parameters of the refined method. */
struct SensorNoise_EXPORT RefinedSettings
{
  /** Off: the illumination changes by the same factor everywhere. Auto and Fixed: illumination that changes differently
   * over the frame is looked for, as with a rolling shutter, a second light source or bleaching. The method needs no
   * sigma_y.
   */
  RollingShutter rollingShutter{ RollingShutter::Auto };
  /** Dark offset, if it is known. Offset and read noise then need no flicker. Null (default): not known. */
  std::optional<KnownOffset> offset;
  /** Range of the levels in which the variance is fitted; both bounds are finite. The level of a pixel is the mean of
   * its neighbours. For sensors whose response is linear in a part of the range only (EMVA 1288 takes 5 to 95 % of
   * saturation). Null (default): all levels. */
  std::optional<LevelRange> levelRangeDn;
  /** Exposure of each frame, in the order of the frames and in any unit, for example exposure times or irradiations; 0:
   * a dark frame. The values are finite and 0 or more; at least 3 are different. With them the linearity of the
   * response is measured, see LinearityRecord. Empty (default): not given. */
  std::vector<double> exposures;
  /** Excess noise factor F of the sensor [1], 1 or more: the factor by which an amplification of single electrons or
   * photons increases the variance of the shot noise, 2 in an EMCCD. The gain is the slope of the variance, divided by
   * F. 1 (default): no excess noise. */
  double excessNoiseFactor{ 1.0 };
  /** Given properties of the digital numbers; the others are found. */
  DnSettings dnSettings;
  /** Largest memory of the method, without the frames that are added [bytes]; infinite (default): no limit. With less
   * memory the stack is read more often, and the result has the same bits. At least 64 bytes per pixel, 20 kB per frame
   * and 32 MiB are needed. */
  double memoryLimitBytes{ std::numeric_limits<double>::infinity() };

  /** Throws std::invalid_argument if a parameter is out of its range. */
  void
  Validate() const;

  /** Throws std::invalid_argument if the offset is further from 0 than \a limitDn [DN], or if its standard error is
   * larger. \a whatOf describes the limit in the message. */
  void
  RequireOffsetWithin(double limitDn, const std::string & whatOf) const;
};

/** All parameters of the published method, with the values of the paper (Sur & Gredi\'ac 2015) as defaults. */
struct SensorNoise_EXPORT PublishedSettings
{
  /** Significance level of the test that finds pixels moved by vibrations (section 3.1), a probability [1]. With a
   * larger level fewer pixels are kept. */
  double level{ 0.01 };
  /** Quantile of the mean at which the bright set S^* lies (section 3.2) [1], above darkQuantile, at most 1. */
  double brightQuantile{ 0.99 };
  /** Quantile of the mean at which the dark set S_* lies (section 3.2) [1], 0 or more. */
  double darkQuantile{ 0.01 };
  /** Variation of the flicker from row to row (section 3.5). */
  RollingShutter rollingShutter{ RollingShutter::Auto };
  /** sigma_y of (3.28) for RollingShutter::Fixed [rows], above 0, at most 1e5. */
  double sigmaRows{ 50.0 };
  /** Axis along which the shutter travels: 1 = y; 0 = x, with the columns of the frame as rows. */
  unsigned int shutterAxis{ 1 };
  /** Excess noise factor F of the sensor [1], 1 or more. The gain is the slope of the variance, divided by F. */
  double excessNoiseFactor{ 1.0 };
  /** Given properties of the digital numbers; the others are found. */
  DnSettings dnSettings;

  /** Throws std::invalid_argument if a parameter is out of its range. */
  void
  Validate() const;
};

/** Selection of the stack from the recorded frames. It is recorded so that a measurement can be repeated; it changes no
 * number. */
struct StackSelection
{
  std::optional<std::array<std::size_t, 4>>          roi;    ///< x, y, width and height [pixel]; null: whole frames
  std::optional<std::pair<std::size_t, std::size_t>> frames; ///< first frame, and one past the last; null: all
};

/** Settings of the camera, as the file of the frames records them. Each member is a default that the user can overrule.
 * A setting that the file does not record is empty, 0 or NaN, as in the initial value of its member. */
struct CameraSettings
{
  std::string  camera;        ///< maker and model; "": not recorded
  std::string  bayerPattern;  ///< "RGGB", "GRBG", "GBRG" or "BGGR"; "": not recorded
  unsigned int bitDepth{ 0 }; ///< bit depth of the digital numbers [bit]; 0: not recorded
  /** Dark offset (black level) by the maker of the camera [DN]. */
  double blackLevelDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Level at which the sensor saturates, by the maker of the camera [DN]. */
  double whiteLevelDn{ std::numeric_limits<double>::quiet_NaN() };
  double isoSpeed{ std::numeric_limits<double>::quiet_NaN() };        ///< ISO speed [1]
  double exposureSeconds{ std::numeric_limits<double>::quiet_NaN() }; ///< exposure time [s]
  /** Mean of the masked (optical-black) pixels of the frame [DN]; NaN also if they lie in fewer than 8 rows. */
  double opticalBlackDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Standard error of opticalBlackDn, from the scatter of the means of rows [DN]. It contains the noise of rows. */
  double opticalBlackErrorDn{ std::numeric_limits<double>::quiet_NaN() };

  /** Returns whether the file records any setting. */
  bool
  IsKnown() const
  {
    return !camera.empty() || !bayerPattern.empty() || bitDepth > 0 || std::isfinite(blackLevelDn) ||
           std::isfinite(whiteLevelDn) || std::isfinite(isoSpeed) || std::isfinite(exposureSeconds) ||
           std::isfinite(opticalBlackDn);
  }
};

} // namespace sensornoise

#endif
