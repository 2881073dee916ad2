// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_Comparison_h
#define sensornoise_page_Comparison_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** A report among others: of a mosaic, that of one channel. Series, scatter and settings are not needed. */
struct ComparedReport
{
  std::string label; ///< by which people know it, for instance the name of its file
  Report      report;
};

/** \name What a change is called; set by hand */
///@{
/** A difference of more standard errors than this is not taken for chance, which gives one in 370. */
inline constexpr double ChanceErrors = 3.0;
/** The same as a probability, for what is judged by chi-square. */
inline constexpr double ChanceProbability = 0.0027;
/** Below this share [1] a difference is called small, however sure it is: gains differ by a hundredth with the
 * temperature and the day. */
inline constexpr double SmallShare = 0.01;
/** The same of an offset, as a share of the read noise [1]: not seen in any one pixel. */
inline constexpr double SmallOffsetShare = 0.1;
///@}

/** Values beyond this are none, and errors below its inverse: their squares are still numbers. */
inline constexpr double ExtremeValue = 1e50;

/** What can be said of a difference. */
enum class ChangeKind : std::uint8_t
{
  First,    ///< of its channel: what the others are compared with
  NoValue,  ///< one of the two has none
  NoErrors, ///< one of the two has none: the difference is not judged
  Within,   ///< its errors
  Small,    ///< above its errors, and small
  Changed   ///< above its errors
};

/** A quantity of a report against that of the first report of the same channel. */
struct Change
{
  ChangeKind            kind{ ChangeKind::NoValue };
  std::size_t           first{ 0 };    ///< row that it is compared with
  std::optional<double> difference;    ///< in the quantity's unit
  std::optional<double> standardError; ///< of the difference: errors of independent reports add in squares
  std::optional<double> share;         ///< difference over the first value, of an offset over the first read noise [1]
};

/** What the reports of one channel have in common; of three or more that have errors. */
struct CommonMean
{
  std::string channel;
  std::size_t count{ 0 };
  double      mean{ 0.0 };          ///< weighed by the errors
  double      standardError{ 0.0 }; ///< of the mean, by these errors alone
  double      chiSquare{ 0.0 };     ///< of count - 1 degrees of freedom, if only errors make them differ
  double      probability{ 1.0 };   ///< that chance gives as much [1]
  /** Standard deviation of what they differ by beyond their errors (DerSimonian & Laird 1986, method of moments). */
  double excess{ 0.0 };
};

/** One quantity of all reports. */
struct ComparedQuantity
{
  const QuantityEntry *   entry{ nullptr };
  std::vector<Change>     changes; ///< one a row
  std::vector<CommonMean> means;   ///< one a channel at most

  /** Of a row. */
  const Quantity &
  Of(const ComparedReport & row) const
  {
    return *entry->of(row.report);
  }
};

/** \struct Comparison
 * \brief Reports side by side: what differs by more than its errors, and by how much. */
struct Comparison
{
  std::vector<ComparedReport>   rows;
  std::vector<ComparedQuantity> quantities; ///< gain, read noise, offset and the variance's line, in that order
};

/** Compares each row with the first of its channel. The variance's slope is left out where it is the gain. */
SensorNoise_EXPORT Comparison
MakeComparison(std::vector<ComparedReport> rows);

/** Reports side by side as one HTML page that needs nothing else: what changed by more than its errors, in a sentence,
 * and of each quantity a figure and a table of values and differences. */
SensorNoise_EXPORT std::string
ToHtml(const Comparison & comparison);

/** The figures of the page as one SVG file. */
SensorNoise_EXPORT std::string
ToSvg(const Comparison & comparison);

/** The same in letters of ASCII, a line a report and quantity. */
SensorNoise_EXPORT std::string
MakeText(const Comparison & comparison);

} // namespace sensornoise

#endif
