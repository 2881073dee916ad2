// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Report_h
#define sensornoise_Report_h

#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
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

/** Reason for which a frame is left out. */
enum class FrameFault : std::uint8_t
{
  NotFinite,   ///< most pixels of the frame are NaN or infinite
  NoNoise,     ///< most pixels of the frame equal their neighbours: the frame is zero or saturated
  OtherShape,  ///< the frame shows another scene, or a shadow: illumination and offset do not explain the difference
  OtherOffset, ///< the level of the frame differs equally in dark and bright areas: another dark offset
  OtherNoise   ///< the noise of the frame differs from the noise of the others at its level: another gain or processing
};

/** Returns the name of the reason in the JSON record. The names are stable, for programs. */
SensorNoise_EXPORT const char *
NameOf(FrameFault fault);

/** Frame of the given stack that is left out of the measurement. */
struct LeftOutFrame
{
  std::size_t frame{ 0 };                      ///< number of the frame in the stack, from 0
  FrameFault  fault{ FrameFault::OtherShape }; ///< reason for which the frame is left out
};

/** Use of a pixel in the estimate of the gain, or the reason for which the pixel is left out. These are the values of
 * the pixel-use map. */
enum class PixelUse : std::uint8_t
{
  Used = 0,                ///< the pixel takes part in the estimate of the gain
  Clipped = 1,             ///< the pixel attains a clip level in a frame
  NotFinite = 2,           ///< the pixel is NaN or infinite in a frame
  Vibration = 3,           ///< the gradient at the pixel is larger than noise explains (published method)
  Border = 4,              ///< the pixel is at the border, where no centred difference exists
  Constant = 5,            ///< the pixel has the same value in all frames
  FlickerUnknown = 6,      ///< the row of the pixel has no pixels of the bright set, so that its flicker is not known
  Masked = 7,              ///< the mask of the user excludes the pixel
  NearClip = 8,            ///< noise or flicker could have reached a clip level, or a neighbour is clipped
  NotStatic = 9,           ///< the variance of the pixel and around it does not fit a static scene: an object moved
  Outlier = 10,            ///< the variance is too far from the line, or the pixel is defective in the dark frames
  CoarseQuantisation = 11, ///< the noise of the pixel is below half a quantization step
  OutsideRange = 12,       ///< the level of the pixel is outside the range that the user chose
  Edge = 13,         ///< the frames are filtered, and an edge is near: noise of pixels of another level is mixed in
  MaskedBorder = 14, ///< the pixel is in a strip at the border without the scene, for example optical black
  CoarseCodes [[deprecated("use CoarseQuantisation")]] = CoarseQuantisation ///< name in earlier versions
};

/** Status of an estimated quantity. */
enum class EstimateStatus : std::uint8_t
{
  Identified,      ///< the estimate is valid: value has it
  NotIdentifiable, ///< the data do not determine the quantity: value is null, bracket has its bounds if there are any
  UpperLimit,      ///< not distinguished from 0: value is null, interval95 and bracket are from 0 to the limit
  Failed           ///< the data contradict the model, or there was nothing to measure: value is null
};

/** Domain of a quantity: the values that it can have. It decides on the status of an estimate. */
enum class QuantityDomain : std::uint8_t
{
  Positive,    ///< above 0, for example a gain or a responsivity
  NonNegative, ///< 0 or more, for example a read noise, a flicker or a motion
  Offset,      ///< a level [DN] of any sign, whose certainty is compared with the signal
  AnySign      ///< any number, for example an intercept or a covariance
};

/** Interval between two bounds. A bound that does not exist is null. */
struct Interval
{
  std::optional<double> low;  ///< lower bound
  std::optional<double> high; ///< upper bound
};

/** Estimated quantity. Its unit is in QuantityList(); value, standard error and bounds have this unit. */
struct Quantity
{
  std::optional<double>   value;                            ///< the estimate; null unless the status is Identified
  std::optional<double>   standardError;                    ///< standard error of the value; null: not known
  std::optional<Interval> interval95;                       ///< 95 % interval; null: not known
  EstimateStatus          status{ EstimateStatus::Failed }; ///< Failed until an estimate is set
  std::optional<Interval> bracket; ///< bounds from the data and from physics (sigma^2 >= 0, signal >= 0); null: none

  /** Returns an identified quantity with this value, without standard error. */
  static Quantity
  Identified(double number)
  {
    Quantity quantity;
    quantity.value = number;
    quantity.status = EstimateStatus::Identified;
    return quantity;
  }
  /** Returns a quantity without a value, with this status and these bounds. */
  static Quantity
  Without(EstimateStatus status, const std::optional<Interval> & bracket = std::nullopt)
  {
    Quantity quantity;
    quantity.status = status;
    quantity.bracket = bracket;
    return quantity;
  }
};

/** Correlation of the noise between pixels and between frames. */
struct NoiseCorrelationRecord
{
  /** Correlation coefficient of the noise at one lag: in space (frames is 0), or between frames (x and y are 0). */
  struct Lag
  {
    int    x{ 0 };               ///< distance along a row [pixel]
    int    y{ 0 };               ///< distance along a column [pixel]
    int    frames{ 0 };          ///< distance in time [frame]
    double value{ 0.0 };         ///< correlation coefficient [1]
    double standardError{ 0.0 }; ///< standard error of the coefficient [1]
  };
  /** Covariance of the noise at one lag in space, as a function of the level: slope times level + intercept. */
  struct Line
  {
    int    x{ 0 };                        ///< distance along a row [pixel]
    int    y{ 0 };                        ///< distance along a column [pixel]
    double slope{ 0.0 };                  ///< slope of the covariance against the level [DN/e-]
    double slopeStandardError{ 0.0 };     ///< standard error of the slope [DN/e-]
    double intercept{ 0.0 };              ///< covariance at level 0 [DN^2]
    double interceptStandardError{ 0.0 }; ///< standard error of the intercept [DN^2]
  };
  /** Periodic interference: a sine wave across the frame, with a phase of its own in each frame. */
  struct Interference
  {
    double cyclesPerColumn{ 0.0 };  ///< frequency along a row [cycles/pixel]
    double cyclesPerRow{ 0.0 };     ///< frequency along a column [cycles/pixel]
    double rmsDn{ 0.0 };            ///< root mean square of the wave [DN]
    double rmsStandardErrorDn{ 0 }; ///< standard error of the root mean square [DN]
  };
  /** Noise class: "white", "crosstalk", "filtered", "temporal", "enlarged", "brighter-fatter", "not-linear" or
   * "not-measured". */
  std::string       kind;
  std::vector<Lag>  space;           ///< coefficients by lag in space; of each pair of opposite lags one is listed
  std::vector<Lag>  time;            ///< coefficients by lag in time
  std::vector<Line> covarianceLines; ///< lines of lag 0 and of the summed lags in space; empty: no correlation in space
  /** Waves that gain, intercept and read noise are without, in the order in which they were found. */
  std::vector<Interference> interference;
  Quantity                  rowNoise;       ///< standard deviation of the noise common to a row of one frame [DN]
  Quantity                  columnNoise;    ///< standard deviation of the noise common to a column of one frame [DN]
  Quantity                  excessKurtosis; ///< excess kurtosis of the noise of a pixel [1]; 0: normal noise
};

/** Gains of parts of the frame or of the burst that differ. */
struct GainByPartsRecord
{
  /** Part of the frame or of the burst. */
  struct Part
  {
    std::string name;                 ///< name of the part, for example "upper left"
    double      gain{ 0.0 };          ///< system gain of the part [DN/e-]
    double      standardError{ 0.0 }; ///< standard error of the gain [DN/e-]
    double      pixelFraction{ 0.0 }; ///< fraction of the used pixels that are in the part [1]
  };
  std::string       pattern; ///< name of the partition, for example "left-right"
  std::vector<Part> parts;   ///< all parts of the partition
};

/** Linearity of the response, measured with the given exposures of the frames. */
struct LinearityRecord
{
  /** Level of the brightest parts of the frames at one exposure; parts that are clipped in any frame are left out. */
  struct Level
  {
    double      exposure{ 0.0 }; ///< the exposure, in the unit in which the exposures were given
    std::size_t frames{ 0 };     ///< number of frames at this exposure
    double      meanDn{ 0.0 };   ///< mean level [DN]
    /** Deviation of the level from the line, relative to the signal of the line [%]; null: outside of the range. */
    std::optional<double> deviationPercent;
  };
  /** Linearity error by EMVA 1288 Release 4.0 Linear, 6.7 [%]. */
  Quantity errorPercent{ Quantity::Without(EstimateStatus::NotIdentifiable) };
  /** Dark offset: the level at exposure 0 [DN]. */
  Quantity offsetDn{ Quantity::Without(EstimateStatus::NotIdentifiable) };
  /** Slope of the line through the levels [DN per unit of exposure]. */
  Quantity    responsivity{ Quantity::Without(EstimateStatus::NotIdentifiable) };
  std::string reason{ "no exposures were given" };  ///< reason why there is no linearity error; "": there is one
  std::string offsetSource{ "none" };               ///< "dark frames" (exposure 0), "line" or "none"
  std::optional<double> saturationDn;               ///< level at which the response saturates [DN]
  std::string           saturationSource{ "none" }; ///< "given", "pile-up", "code range", "largest level" or "none"
  std::vector<Level>    levels;                     ///< in the order of the exposures; empty: no exposures were given
};

/** Results of the single-image method besides the line. */
struct SingleImageRecord
{
  /** Variance of the noise as a function of the level: slope times level + intercept. */
  struct Line
  {
    double slope{ 0.0 };                  ///< slope of the variance against the level [DN/e-]
    double slopeStandardError{ 0.0 };     ///< standard error of the slope [DN/e-]
    double intercept{ 0.0 };              ///< variance at level 0 [DN^2]
    double interceptStandardError{ 0.0 }; ///< standard error of the intercept [DN^2]
  };
  double evenFraction{ 0.0 }; ///< fraction of the finite windows that are without edges and texture [1]
  /** Variance of the horizontal and vertical wavelet details over the variance of the diagonal details, minus 1 [1].
   * White noise has 0. */
  double                           bandExcess{ 0.0 };
  double                           bandExcessStandardError{ 0.0 }; ///< standard error of bandExcess [1]
  std::vector<std::optional<Line>> frames;                         ///< line of each frame; null: not determined
  /** Reduced chi-square of the slopes of the frames about their weighted mean [1]. 1 is expected. Null: fewer than two
   * lines. */
  std::optional<double> frameReducedChi2;
  /** Line of the mean image of all frames: slope, intercept and their standard errors, each multiplied by the number of
   * frames. It equals the line of a single frame if the whole variance is temporal noise, because averaging T frames
   * divides this variance by T. A larger slope shows fixed-pattern noise or texture, which averaging does not reduce.
   * Null: there is only one frame, or no line is determined. */
  std::optional<Line> meanImage;
};

/** Warning of a report. */
struct Warning
{
  WarningCode code;    ///< subject of the warning, with severity and general meaning in WarningTable
  std::string message; ///< one sentence, for people, with the numbers found and expected
};

/** Identification of the measured frames, so that a stored report can be matched with them: by their files, or by their
 * pixels if they are in no file that this library reads. */
struct InputFiles
{
  /** SHA-256 in hexadecimal digits; "": not computed, because OpenSSL is missing. For files it is the sum over the
   * bytes of all files in the order of the frames, as `cat FILES | sha256sum` prints it; a header is followed by its
   * data files. For pixels it is the sum over the bytes of all pixels, least significant byte first, frame by frame and
   * row by row. */
  std::string   sha256;
  std::size_t   files{ 0 }; ///< number of files; 0: the frames are identified by their pixels
  std::uint64_t bytes{ 0 }; ///< size of all files, or of all pixels [bytes]

  /** Returns whether the frames are identified by their pixels. */
  bool
  IsOfPixels() const
  {
    return files == 0;
  }
};

/** Identification of all frames that were read. */
struct InputRecord
{
  InputFiles                frames; ///< frames of the stack
  std::optional<InputFiles> dark;   ///< dark frames; null: none
};

/** \class Report
 * \brief All results for one stack: the record whose JSON is "itk-sensornoise-report/1".
 *
 * The members have the names of the JSON record, in camel case. QuantityList() has unit and meaning of each quantity.
 */
struct Report
{
  /** Value of a setting. */
  using SettingValue = std::variant<double, bool, std::string, std::vector<double>>;

  std::string                                       method;   ///< "refined", "published" or "single-image"
  std::vector<std::pair<std::string, SettingValue>> settings; ///< settings that change a number, by JSON name
  std::optional<InputRecord>                        input; ///< identification of the frames read; null: not requested

  std::size_t frames{ 0 }; ///< number of frames that were given
  /** Number of frames that are counted: equal frames are counted once, and frames that are left out are not. All
   * results except the series are measured from the counted frames. */
  std::size_t               framesDistinct{ 0 };
  std::vector<LeftOutFrame> framesLeftOut;            ///< frames that are unlike the others
  std::size_t               width{ 0 };               ///< columns of a frame [pixel]
  std::size_t               height{ 0 };              ///< rows of a frame [pixel]
  std::string               channel{ "mono" };        ///< "mono", or the plane of a mosaic: "R", "G1", "G2" or "B"
  CameraSettings            camera;                   ///< settings of the camera that the file records
  std::optional<int>        bitDepth;                 ///< bit depth of the digital numbers; null: not known
  std::string               bitDepthSource{ "none" }; ///< "given", "data" or "none"
  std::optional<double>     quantisationStepDn;       ///< quantization step [DN]; null: the data are not quantized
  std::optional<double>     clipLowDn;  ///< lower clip level: a pixel that attains it is clipped [DN]; null: none
  std::optional<double>     clipHighDn; ///< upper clip level: a pixel that attains it is clipped [DN]; null: none
  std::string clipSource{ "none" };     ///< "given", "pile-up", "code range", "none", or "low: ..., high: ..."

  /** Numbers of pixels. */
  struct Pixels
  {
    std::size_t total{ 0 };     ///< pixels of a frame
    std::size_t valid{ 0 };     ///< pixels that are finite, never clipped and not masked by the user
    std::size_t used{ 0 };      ///< pixels that take part in the estimate of the gain
    std::size_t clipped{ 0 };   ///< pixels that attain a clip level in a frame
    std::size_t notFinite{ 0 }; ///< pixels that are NaN or infinite in a frame
  } pixels;

  /** System gain g [DN/e-], from the total covariance over lags. It is divided by the excess noise factor if one is
   * given. */
  Quantity gain;
  /** Slope of the variance of a pixel against its level, in the frames as they are [DN/e-]. With totalIntercept it is
   * the noise model for a denoiser. It equals the gain if the noise is white and the quantization is uniform. */
  Quantity varianceSlope;
  Quantity offset;    ///< dark offset mu [DN]
  Quantity readNoise; ///< read noise sigma, rms over all pixels that are not defective, without quantization noise [DN]
  /** Read noise of the median pixel [DN], for sensors whose pixels differ. Only dark frames determine it. */
  Quantity readNoiseMedian{ Quantity::Without(EstimateStatus::NotIdentifiable) };
  Quantity readNoiseElectrons; ///< read noise divided by the gain [e-]
  Quantity intercept;          ///< sigma^2 - g mu, without quantization noise [DN^2]
  Quantity totalIntercept;     ///< variance of a pixel at level 0, in the frames as they are [DN^2]
  /** Covariance matrix of the errors of gain [DN/e-], intercept [DN^2] and offset [DN], in this order. Without an
   * offset its row and column are NaN. Null: not known. */
  std::optional<std::array<std::array<double, 3>, 3>> covariance;

  Quantity flickerSd;           ///< standard deviation of gamma_t over the frames [1]
  Quantity vibrationSdX;        ///< standard deviation of the motion along x [pixel]
  Quantity vibrationSdY;        ///< standard deviation of the motion along y [pixel]
  Quantity vibrationCovariance; ///< covariance of the motions along x and along y [pixel^2]

  /** gamma_t of every given frame, the illumination factor minus 1 [1]; NaN: left out. Equal frames have equal values.
   */
  std::vector<double> flicker;
  /** gamma_t(y) of every given frame, row by row [1]; NaN: not known. Empty: not measured, null in JSON. */
  std::vector<std::vector<double>> flickerRows;
  /** Shift (alpha_t, beta_t) of every given frame [pixel]; NaN: left out, or too dark. Empty: not measured. */
  std::vector<std::array<double, 2>> motion;

  /** Polynomial of the variance [DN^2] as a function of the level x [DN]: curvature x^2 + gain x + intercept. */
  struct Baseline
  {
    double curvature{ 0.0 }; ///< quadratic coefficient [1]; 0: a line
    double gain{ 0.0 };      ///< linear coefficient [DN/e-]
    double intercept{ 0.0 }; ///< variance at level 0 [DN^2]
  };
  /** Quality of the fits. A member is null if the fit was not made. */
  struct Fit
  {
    std::optional<double>   reducedChi2;  ///< reduced chi-square of the variance about its line [1]
    std::optional<double>   curvature;    ///< quadratic coefficient of the variance against the level [1]
    std::optional<double>   curvatureZ;   ///< curvature over its standard error [1]
    std::optional<double>   nonlinearity; ///< D, largest relative deviation of the corrected variance from its line [1]
    std::optional<double>   offsetLinePhi; ///< residual variance of the offset line over the variance of its noise [1]
    std::optional<Baseline> line;          ///< line through the corrected variance; only indicative without a gain
  } fit;
  std::optional<NoiseCorrelationRecord> noiseCorrelation; ///< null: not measured
  std::optional<SingleImageRecord>      singleImage;      ///< null: another method
  std::vector<GainByPartsRecord>        gainByParts;      ///< empty: the gain is uniform, or is not identified
  LinearityRecord                       linearity;        ///< linearity of the response, if exposures were given
  std::optional<Baseline> affineBaseline; ///< line through the uncorrected variance, for comparison; null: not fitted
  std::optional<Baseline> quadraticBaseline; ///< parabola through the uncorrected variance, (2.21); null: not fitted

  std::vector<Warning> warnings; ///< warnings about the measurement; empty: none

  /** Noise curve: averages over intensity bins that hold equal numbers of the used pixels, from dark to bright (Figure
   * 4 of Sur & Gredi\'ac 2015). All vectors have one value per bin. */
  struct Scatter
  {
    std::vector<double>      mean;              ///< temporal mean [DN]
    std::vector<double>      variance;          ///< temporal variance [DN^2]
    std::vector<double>      correctedVariance; ///< variance without flicker and motion [DN^2]
    std::vector<std::size_t> count;             ///< number of pixels
  } scatter;

  /** Returns whether the gain or the intercept is identified. */
  bool
  IsUsable() const
  {
    return gain.status == EstimateStatus::Identified || intercept.status == EstimateStatus::Identified;
  }

  /** Adds a warning. */
  void
  Warn(WarningCode code, std::string message)
  {
    warnings.push_back({ code, std::move(message) });
  }
};

} // namespace sensornoise

#endif
