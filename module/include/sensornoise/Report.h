// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Report_h
#define sensornoise_Report_h

#include "SensorNoiseExport.h"
#include "sensornoise/CameraSettings.h"
#include "sensornoise/WarningCodes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sensornoise
{

/** The reason for which a frame is not one of the burst. */
enum class FrameFault : std::uint8_t
{
  NotFinite,   ///< most of it is NaN or infinite
  NoNoise,     ///< neighbouring pixels are equal in most of it: zeros, or saturated
  OtherShape,  ///< it is not the scene of the others in other light: another scene, a shadow
  OtherOffset, ///< its level differs by as much in dark places as in bright ones: another dark offset
  OtherNoise   ///< its noise is not that of the others at its level: another gain, another processing
};

/** Its name in the JSON record; stable, for programs. */
SensorNoise_EXPORT const char *
NameOf(FrameFault fault);

/** A frame of the stack as given that is not counted. */
struct LeftOutFrame
{
  std::size_t frame{ 0 }; ///< from 0
  FrameFault  fault{ FrameFault::OtherShape };
};

/** Why a pixel takes part in the estimate of the gain or not: the values of the pixel-use map. */
enum class PixelUse : std::uint8_t
{
  Used = 0,
  Clipped = 1,        ///< a frame holds a clip level
  NotFinite = 2,      ///< a frame holds NaN or infinity
  Vibration = 3,      ///< its gradient is more than noise explains
  Border = 4,         ///< it has no centred difference
  Constant = 5,       ///< it never varies
  FlickerUnknown = 6, ///< the bright set does not reach its row
  Masked = 7,         ///< the user left it out
  NearClip = 8,       ///< it could have come to a clip level, or a neighbour is clipped or not finite
  NotStatic = 9,      ///< its variance does not fit, nor does that of its surroundings: something moved
  Outlier = 10,       ///< its variance is too far from the line, or dark frames show it defective
  CoarseCodes = 11,   ///< its noise is below half a code step
  OutsideRange = 12,  ///< its level is not one that the user wants
  Edge = 13,          ///< frames were filtered, and neighbours of another level mixed their noise in
  MaskedBorder = 14   ///< of a strip along the border that is no part of the scene, as optical-black columns
};

/** What can be said of a quantity. */
enum class EstimateStatus : std::uint8_t
{
  Identified,      ///< value stands
  NotIdentifiable, ///< the data cannot give it: value is null, the bracket stands where one exists
  UpperLimit,      ///< indistinguishable from zero: value is null, the bracket's upper end limits it
  Failed           ///< the data contradict the model: value is null
};

/** The values that a quantity may have, see Filed(). */
enum class QuantityDomain : std::uint8_t
{
  Positive,    ///< 0 is no value of it: a gain, a responsivity
  NonNegative, ///< 0 is one: a noise, a flicker, a motion
  Offset,      ///< a level [DN], of which 0 is a value like others
  AnySign      ///< an intercept, a covariance
};

/** Two ends; an end that is not bounded is null. */
struct Interval
{
  std::optional<double> low;
  std::optional<double> high;
};

/** One estimated quantity: its value only where it is identified. Its unit is in QuantityList(). */
struct Quantity
{
  std::optional<double>   value;
  std::optional<double>   standardError; ///< null: the method has none
  std::optional<Interval> interval95;    ///< null: the method has none
  EstimateStatus          status{ EstimateStatus::Failed };
  std::optional<Interval> bracket; ///< physical limits (sigma^2 >= 0, flux >= 0), where they exist

  static Quantity
  Identified(double number)
  {
    Quantity quantity;
    quantity.value = number;
    quantity.status = EstimateStatus::Identified;
    return quantity;
  }
  static Quantity
  Without(EstimateStatus status, const std::optional<Interval> & bracket = std::nullopt)
  {
    Quantity quantity;
    quantity.status = status;
    quantity.bracket = bracket;
    return quantity;
  }
};

/** What the noise of pixels, or of frames, has in common. */
struct NoiseCorrelationRecord
{
  /** Of pixels \a x columns and \a y rows apart, or of frames \a frames apart. */
  struct Lag
  {
    int    x{ 0 };
    int    y{ 0 };
    int    frames{ 0 };
    double value{ 0.0 }; ///< correlation coefficient [1]
    double standardError{ 0.0 };
  };
  /** The covariance of pixels \a x columns and \a y rows apart: slope times level + intercept. */
  struct Line
  {
    int    x{ 0 };
    int    y{ 0 };
    double slope{ 0.0 }; ///< [DN/e-]
    double slopeStandardError{ 0.0 };
    double intercept{ 0.0 }; ///< [DN^2]
    double interceptStandardError{ 0.0 };
  };
  std::string       kind; ///< white, crosstalk, filtered, temporal, enlarged, brighter-fatter, not-linear, not-measured
  std::vector<Lag>  space;
  std::vector<Lag>  time;
  std::vector<Line> covarianceLines; ///< empty: neighbours share nothing
  Quantity          rowNoise;        ///< common to a row of one frame
  Quantity          columnNoise;     ///< common to a column
  Quantity          excessKurtosis;
};

/** Gains of the parts of the frame, where they differ. */
struct GainByPartsRecord
{
  struct Part
  {
    std::string name;
    double      gain{ 0.0 };          ///< [DN/e-]
    double      standardError{ 0.0 }; ///< [DN/e-]
    double      pixelFraction{ 0.0 }; ///< of the pixels used [1]
  };
  std::string       pattern; ///< name of the partition, as in PartitionTable
  std::vector<Part> parts;
};

/** Linearity of the response against given exposures. */
struct LinearityRecord
{
  /** The level of the brightest never clipped parts of the frames at one exposure. */
  struct Level
  {
    double      exposure{ 0.0 }; ///< in the unit in which the exposures were given
    std::size_t frames{ 0 };
    double      meanDn{ 0.0 };
    std::optional<double>
      deviationPercent; ///< from the line, relative to the line's signal; null: outside of the range
  };
  Quantity              errorPercent{ Quantity::Without(EstimateStatus::NotIdentifiable) }; ///< of EMVA 1288
  Quantity              offsetDn{ Quantity::Without(EstimateStatus::NotIdentifiable) };
  Quantity              responsivity{ Quantity::Without(EstimateStatus::NotIdentifiable) }; ///< [DN per exposure]
  std::string           reason{ "no exposures were given" }; ///< of a missing linearity error; "": there is one
  std::string           offsetSource{ "none" };              ///< "dark frames" (exposure 0), "line" or "none"
  std::optional<double> saturationDn;
  std::string           saturationSource{ "none" }; ///< "given", "pile-up", "code range", "largest level" or "none"
  std::vector<Level>    levels;                     ///< in the order of the exposures; empty: no exposures were given
};

/** Something that the user should know. */
struct Warning
{
  WarningCode code;
  std::string message; ///< one sentence, for people, with the numbers found and expected
};

/** Frames that were measured, by which a stored report is known to be of them: their files, or their pixels where they
 * are in no file that this library reads. */
struct InputFiles
{
  /** SHA-256, in hexadecimal digits. Of the bytes of all files, one after the other in the order of the frames, behind
   * a header the files of its pixels: what `cat FILES | sha256sum` prints. Of pixels: of all their bytes, least
   * significant first, a frame after the other, row by row. "": not computed, for want of OpenSSL. */
  std::string   sha256;
  std::size_t   files{ 0 }; ///< 0: the pixels
  std::uint64_t bytes{ 0 }; ///< of all files, or of the pixels

  bool
  IsOfPixels() const
  {
    return files == 0;
  }
};

/** All that was read. */
struct InputRecord
{
  InputFiles                frames;
  std::optional<InputFiles> dark; ///< null: no dark frames
};

/** \class Report
 * \brief All that was measured from one stack: the record whose JSON is "itk-sensornoise-report/1".
 *
 * The member names are those of the JSON record in camel case; units stand in each quantity.
 */
struct Report
{
  using SettingValue = std::variant<double, bool, std::string, std::vector<double>>;

  std::string                                       method;
  std::vector<std::pair<std::string, SettingValue>> settings; ///< every parameter as used
  std::optional<InputRecord>                        input;    ///< null: not asked for

  std::size_t               frames{ 0 };
  std::size_t               framesDistinct{ 0 }; ///< equal frames are counted once: what all but the series is made of
  std::vector<LeftOutFrame> framesLeftOut;       ///< unlike the others; all but the series is measured without them
  std::size_t               width{ 0 };
  std::size_t               height{ 0 };
  std::string               channel{ "mono" };
  CameraSettings            camera; ///< what the frames' file says of it
  std::optional<int>        bitDepth;
  std::string               bitDepthSource{ "none" };
  std::optional<double>     quantisationStepDn; ///< null: the data have no codes
  std::optional<double>     clipLowDn;
  std::optional<double>     clipHighDn;
  std::string               clipSource{ "none" };

  struct Pixels
  {
    std::size_t total{ 0 };
    std::size_t valid{ 0 };
    std::size_t used{ 0 };
    std::size_t clipped{ 0 };
    std::size_t notFinite{ 0 };
  } pixels;

  Quantity gain;
  /** Of a pixel's variance against its level: with totalIntercept what a denoiser needs. The gain where the noise is
   * white and the codes are even. */
  Quantity varianceSlope;
  Quantity offset;
  Quantity readNoise;
  /** Of the median pixel, where pixels differ: only dark frames tell it. */
  Quantity readNoiseMedian{ Quantity::Without(EstimateStatus::NotIdentifiable) };
  Quantity readNoiseElectrons;
  Quantity intercept;      ///< sigma^2 - g mu
  Quantity totalIntercept; ///< with the codes' noise
  /** Of gain, intercept and offset; where there is no offset, NaN in its row and column. */
  std::optional<std::array<std::array<double, 3>, 3>> covariance;

  Quantity flickerSd;
  Quantity vibrationSdX;
  Quantity vibrationSdY;
  Quantity vibrationCovariance;

  std::vector<double>                flicker;     ///< gamma_t of every frame [1]; of equal ones the same, NaN: left out
  std::vector<std::vector<double>>   flickerRows; ///< gamma_t(y): frame by frame; empty: null in JSON
  std::vector<std::array<double, 2>> motion;      ///< (alpha_t, beta_t) [pixel]; empty: the method has none

  struct Baseline
  {
    double curvature{ 0.0 };
    double gain{ 0.0 };
    double intercept{ 0.0 };
  };
  struct Fit
  {
    std::optional<double>   reducedChi2;
    std::optional<double>   curvature;
    std::optional<double>   curvatureZ;
    std::optional<double>   nonlinearity; ///< D, departure of the corrected variance from its line [1]
    std::optional<double>   offsetLinePhi;
    std::optional<Baseline> line; ///< through the corrected variance: indicative where the gain is not identified
  } fit;
  std::optional<NoiseCorrelationRecord> noiseCorrelation; ///< null: not measured
  std::vector<GainByPartsRecord>        gainByParts;      ///< empty: the gain is uniform, or is not identified
  LinearityRecord                       linearity;
  std::optional<Baseline>               affineBaseline; ///< the line through the uncorrected variance: ignores flicker
  std::optional<Baseline>               quadraticBaseline; ///< the parabola through the uncorrected variance, (2.21)

  std::vector<Warning> warnings;

  /** Figure 4: averages over bins of equal count of the pixels used. */
  struct Scatter
  {
    std::vector<double>      mean;
    std::vector<double>      variance;
    std::vector<double>      correctedVariance;
    std::vector<std::size_t> count;
  } scatter;

  /** Whether anything was estimated. */
  bool
  IsUsable() const
  {
    return gain.status == EstimateStatus::Identified || intercept.status == EstimateStatus::Identified;
  }

  void
  Warn(WarningCode code, std::string message)
  {
    warnings.push_back({ code, std::move(message) });
  }
};

} // namespace sensornoise

#endif
