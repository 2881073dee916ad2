// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_RefinedEstimate_h
#define sensornoise_refined_RefinedEstimate_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "scene/StaticScene.h"
#include "correlation/NoiseCorrelation.h"
#include "base/NothingToMeasure.h"
#include "pixels/GainByParts.h"
#include "refined/GainEstimate.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

struct GainEstimate;

/** Bounds of the offset by physics: sigma^2 >= 0 from below, no pixel darker than the offset from above. Both bounds
 * are widened by their errors. */
struct OffsetLimits
{
  std::optional<double> lowestDn;               ///< null: not bounded [DN]
  double                highestDn{ 0.0 };       ///< the darkest level plus its error [DN]
  double                rootDn{ 0.0 };          ///< level at which the line has sigma = 0, without errors [DN]
  double                largestNoiseDn2{ 0.0 }; ///< sigma^2 if the offset is highestDn [DN^2]
};

/** Returns the bounds by the line of \a gain; \a quantisationDn2 is the variance of the quantization noise [DN^2]. */
SensorNoise_EXPORT OffsetLimits
LimitsOf(const RefinedResults & found, const GainEstimate & gain, double quantisationDn2);

/** Reason why the illumination does not determine the dark offset. */
enum class OffsetFailure : std::uint8_t
{
  None,              ///< the illumination determines the offset
  UnlikeOffsets,     ///< too many frames have another dark offset to be left out
  OneIntensity,      ///< the scene has one intensity
  Ramp,              ///< the scene is a ramp, along which motion changes every level alike, as an offset does
  FaintFlicker,      ///< the flicker is not significant
  LocalIllumination, ///< the illumination changes differently over the frame, and no part determines the offset
  Unbounded,         ///< the interval has an end at infinity
  WideInterval,      ///< the interval is wider than LargestOffsetInterval of the range of the scene
  OutOfLimits,       ///< the offset is outside of its limits
  OffsetsDiffer,     ///< the level that does not flicker differs from place to place
  OffsetsDisagree    ///< the offsets by several components of the illumination scatter by more than their errors
};

/** Dark offset as the flicker determines it. */
struct OffsetEstimate
{
  double        valueDn{ 0.0 };         ///< dark offset [DN]
  double        standardErrorDn{ 0.0 }; ///< [DN]
  Interval      interval;               ///< 95 % interval [DN]
  double        phi{ 1.0 };             ///< dispersion about the offset line [1]; 1: noise alone
  OffsetFailure failure{ OffsetFailure::None };

  bool
  IsIdentified() const
  {
    return failure == OffsetFailure::None;
  }
};

/** Estimates the dark offset from the flicker of all frames, or, under local illumination, from the pixels' responses
 * to it. It is identifiable only if its interval is narrow, it lies within its bounds, and the components of the
 * flicker agree on it. Otherwise the offset from frames of known exposures replaces it, if its interval is narrow. */
SensorNoise_EXPORT OffsetEstimate
EstimateOffset(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits);

/** Returns whether the known offset, which must be given, lies outside of its limits by more than their errors. */
SensorNoise_EXPORT bool
IsKnownOffsetOutOfLimits(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits);

/** Offset at which the flicker is computed, and its standard error [DN]. */
struct UsedOffset
{
  double valueDn;
  double errorDn;
};

/** Returns the known offset unless the frames contradict it, else the offset of the flicker if it is identifiable, else
 * the middle of the bounds. */
SensorNoise_EXPORT UsedOffset
ChooseOffset(const RefinedResults & found,
             const GainEstimate &   gain,
             const OffsetEstimate & flicker,
             const OffsetLimits &   limits);

/** Reason why the standard deviation of the flicker is not identifiable. */
enum class FlickerFailure : std::uint8_t
{
  None,            ///< the standard deviation is identifiable, or has an upper limit
  UnknownOffset,   ///< the change of the illumination has no bounds, as the offset has none
  UncertainOffset, ///< the error of the offset leaves the change of the illumination too uncertain
  LocalMotion,     ///< parts of the scene move by themselves, which looks like local illumination
  NoiseOfFrames    ///< the flicker is not distinguished from the noise of the frames
};

/** Flicker, relative to the signal above an offset. */
struct SeriesOfFlicker
{
  std::vector<double>     gamma; ///< illumination factor of every frame, minus 1 [1]
  Quantity                sd;    ///< standard deviation of gamma over the frames [1]
  FlickerFailure          failure{ FlickerFailure::None };
  double                  scaleError{ 0.0 }; ///< relative error of the change by the error of the offset [1]
  std::optional<Interval> limit;             ///< 95 % interval of the standard deviation, also after a failure [1]
};

/** Estimates the flicker at the dark offset \a offset. \a modelError is the relative error of the flicker by a
 * non-linear response [1]. */
SensorNoise_EXPORT SeriesOfFlicker
EstimateFlicker(const RefinedResults & found, const UsedOffset & offset, double modelError);

/** Motion of the scene. */
struct SeriesOfMotion
{
  std::vector<std::array<double, 2>> shifts; ///< shift of every frame [pixel]; NaN: too dark. Empty: not identifiable
  Quantity                           sdX;    ///< [pixel]
  Quantity                           sdY;    ///< [pixel]
  Quantity                           covariance; ///< [pixel^2]
  /** Upper ends of the intervals of sdX and sdY, also if the blocks of the frame do not share the motion [pixel]. */
  std::array<std::optional<double>, 2> highestSds;
  double deviationOfBlocks{ 0.0 }; ///< the larger rms deviation of x and y, see DeviationOfBlocks [1]
};

/** Estimates the motion beside the flicker \a gamma of the frames, at the same offset. An error of the offset turns a
 * part of the flicker into apparent motion. */
SensorNoise_EXPORT SeriesOfMotion
EstimateMotion(const RefinedResults & found, const std::vector<double> & gamma, const UsedOffset & offset);

/** Verdict on the slope of the variance: whether it is the gain of a sensor, or the reason why not. */
enum class GainVerdict : std::uint8_t
{
  Identified,
  // The data do not determine the gain.
  TooFewPixels,   ///< too few of the pixels that are not clipped fit a static scene
  FewLitFrames,   ///< flicker and motion take up the shot noise of the few frames that hold the illumination
  LevelsTooAlike, ///< the levels of the scene differ too little
  // The data contradict a sensor of one gain.
  FramesDiffer,         ///< the noise variance of the frames does not follow their levels
  IlluminationIsLeft,   ///< the noise correlation, which changes the gain much, may be due to the illumination
  MotionIsLeft,         ///< the noise correlation between frames, which changes the gain, may be due to motion
  Resampled,            ///< the variance differs between columns and between rows, as interpolation makes it
  NotAffine,            ///< the variance deviates from its line
  GainDependsOnOffset,  ///< the variance is a curve of the mean, and the gain depends on the assumed read noise
  DarkFramesContradict, ///< the dark frames are beside the line of levels that are alike
  NotRising,            ///< the variance does not rise with the mean
  LineIllumination,     ///< the illumination differs between rows or columns of one frame
  NoiseNotLinear        ///< medians, compression or repeated frames made the noise
};

/** Returns the verdict on the slope of \a gain by the fit and the pixels: all but LineIllumination and NoiseNotLinear,
 * which do not depend on the fit. */
SensorNoise_EXPORT GainVerdict
TestGain(const RefinedResults & found, const GainEstimate & gain);

/** Returns the status of the sensor's quantities by the verdict. */
SensorNoise_EXPORT EstimateStatus
StatusBy(GainVerdict verdict);

/** Returns the factor by which the noise correlation changes the slope of the variance, 1 or more [1]. */
SensorNoise_EXPORT double
CorrectionByCorrelation(const RefinedResults & found, const GainEstimate & gain);

/** Bounds of the gain by a known offset alone: the line passes the offset with a variance between 0 and the lowest
 * variance of the frames [DN/e-]. Null: the offset is not known, or dark frames with their variance are. */
SensorNoise_EXPORT std::optional<Interval>
GainBounds(const RefinedResults & found, const GainEstimate & gain);

/** Frames that hold most of the illumination. */
struct LitFrames
{
  std::vector<Eigen::Index> frames;               ///< indices of the frames, in rising order
  double                    illumination{ 0.0 };  ///< their fraction of the illumination of all frames [1]
  double                    noiseFraction{ 0.0 }; ///< fraction of the shot noise that flicker and motion leave [1]
};

/** Returns the frames that hold the illumination, if they are few and flicker and motion take up nearly all of their
 * shot noise. Estimator.md, 3.5. */
SensorNoise_EXPORT std::optional<LitFrames>
FindFewLitFrames(const RefinedResults & found);

/** Gains of parts of the frame or of the burst that differ. */
struct UnlikeParts
{
  Divided           divided{};  ///< what is divided
  std::string       words;      ///< description of the parts, for messages
  double            rms{ 0.0 }; ///< rms of the parts' gains about their mean, beyond chance, relative to it [1]
  GainByPartsRecord record;     ///< gain of every part; of lines without a period, of the outermost ones

  /** Returns the parts of the lowest and of the highest gain. */
  SensorNoise_EXPORT std::pair<const GainByPartsRecord::Part &, const GainByPartsRecord::Part &>
  Extremes() const;
};

/** A line of the variance, the verdict on it, and its quantities. */
struct TestedGain
{
  GainEstimate             line;
  GainVerdict              verdict{ GainVerdict::NoiseNotLinear };
  Quantity                 gain;           ///< [DN/e-]
  Quantity                 varianceSlope;  ///< variance slope, with the slope of the quantization noise [DN/e-]
  Quantity                 intercept;      ///< sigma^2 - g mu, without quantization noise [DN^2]
  Quantity                 totalIntercept; ///< intercept with quantization noise [DN^2]
  std::vector<UnlikeParts> parts;          ///< empty: the gain is uniform, or is not identified

  bool
  IsIdentified() const
  {
    return verdict == GainVerdict::Identified;
  }
};

/** Returns the quantities of \a line as far as \a verdict lets them be identified. The intervals contain the gains of
 * all parts of the levels, the frame and the burst. \a quantisationDn2 is the variance of the quantization noise
 * [DN^2]. */
SensorNoise_EXPORT TestedGain
QuantitiesBy(GainVerdict verdict, const GainEstimate & line, const RefinedResults & found, double quantisationDn2);

/** Dark offset and read noise. */
struct DarkQuantities
{
  Quantity offset;                                                                ///< [DN]
  Quantity readNoise;                                                             ///< [DN]
  Quantity readNoiseMedian{ Quantity::Without(EstimateStatus::NotIdentifiable) }; ///< [DN]
  Quantity readNoiseElectrons;                                                    ///< [e-]
  /** Covariance matrix of the errors of gain, intercept and offset; null: not known, see Report::covariance. */
  std::optional<std::array<std::array<double, 3>, 3>> covariance;
};

/** Returns offset and read noise from the dark frames or from the user. Quantities that they do not determine have
 * \a status. \a quantisationDn2 is the variance of the quantization noise [DN^2]. \a filterFactor is the factor from
 * the variance of the frames to the variance of the sensor, see FilterFactor(): below a noise of half a step in the
 * frames, the read noise has a limit only. */
SensorNoise_EXPORT DarkQuantities
QuantitiesOfDarkFrames(const RefinedSettings & settings,
                       double                  quantisationDn2,
                       EstimateStatus          status,
                       double                  filterFactor = 1.0);

/** Returns the settings with the variance of the dark frames without their structured noise, where it is significant:
 * the noise of whole rows, whole columns and periodic interference. */
SensorNoise_EXPORT RefinedSettings
WithoutStructuredNoise(const RefinedSettings & settings);

/** Returns offset and read noise beside an identified gain. The offset is the known offset, if it is given, else
 * \a flicker. \a quantisationDn2 is the variance of the quantization noise [DN^2]. */
SensorNoise_EXPORT DarkQuantities
QuantitiesByOffset(const RefinedResults & found,
                   const GainEstimate &   gain,
                   const OffsetLimits &   limits,
                   const OffsetEstimate & flicker,
                   double                 quantisationDn2);

/** Estimates of the refined method from the results of its passes: every number with its error and verdict, and the
 * numbers of messages, but no message. MakeRefinedReport() makes the report of it. */
struct RefinedEstimate
{
  /** Line of the variance of the frames as they are: what a denoiser needs. */
  TestedGain ofFrames;
  /** Line of the variance before filters and without the noise of rows and columns: gain and intercept of the sensor.
   */
  TestedGain      ofSensor;
  DarkQuantities  dark;
  SeriesOfFlicker flicker;
  SeriesOfMotion  motion;

  /** Dark frames or offset that are given, with the dark variance of the sensor before filters. */
  std::optional<KnownOffset> known;
  OffsetEstimate             flickerOffset; ///< offset as the flicker determines it
  OffsetLimits               limits;

  /** Whether the gain has only bounds and is not identified, as frames have fewer samples than pixels. */
  bool isWithheld{ false };
  /** Whether the known offset and the offset by the flicker differ by more than their errors: some illumination is
   * steady. */
  bool isIlluminationSteady{ false };
  /** Whether the known offset lies outside of its limits. */
  bool isOffsetOutOfLimits{ false };
  /** Addition of the illumination of rows or columns to the slope of the variance, if it is too large, else 0 [1]. */
  double effectOfLines{ 0.0 };
  /** Standard deviation that the vibration may have, if it is strong, else null [pixel]. */
  std::optional<double> strongVibrationPixels;
  /** Ratio of the signals of the darkest and the brightest areas [1], if it is so large that a non-linear response
   * would not be noticed, else null. */
  std::optional<double> uncheckedFraction;

  /** Returns whether the verdict on the sensor follows from the variance line of the sensor alone. */
  bool
  IsSensorLineTested() const
  {
    return ofSensor.verdict != GainVerdict::LineIllumination && ofSensor.verdict != GainVerdict::NoiseNotLinear;
  }
};

/** Decides on every quantity by the results of the passes. */
SensorNoise_EXPORT RefinedEstimate
EstimateRefined(const RefinedResults & found);

/** Makes the report of the refined method. */
SensorNoise_EXPORT Report
MakeRefinedReport(const RefinedResults & found, const ParallelFor & parallelFor = SerialFor);

/** Makes the report of a stack that cannot be measured: its description and the reason. Every quantity is `failed`.
 * \a pixelUse has the values of PixelUse as far as they were found. */
SensorNoise_EXPORT Report
MakeFailedReport(const RefinedSettings &           settings,
                 const StaticScene &               scene,
                 const std::vector<std::uint8_t> & pixelUse,
                 const NothingToMeasure &          failureReason);

/** Warns of the cause of the verdict on the gain, or, if the gain is identified, of the effects that its interval
 * allows for. The numbers of pixels must be in the report. \a effectOfLines is RefinedEstimate::effectOfLines [1]. */
SensorNoise_EXPORT void
WarnOfGain(Report & report, const RefinedResults & found, const TestedGain & tested, double effectOfLines);

/** Warns that a non-linear response would not be noticed: the darkest areas have the fraction \a darkestFraction of the
 * signal of the brightest areas [1]. */
SensorNoise_EXPORT void
WarnOfNarrowRange(Report & report, const RefinedResults & found, double darkestFraction);

/** Returns the reason why the illumination does not determine the offset, and what to do; "": it does. */
SensorNoise_EXPORT std::string
ReasonOf(const OffsetEstimate & offset, const RefinedResults & found);

/** Warns if the flicker is not identifiable. */
SensorNoise_EXPORT void
WarnOfFlicker(Report & report, const SeriesOfFlicker & flicker);

/** Warns of an offset that is not identifiable, of a given offset or dark frames that contradict the frames, and of a
 * read noise that is only limited. The gain must be identified. */
SensorNoise_EXPORT void
WarnOfOffset(Report & report, const RefinedResults & found, const RefinedEstimate & estimate);

/** Adds a warning that the frames are not raw if the noise is correlated or not linear. The gain and the slope of the
 * variance must be filed before. */
SensorNoise_EXPORT void
WarnOfCorrelation(Report & report, const NoiseCorrelation & correlation);

/** Returns whether the noise of a pixel of a plane is correlated with the noise of its neighbours, which are in the
 * other planes of a mosaic, significantly and by a size that the gain is to contain. */
SensorNoise_EXPORT bool
HasCorrelatedNeighbours(const Report & report, const NeighbourCovariance & covariance);

/** Adds the covariance with the neighbours to the gain of a plane, with a warning. Whether read noise is spread, too,
 * is not known, so that intercept and read noise are not identifiable then. */
SensorNoise_EXPORT void
AddToGain(Report & report, const NeighbourCovariance & covariance);

} // namespace sensornoise

#endif
