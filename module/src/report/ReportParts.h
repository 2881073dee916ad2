// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_ReportParts_h
#define sensornoise_report_ReportParts_h

#include "SensorNoiseExport.h"
#include "base/Constants.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"

#include <array>
#include <optional>
#include <string>

/** \file
 * Parts of the JSON record and of the table that other records and tables have, too, and what the channels of a mosaic
 * have in common: their motion, and the numbers by which they are compared. */

namespace sensornoise
{

class JsonWriter;

/** Writes an interval as [low, high]; a bound that does not exist is null. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const Interval & interval);
/** Writes a warning as an object: `code`, `severity` and `message`. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const Warning & warning);
/** Writes a frame that is left out as an object: `frame` (its number from 0) and `reason`. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const LeftOutFrame & frame);
/** Writes a quantity as member \a name of the current object. Value, standard error, interval and bounds are in \a
 * unit; unknown values are null. */
SensorNoise_EXPORT void
WriteQuantity(JsonWriter & json, const char * name, const Quantity & quantity, const char * unit);
/** Writes a correlation coefficient as an object. Its `lag` is [x, y] in pixels, or a number of frames. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Lag & lag);
/** Writes the line of the covariance at one lag as an object. Its `lag` is [x, y] in pixels. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Line & line);
/** Writes a wave of periodic interference as an object: its frequency along both axes, its root mean square and error.
 */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Interference & wave);
/** Writes the noise correlation as an object: noise class (`kind`), coefficients, covariance lines, interference and
 * quantities. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord & correlation);

/** Writes the identification of the input as an object: `of` ("files" or "pixels"), `sha256` (null: not computed),
 * `files` (number) and `bytes`. If there are dark frames, their identification is the member `dark`. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const InputRecord & input);

/** Writes the record as an object, without a line break at its end. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const Report & report);

/** Returns the row of a quantity in a table: label, value, error, unit, status, and interval or limits, with a line
 * break. \a hasErrors: the table has a column for the standard error. */
SensorNoise_EXPORT std::string
QuantityLine(const std::string & label, const std::string & unit, const Quantity & quantity, bool hasErrors);

/** Returns the source of a clip level of the record in words: "DN range" for `code range`, "repeated extreme values"
 * for `pile-up`. Other sources stay as they are. */
std::string
DescribeClipSource(std::string source);

/** Returns the identification of the measured frames, and of the dark frames if there are any: number of files, bytes
 * and SHA-256. Each is one line with its line break. "": \a input is null. */
std::string
DescribeInput(const std::optional<InputRecord> & input);

/** Returns the quality of the fits: reduced chi-square of the variance about its line, and phi of the offset line. This
 * and the next functions return one line without a line break. "": not measured. */
std::string
DescribeFit(const Report & report);
/** Returns the largest relative deviation of the variance from its line. */
std::string
DescribeResponse(const Report & report);
/** Returns the noise class, with the largest correlation coefficient, and its effect on the gain. */
std::string
DescribeNoise(const Report & report);
/** Returns the number of exposures that the linearity error is measured from, with saturation level and source of the
 * offset; or the reason for which there is no linearity error. */
std::string
DescribeLinearity(const Report & report);

/** Constants of the component `report`. */
struct ReportConstants
{
  /** Least difference of the gains of the two greens, relative to their mean, that is reported [1]. Chosen by the size
   * of the effect: a difference of 0.5 % has no practical consequence. */
  double leastGreenDifference{ 0.005 };
  /** Least difference of the mean levels of the two planes called green, at which these planes are not the greens [1].
   * It is relative to the larger of two differences: between the mean of the greens and the mean of the two other
   * planes, and between the two other planes. It equals InMoments.leastColourDifference. Planes of one colour differ by
   * less than 0.01, the contrast of the scene within a pixel. */
  double leastLevelDifference{ 0.08 };
  /** Difference of the mean levels of the planes called red and blue, relative to the difference of the two planes
   * called green [1]. Below this value red and blue are of one colour. Chosen empirically. */
  double largestLevelDifference{ 0.1 };
};

SENSORNOISE_CONSTANT ReportConstants InReport;

/** Returns the joint motion of the planes, whose reports are in the order of BayerPlanes; null: a report has no motion,
 * or motion of another number of frames.
 *
 * Let a be the mean motion of R and B, and b the mean motion of G1 and G2. The variance along an axis is the covariance
 * of a and b, which contains no noise because the noise of a and the noise of b are independent. Each standard error is
 * the root sum of squares of two errors: the error from the noise of a and b, and the smallest standard error among the
 * planes, which contains the errors common to all planes. Estimator.md, 3.3. */
SensorNoise_EXPORT std::optional<JointMotion>
JoinMotion(const std::array<Report, 4> & channels);

/** Adds the deviation of the vibration of each channel from the joint vibration to its standard error, as a root sum of
 * squares, and widens its 95 % interval accordingly. */
SensorNoise_EXPORT void
WidenVibration(std::array<Report, 4> & channels, const JointMotion & joint);

} // namespace sensornoise

#endif
