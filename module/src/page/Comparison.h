// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_Comparison_h
#define sensornoise_page_Comparison_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "page/PageSections.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Report to compare. A mosaic has one for each channel. The series, the scatter and the settings are not read. */
struct ComparedReport
{
  std::string label; ///< name for people, for example the name of the file
  Report      report;
};

/** \name Thresholds of ChangeKind. They are conventions. */
///@{
/** Standard errors up to which a difference is within its errors. Chance exceeds them once in 370 differences. */
inline constexpr double ChanceErrors = 3.0;
/** Least probability of the chi-square at which the scatter of values is within their errors [1]. It corresponds to
 * ChanceErrors. */
inline constexpr double ChanceProbability = 0.0027;
/** Fraction [1] below which a significant difference is small. Gains differ by about 0.01 with the temperature and from
 * day to day. */
inline constexpr double SmallFraction = 0.01;
/** Fraction of the read noise [1] below which a significant difference of the offset is small: no single pixel shows
 * it. */
inline constexpr double SmallOffsetFraction = 0.1;
///@}

/** Largest magnitude of a value or an error that is compared; its inverse is the smallest error. Their squares are
 * finite. */
inline constexpr double ExtremeValue = 1e50;

/** Result of a comparison of two values. */
enum class ChangeKind : std::uint8_t
{
  First,    ///< the row is the first of its channel, with which the others are compared
  NoValue,  ///< one of the two values is not known
  NoErrors, ///< one of the two errors is not known or is 0
  Within,   ///< the difference is within its errors
  Small,    ///< the difference exceeds its errors, but is small
  Changed   ///< the difference exceeds its errors
};

/** Change of a quantity of a report from the first report of the same channel. */
struct Change
{
  ChangeKind            kind{ ChangeKind::NoValue };
  std::size_t           first{ 0 };    ///< row of the first report of the same channel
  std::optional<double> difference;    ///< value minus first value, in the unit of the quantity; none: First or NoValue
  std::optional<double> standardError; ///< standard error of the difference, for independent reports; none: not known
  std::optional<double>
    fraction; ///< difference / |first value|, for the offset / first read noise [1]; none: not known
};

/** Weighted mean of a quantity over the reports of one channel. It needs three or more values with errors. */
struct CommonMean
{
  std::string channel;
  /** Number of reports whose value and error are known. */
  std::size_t count{ 0 };
  double      mean{ 0.0 };          ///< mean, weighted by 1 / error², in the unit of the quantity
  double      standardError{ 0.0 }; ///< standard error of the mean, from the errors alone
  double      chiSquare{ 0.0 };     ///< chi-square of the values about the mean, with count - 1 degrees of freedom
  double      probability{ 1.0 };   ///< probability of a chi-square at least as large, from the errors alone [1]
  /** Standard deviation of the values in excess of their errors, in the unit of the quantity (DerSimonian & Laird 1986,
   * method of moments). */
  double excess{ 0.0 };
};

/** Comparison of one quantity over all reports. */
struct ComparedQuantity
{
  const QuantityEntry *   entry{ nullptr };
  std::vector<Change>     changes; ///< one for each row
  std::vector<CommonMean> means;   ///< at most one for each channel

  /** Returns the quantity of a row. */
  const Quantity &
  Of(const ComparedReport & row) const
  {
    return *entry->of(row.report);
  }
};

/** \struct Comparison
 * \brief Comparison of reports: the differences between their quantities and their significance. */
struct Comparison
{
  std::vector<ComparedReport>   rows;
  std::vector<ComparedQuantity> quantities; ///< gain, read noise, offset and variance line, in this order
};

/** Compares each report with the first report of its channel. The variance slope is left out if it equals the gain in
 * all reports. */
SensorNoise_EXPORT Comparison
MakeComparison(std::vector<ComparedReport> rows);

/** Returns the comparison as one HTML page, without network access and scripts. It begins with a sentence on what
 * changed by more than its errors. Each quantity has a figure and a table of values and differences. */
SensorNoise_EXPORT std::string
ToHtml(const Comparison & comparison);

/** Returns the figures of the page as one SVG file. */
SensorNoise_EXPORT std::string
ToSvg(const Comparison & comparison);

/** Returns the comparison as plain text in UTF-8: a line for each report and quantity, and a sentence on what changed.
 */
SensorNoise_EXPORT std::string
MakeText(const Comparison & comparison);

/** Returns the name of a row: its number from 1, its label and the channel of a mosaic. */
std::string
NameOfRow(const Comparison & comparison, std::size_t row);

/** Returns a sentence on what changed. The severity is a warning if something changed. It is an error if no difference
 * has a standard error. */
Verdict
VerdictOf(const Comparison & comparison);

/** Returns the difference, for example "+0.0123 ± 0.0026 DN/e⁻"; "" if there is none. */
std::string
DifferenceText(const ComparedQuantity & quantity, std::size_t row);

/** Returns the relative difference, for example "+2.5 % of the first"; "" if Change::fraction is not known. */
std::string
FractionText(const ComparedQuantity & quantity, std::size_t row);

/** Returns the result of the comparison, for example "changed by more than its errors: 4.7 standard errors". */
std::string
VerdictText(const Comparison & comparison, const ComparedQuantity & quantity, std::size_t row);

/** Returns a sentence on the weighted mean of the reports of a channel and on their scatter. */
std::string
MeanSentence(const ComparedQuantity & quantity, const CommonMean & common);

/** Returns camera, ISO speed, exposure time, number and size of the frames, bit depth and method of a report. Unknown
 * ones are left out. */
std::string
StackText(const ComparedReport & row);

/** Returns the rules of the comparison as sentences. */
std::string
RuleText(const Comparison & comparison);

} // namespace sensornoise

#endif
