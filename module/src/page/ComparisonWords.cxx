// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Comparison.h"

#include "base/Text.h"
#include "page/PageSections.h"
#include "report/ReportParts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace sensornoise
{
namespace
{
/** Returns a number with its sign. A negative number begins with U+2212. */
std::string
Signed(const std::string & number)
{
  return number.rfind("\u2212", 0) == 0 ? number : "+" + number;
}

/** Returns a fraction in percent, for example "4.43 %", with a no-break space. */
std::string
PercentText(double fraction)
{
  return Rounded(100.0 * fraction) + "\u00A0%";
}

std::string
SignedPercent(double fraction)
{
  return (fraction < 0.0 ? "\u2212" : "+") + PercentText(std::abs(fraction));
}

/** Returns whether differences of the quantity are relative to the read noise, as for the offset. */
bool
IsOfReadNoise(const ComparedQuantity & quantity)
{
  return std::string(quantity.entry->path) == "offset";
}

/** Returns the number of changes of one \a kind and the largest, for example "gain g in 2 reports (by up to 12 %)"; ""
 * if there are none. */
std::string
ChangesOf(const ComparedQuantity & quantity, ChangeKind kind)
{
  std::size_t count = 0;
  double      largest = 0.0;
  for (const Change & change : quantity.changes)
  {
    count += change.kind == kind ? 1 : 0;
    largest = std::max(largest, change.kind == kind ? std::abs(change.fraction.value_or(0.0)) : 0.0);
  }
  if (count == 0)
  {
    return "";
  }
  const std::string size = PercentText(largest) + (IsOfReadNoise(quantity) ? " of the read noise" : "");
  return LabelText(quantity.entry->label) + " in " + (count == 1 ? "one report" : std::to_string(count) + " reports") +
         (largest > 0.0 ? " (by up to " + size + ")" : "");
}

/** Returns the changes of one \a kind of all quantities, separated by commas; "" if there are none. */
std::string
AllChangesOf(const Comparison & comparison, ChangeKind kind)
{
  std::string text;
  for (const ComparedQuantity & quantity : comparison.quantities)
  {
    const std::string one = ChangesOf(quantity, kind);
    text += (text.empty() || one.empty() ? "" : ", ") + one;
  }
  return text;
}

std::size_t
NumberOf(const Comparison & comparison, bool (*isCounted)(const Change &))
{
  std::size_t count = 0;
  for (const ComparedQuantity & quantity : comparison.quantities)
  {
    count += static_cast<std::size_t>(std::count_if(quantity.changes.begin(), quantity.changes.end(), isCounted));
  }
  return count;
}

/** Returns the numbers of the rows without a gain, for example " Without a gain: 2, 6."; "" if all have one. */
std::string
WithoutGain(const Comparison & comparison)
{
  std::string text;
  for (std::size_t row = 0; row < comparison.rows.size(); ++row)
  {
    if (!comparison.rows[row].report.gain.value)
    {
      text += (text.empty() ? " Without a gain: " : ", ") + std::to_string(row + 1);
    }
  }
  return text.empty() ? "" : text + ".";
}

/** Returns the reason for which there is no difference. */
std::string
WhyNoValue(const ComparedQuantity & quantity, const Comparison & comparison, std::size_t row)
{
  const Quantity & now = quantity.Of(comparison.rows[row]);
  const Quantity & first = quantity.Of(comparison.rows[quantity.changes[row].first]);
  return now.value ? "not compared: the first has no value (" + std::string(NameOf(first.status)) + ")"
                   : "not compared: no value (" + std::string(NameOf(now.status)) + ")";
}

/** Returns whether the hashes show that a report and its first report are of the same frames. */
bool
IsOfSameFrames(const Comparison & comparison, const Change & change, std::size_t row)
{
  const auto & first = comparison.rows[change.first].report.input;
  const auto & now = comparison.rows[row].report.input;
  return first && now && !now->frames.sha256.empty() && now->frames.sha256 == first->frames.sha256;
}

/** Returns \a text with plain spaces for no-break spaces, which only a browser needs. */
std::string
WithPlainBlanks(std::string text)
{
  const std::string blank = "\u00A0";
  for (std::size_t at = text.find(blank); at != std::string::npos; at = text.find(blank, at))
  {
    text.replace(at, blank.size(), " ");
  }
  return text;
}
} // namespace

std::string
NameOfRow(const Comparison & comparison, std::size_t row)
{
  const ComparedReport & compared = comparison.rows[row];
  return std::to_string(row + 1) + " " + compared.label +
         (compared.report.channel == "mono" ? "" : " " + compared.report.channel);
}

Verdict
VerdictOf(const Comparison & comparison)
{
  const std::string changed = AllChangesOf(comparison, ChangeKind::Changed);
  const std::string small = AllChangesOf(comparison, ChangeKind::Small);
  const std::string rest =
    (small.empty() ? "" : " By more than its errors, but little: " + small + ".") + WithoutGain(comparison);
  if (!changed.empty())
  {
    return { Severity::Warning, "By more than the errors, against the first report: " + changed + "." + rest };
  }
  if (NumberOf(comparison, [](const Change & change) { return change.standardError.has_value(); }) > 0)
  {
    return { Severity::Note,
             (small.empty() ? "Nothing differs from the first report by more than its errors."
                            : "Nothing differs from the first report by much.") +
               rest };
  }
  const bool hasValues = NumberOf(comparison, [](const Change & change) { return change.difference.has_value(); }) > 0;
  return { Severity::Error,
           hasValues ? "The differences cannot be tested: no quantity has errors in two reports."
                     : "Nothing can be compared: of no quantity do two reports have a value." };
}

std::string
DifferenceText(const ComparedQuantity & quantity, std::size_t row)
{
  const Change & change = quantity.changes[row];
  if (!change.difference)
  {
    return "";
  }
  Quantity difference = Quantity::Identified(*change.difference);
  difference.standardError = change.standardError;
  const std::string unit = UnitText(quantity.entry->unit);
  const std::string number = change.standardError       ? Signed(ValueText(difference))
                             : *change.difference < 0.0 ? "\u2212" + Rounded(-*change.difference)
                                                        : "+" + Rounded(*change.difference);
  return number + (unit.empty() ? "" : " " + unit);
}

std::string
FractionText(const ComparedQuantity & quantity, std::size_t row)
{
  const auto & fraction = quantity.changes[row].fraction;
  return fraction ? SignedPercent(*fraction) + (IsOfReadNoise(quantity) ? " of the read noise" : " of the first") : "";
}

std::string
VerdictText(const Comparison & comparison, const ComparedQuantity & quantity, std::size_t row)
{
  const Change &    change = quantity.changes[row];
  const std::string errors =
    change.standardError ? Rounded(std::abs(*change.difference) / *change.standardError) + " standard errors" : "";
  const std::string same = IsOfSameFrames(comparison, change, row) ? "; of the same frames: the errors do not add" : "";
  switch (change.kind)
  {
    case ChangeKind::First:
      return "the first";
    case ChangeKind::NoValue:
      return WhyNoValue(quantity, comparison, row);
    case ChangeKind::NoErrors:
      return "not tested: there are no errors" + same;
    case ChangeKind::Within:
      return "within its errors: " + errors + same;
    case ChangeKind::Small:
      return "more than its errors, but small: " + errors + same;
    case ChangeKind::Changed:
      break;
  }
  return "changed by more than its errors: " + errors + same;
}

std::string
MeanSentence(const ComparedQuantity & quantity, const CommonMean & common)
{
  const bool        isChance = common.probability >= ChanceProbability;
  const std::string unit = UnitText(quantity.entry->unit);
  const std::string ofUnit = unit.empty() ? "" : " " + unit;
  Quantity          mean = Quantity::Identified(common.mean);
  mean.standardError = isChance ? common.standardError : std::hypot(common.standardError, common.excess);
  const std::string value = isChance ? ValueText(mean) : ValueText(mean).substr(0, ValueText(mean).find(' '));
  const std::string channel = common.channel == "mono" ? "" : " of " + common.channel;
  const std::string law = "\u03C7\u00B2 " + Rounded(common.chiSquare) + " with " + std::to_string(common.count - 1) +
                          " degrees of freedom, probability " +
                          (common.probability < 1e-6 ? "below 0.000001" : Rounded(common.probability));
  std::string text = "All " + std::to_string(common.count) + channel + ": mean, weighed by the errors, " + value +
                     ofUnit + "; they scatter ";
  if (isChance)
  {
    return text + "as their errors say (" + law + ").";
  }
  const bool hasFraction = !IsOfReadNoise(quantity) && std::abs(common.mean) > 2.0 * common.standardError;
  return text + "by " + Rounded(common.excess) + ofUnit +
         (hasFraction ? " (" + PercentText(common.excess / std::abs(common.mean)) + ")" : "") +
         " beyond their errors (" + law + ").";
}

std::string
StackText(const ComparedReport & row)
{
  const Report &         report = row.report;
  const CameraSettings & camera = report.camera;
  std::string            text = camera.camera;
  const auto             add = [&text](const std::string & words) { text += (text.empty() ? "" : ", ") + words; };
  if (std::isfinite(camera.isoSpeed))
  {
    add("ISO " + Text(camera.isoSpeed));
  }
  if (std::isfinite(camera.exposureSeconds))
  {
    add(Text(camera.exposureSeconds) + " s");
  }
  add(CountText(report.frames, "frame") + " of " + std::to_string(report.width) + " \u00D7 " +
      std::to_string(report.height) + " pixels");
  if (report.bitDepth)
  {
    add(std::to_string(*report.bitDepth) + " bits");
  }
  add("method " + report.method);
  return text;
}

std::string
RuleText(const Comparison & comparison)
{
  const std::size_t tested =
    NumberOf(comparison, [](const Change & change) { return change.standardError.has_value(); });
  return "Each report is compared with the first, of a mosaic channel by channel. The standard error of a difference "
         "is "
         "the root of both errors' squares, as for independent reports: reports that share frames, dark frames or a "
         "given "
         "offset differ by less. Beyond " +
         Text(ChanceErrors) + " standard errors chance is not taken for the cause; it gives one in 370, and here are " +
         std::to_string(tested) +
         ". How large a change is stands beside it, whatever the number of pixels: small is less than " +
         PercentText(SmallFraction) + ", of the offset less than " + PercentText(SmallOffsetFraction) +
         " of the read noise.";
}

std::string
MakeText(const Comparison & comparison)
{
  std::string text;
  for (std::size_t row = 0; row < comparison.rows.size(); ++row)
  {
    text += NameOfRow(comparison, row) + ": " + StackText(comparison.rows[row]) + '\n';
  }
  for (const ComparedQuantity & quantity : comparison.quantities)
  {
    const std::string unit = UnitText(quantity.entry->unit);
    text += '\n' + LabelText(quantity.entry->label) + (unit.empty() ? "" : " [" + unit + "]") + '\n';
    for (std::size_t row = 0; row < comparison.rows.size(); ++row)
    {
      const std::string fraction = FractionText(quantity, row);
      const std::string difference = DifferenceText(quantity, row);
      text += "  " + NameOfRow(comparison, row) + ": " + ValueText(quantity.Of(comparison.rows[row])) +
              (difference.empty() ? "" : "; " + difference) + (fraction.empty() ? "" : ", " + fraction) + "; " +
              VerdictText(comparison, quantity, row) + '\n';
    }
    for (const CommonMean & common : quantity.means)
    {
      text += "  " + MeanSentence(quantity, common) + '\n';
    }
  }
  return WithPlainBlanks(text + '\n' + VerdictOf(comparison).sentence + '\n');
}

} // namespace sensornoise
