// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Settings_h
#define sensornoise_Settings_h

#include "SensorNoiseExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** \file
 * Parameters of both methods, and what is known beforehand of the dark offset and of the digital numbers. */

namespace sensornoise
{

struct DarkMaps; // private

/** How the flicker may vary inside a frame. */
enum class RollingShutter : std::uint8_t
{
  Off,  ///< one gamma_t a frame
  Auto, ///< gamma_t(y) where the data show it, sigma_y by cross-validation
  Fixed ///< gamma_t(y) with the given sigma_y, section 3.5
};

/** The mode of a name: "off", "auto" or "fixed". Throws std::invalid_argument for others. */
SensorNoise_EXPORT RollingShutter
RollingShutterOf(const std::string & name);

/** The name of a mode. */
SensorNoise_EXPORT const char *
NameOf(RollingShutter mode);

/** The largest level that a setting may name, without its sign [DN]: its powers, up to the fourth, are finite. */
inline constexpr double LargestLevelDn = 1e30;
/** The largest spacing of codes that may be given [DN]: it fits into 32 bits. */
inline constexpr double LargestStepDn = 1e9;

/** What the user says about the codes of the data; what is not said is found. */
struct CodeSettings
{
  std::optional<int>    bitDepth;           ///< bits of the sensor's codes, 1 to 16
  std::optional<double> clipLowDn;          ///< lowest level that the sensor attains [DN]
  std::optional<double> clipHighDn;         ///< highest level that the sensor attains [DN]
  std::optional<double> quantisationStepDn; ///< spacing of the codes [DN]
};

/** Settings from plain numbers: a bit depth or step of 0, and a clip level of NaN, is to be found. */
SensorNoise_EXPORT CodeSettings
MakeCodeSettings(unsigned int bitDepth, double clipLowDn, double clipHighDn, double quantisationStepDn);

/** Throws std::invalid_argument if what the user says of the codes is out of range. */
SensorNoise_EXPORT void
ValidateCodeSettings(const CodeSettings & codes);

/** Temporal variance of dark frames, that of rounding to whole codes included, and its standard error: the mean over
 * all pixels that are not defective, the noisy ones of the tail among them. */
struct DarkVariance
{
  double valueDn2{ 0.0 };
  double standardErrorDn2{ 0.0 };
};

/** Read noise of the median pixel, that of rounding to whole codes taken off, and its standard error. */
struct MedianReadNoise
{
  double valueDn{ 0.0 };
  double standardErrorDn{ 0.0 };
};

/** An offset that is known from elsewhere: given, or measured with dark frames, which tell the read noise, too. */
struct KnownOffset
{
  double                          valueDn{ 0.0 };
  double                          standardErrorDn{ 0.0 };
  std::size_t                     darkFrames{ 0 };         ///< frames that it was measured with; 0: it was given
  std::optional<DarkVariance>     variance{};              ///< null: fewer than two dark frames
  std::optional<MedianReadNoise>  readNoiseMedian{};       ///< null: not known
  std::size_t                     numberDefective{ 0 };    ///< pixels left out as defective
  double                          driftVarianceDn2{ 0.0 }; ///< over time, of the level common to all pixels [DN^2]
  std::shared_ptr<const DarkMaps> maps{};                  ///< of every pixel; null: fewer than two dark frames
};

/** Levels from low to high. */
struct LevelRange
{
  double lowDn;
  double highDn;
};

/** Every parameter of the refined method. */
struct SensorNoise_EXPORT RefinedSettings
{
  /** Off: the light changes everywhere alike. Otherwise light that changes in some places in another way than in
   * others (a rolling shutter, a second lamp, a patch that bleaches) is looked for, and needs no width. */
  RollingShutter rollingShutter{ RollingShutter::Auto };
  /** The offset, if it is known: offset and read noise then need no flicker. */
  std::optional<KnownOffset> offset;
  /** Levels between which the variance is fitted, of a pixel's neighbours [DN]; null: all. For sensors whose response
   * is straight in a part of its range (EMVA 1288 takes 5 to 95 % of saturation). */
  std::optional<LevelRange> levelRangeDn;
  /** Exposure of each frame, in the order of the frames, in any unit: exposure times, or irradiations; 0: a dark frame.
   * Finite, 0 or more, at least 3 different values. With them the linearity of the response is measured, see
   * LinearityRecord. Empty (default): not given. */
  std::vector<double> exposures;
  /** Excess noise factor F of the sensor [1]: what an amplification of single electrons or photons makes of the
   * variance of their shot noise, 2 in an EMCCD. The gain is the slope of the variance, divided by F. 1 or more; 1
   * (default): none. */
  double excessNoiseFactor{ 1.0 };
  /** What is known of the codes; the rest is found. */
  CodeSettings codes;
  /** Most that the method may hold, beside the frames that it is handed [bytes]; infinite: what it needs. The stack is
   * read more often if it is less, with the same bits. At least 64 bytes a pixel, 20 kB a frame and 32 MiB. */
  double memoryLimitBytes{ std::numeric_limits<double>::infinity() };

  /** Throws std::invalid_argument if a parameter is out of its range. */
  void
  Validate() const;

  /** Throws std::invalid_argument if the offset, or its standard error, is further from 0 than \a limitDn [DN], which
   * is \a whatOf the data. */
  void
  RequireOffsetWithin(double limitDn, const std::string & whatOf) const;
};

/** Every parameter of the published method, with the paper's values (Sur & Gredi\'ac 2015). */
struct SensorNoise_EXPORT PublishedSettings
{
  /** Level of the test that finds pixels moved by vibrations (section 3.1), a probability. Larger: fewer pixels kept.
   */
  double level{ 0.01 };
  /** Quantiles of the mean at which S^* and S_* lie (section 3.2), 0 to 1. */
  double brightQuantile{ 0.99 };
  double darkQuantile{ 0.01 };
  /** Whether the flicker may differ from row to row (section 3.5). Auto finds out. */
  RollingShutter rollingShutter{ RollingShutter::Auto };
  /** sigma_y of (3.28) for RollingShutter::Fixed [rows]. */
  double sigmaRows{ 50.0 };
  /** Axis along which the shutter travels: 1 = y; 0 = x, the rows are then columns of the frame. */
  unsigned int shutterAxis{ 1 };
  /** Excess noise factor F of the sensor, 1 or more [1]: the gain is the slope of the variance divided by F. */
  double excessNoiseFactor{ 1.0 };
  /** What is known of the codes; the rest is found. */
  CodeSettings codes;

  /** Throws std::invalid_argument if a parameter is out of its range. */
  void
  Validate() const;
};

/** Which part of what was recorded a stack is, where it was cut out before: it changes no number of the measurement,
 * and without it nobody could repeat that. */
struct StackSelection
{
  std::optional<std::array<std::size_t, 4>>          roi;    ///< x, y, width, height [pixel]
  std::optional<std::pair<std::size_t, std::size_t>> frames; ///< the first one, and one past the last, from 0
};

} // namespace sensornoise

#endif
