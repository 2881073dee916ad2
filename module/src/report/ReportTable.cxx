// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/ReportParts.h"

#include "sensornoise/ReportText.h"
#include "base/Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the arguments formatted as by std::printf, at most 255 bytes. GCC and Clang compare the types with the
 * format. */
[[gnu::format(printf, 1, 2)]] std::string
Format(const char * format, ...)
{
  char    buffer[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof(buffer), format, arguments);
  va_end(arguments);
  return buffer;
}

/** Returns the number with five digits; "-": null. */
std::string
Number(const std::optional<double> & number)
{
  return number ? Format("%.5g", *number) : "-";
}

/** Returns the 95 % interval; null: the bounds. */
const std::optional<Interval> &
RangeOf(const Quantity & quantity)
{
  return quantity.interval95 ? quantity.interval95 : quantity.bracket;
}

/** Returns the value as text; for an upper limit "< " and the limit, to three digits. */
std::string
Value(const Quantity & quantity)
{
  const std::optional<Interval> & range = RangeOf(quantity);
  return quantity.status == EstimateStatus::UpperLimit && range && range->high ? "< " + Rounded(*range->high)
                                                                               : Number(quantity.value);
}

/** Value and standard error of a quantity as text, rounded to two digits of the error. */
struct RoundedQuantity
{
  std::string value{};
  std::string error{};        // error with the sign +-; "": no error is known
  int         decimals{ -1 }; // number of decimals of the value; -1: no error is known
};

/** Returns the value rounded to its error; without an error as by Value(). */
RoundedQuantity
RoundToError(const Quantity & quantity)
{
  RoundedQuantity rounded{ Value(quantity), "", -1 };
  if (quantity.value && quantity.standardError)
  {
    const std::string sign = " +- ";
    const std::string text = Measured(*quantity.value, *quantity.standardError);
    const std::size_t at = text.find(sign);
    const std::size_t point = text.find('.');
    rounded.value = text.substr(0, at);
    rounded.error = WithSigns(sign).substr(1) + text.substr(at + sign.size());
    rounded.decimals = point < at ? static_cast<int>(at - point) - 1 : 0;
  }
  return rounded;
}

/** Returns a bound of an interval, rounded like the value of the quantity or its upper limit. */
std::string
End(const std::optional<double> & end, const RoundedQuantity & rounded)
{
  if (end && rounded.value.front() == '<')
  {
    return Rounded(*end);
  }
  constexpr int most = 15;
  return end && rounded.decimals >= 0 && rounded.decimals <= most && std::abs(*end) < 1e9
           ? Format("%.*f", rounded.decimals, *end)
           : Number(end);
}

/** Returns bit depth, quantization step and clip levels, as far as they are known, each after a comma. */
std::string
DescribeDnRange(const Report & report)
{
  std::string text;
  if (report.bitDepth)
  {
    text += Format(", %d bits (%s)", *report.bitDepth, report.bitDepthSource.c_str());
  }
  if (report.quantisationStepDn)
  {
    text += Format(", quantization step %g DN", *report.quantisationStepDn);
  }
  if (report.clipLowDn || report.clipHighDn)
  {
    text += ", levels " + Number(report.clipLowDn) + " to " + Number(report.clipHighDn) + " DN (" +
            DescribeClipSource(report.clipSource) + ")";
  }
  return text;
}

bool
IsIdentified(const Quantity & quantity)
{
  return quantity.status == EstimateStatus::Identified;
}

/** Returns whether the table has a row for the quantity. */
bool
IsShown(const QuantityEntry & entry, const Report & report)
{
  const Quantity * quantity = entry.of(report);
  switch (entry.shown)
  {
    case ShownIn::EveryTable:
      return quantity != nullptr;
    case ShownIn::TableIfKnown:
      return quantity != nullptr && quantity->value;
    case ShownIn::TableIfNotTheGain:
      return quantity != nullptr && quantity->value && Number(quantity->value) != Number(report.gain.value);
    case ShownIn::TableIfLimited:
      return quantity != nullptr && (quantity->value || quantity->status == EstimateStatus::UpperLimit);
    case ShownIn::Record:
      break;
  }
  return false;
}

/** Returns the correlation coefficient of largest size, for example " up to 44 %"; "": there are no lags. */
std::string
LargestCorrelation(const std::vector<NoiseCorrelationRecord::Lag> & lags)
{
  const auto most = std::max_element(
    lags.begin(), lags.end(), [](const auto & a, const auto & b) { return std::abs(a.value) < std::abs(b.value); });
  return most == lags.end() ? "" : Format(" up to %.2g %%", 100.0 * most->value);
}

/** Returns a line that identifies frames; \a what names them. */
std::string
DescribeFrames(const char * what, const InputFiles & input)
{
  const std::string count =
    input.IsOfPixels() ? "pixels" : Format(input.files == 1 ? "%zu file" : "%zu files", input.files);
  return what + (": " + count) + Format(", %llu bytes, SHA-256 ", static_cast<unsigned long long>(input.bytes)) +
         (input.sha256.empty() ? "not computed" : input.sha256) + "\n";
}
} // namespace

std::string
QuantityLine(const std::string & label, const std::string & unit, const Quantity & quantity, bool hasErrors)
{
  const std::optional<Interval> & range = RangeOf(quantity);
  const RoundedQuantity           rounded = RoundToError(quantity);
  std::string                     line = PaddedRight(WithSigns(label), 24) + " " + PaddedLeft(rounded.value, 12) + " ";
  line += hasErrors ? PaddedRight(rounded.error, 12) + " " : " ";
  line += PaddedRight(WithSigns(unit), 8) + " " + PaddedRight(NameOf(quantity.status), 17) + " ";
  line += range ? "[" + End(range->low, rounded) + ", " + End(range->high, rounded) + "]" : "";
  return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

std::string
DescribeClipSource(std::string source)
{
  const std::array<std::pair<std::string, std::string>, 2> words{ { { "code range", "DN range" },
                                                                    { "pile-up", "repeated extreme values" } } };
  for (const auto & [member, word] : words)
  {
    for (std::size_t at = source.find(member); at != std::string::npos; at = source.find(member))
    {
      source.replace(at, member.size(), word);
    }
  }
  return source;
}

std::string
DescribeInput(const std::optional<InputRecord> & input)
{
  if (!input)
  {
    return "";
  }
  return DescribeFrames("frames", input->frames) + (input->dark ? DescribeFrames("dark frames", *input->dark) : "");
}

std::string
DescribeFit(const Report & report)
{
  if (!report.fit.reducedChi2)
  {
    return "";
  }
  return Format("fit: reduced chi2 %.4g (1: only sampling noise is left)", *report.fit.reducedChi2) +
         (report.fit.offsetLinePhi
            ? Format(", offset line %.4g (1: all pixels have one flicker)", *report.fit.offsetLinePhi)
            : "");
}

std::string
DescribeResponse(const Report & report)
{
  if (!report.fit.nonlinearity)
  {
    return "";
  }
  return *report.fit.nonlinearity > 0.0
           ? Format("response: the variance deviates from its line by up to %.2g %% of itself",
                    100.0 * *report.fit.nonlinearity)
           : "response: the variance deviates from its line by no more than noise";
}

std::string
DescribeNoise(const Report & report)
{
  if (!report.noiseCorrelation)
  {
    return "";
  }
  const NoiseCorrelationRecord & noise = *report.noiseCorrelation;
  if (noise.kind == "white")
  {
    const bool hasLines = IsIdentified(noise.rowNoise) || IsIdentified(noise.columnNoise);
    const bool hasWaves = !noise.interference.empty();
    return !hasLines && !hasWaves
             ? "noise: white (no correlation between neighbours or frames)"
             : std::string("noise: white, except for ") + (hasLines ? "row and column noise" : "") +
                 (hasLines && hasWaves ? " and " : "") + (hasWaves ? "periodic interference" : "");
  }
  if (noise.kind == "not-linear")
  {
    return "noise: not-linear (not as a sensor or a linear filter leaves it: the gain is not identifiable)";
  }
  if (noise.kind == "enlarged")
  {
    return "noise: enlarged (fewer samples than pixels: the gain is not identifiable)";
  }
  const std::string text = "noise: " + noise.kind +
                           (noise.kind == "temporal" ? ", correlation of frames" + LargestCorrelation(noise.time)
                                                     : ", correlation of neighbours" + LargestCorrelation(noise.space));
  return text + (report.gain.value ? "; the gain is from the covariance over all lags" : "");
}

std::string
DescribeLinearity(const Report & report)
{
  const LinearityRecord & linearity = report.linearity;
  if (linearity.levels.empty())
  {
    return "";
  }
  if (!linearity.reason.empty())
  {
    return "linearity: not identifiable: " + linearity.reason;
  }
  const auto used = std::count_if(linearity.levels.begin(), linearity.levels.end(), [](const auto & level) {
    return level.deviationPercent.has_value();
  });
  return Format("linearity: %d of %zu exposures in the range, saturation %.5g DN (",
                static_cast<int>(used),
                linearity.levels.size(),
                linearity.saturationDn.value_or(0.0)) +
         DescribeClipSource(linearity.saturationSource) + "), offset of " +
         (linearity.offsetSource == "line" ? "the line" : linearity.offsetSource);
}

std::string
TextOfCounted(const Report & report)
{
  const std::size_t leftOut = report.framesLeftOut.size();
  std::string       text = leftOut > 0 ? Format("%zu left out", leftOut) : "";
  if (report.framesDistinct + leftOut < report.frames)
  {
    text += (text.empty() ? "" : ", ") + Format("%zu different", report.framesDistinct);
  }
  return text.empty() ? text : " (" + text + ")";
}

std::string
MakeTable(const Report & report)
{
  std::string table = CountText(report.frames, "frame");
  table += TextOfCounted(report);
  table += Format(" of %zu x %zu pixels", report.width, report.height);
  table += DescribeDnRange(report) + "\n";
  table += Format("%zu of %zu pixels used (%.1f %%), %zu clipped, %zu not finite\n",
                  report.pixels.used,
                  report.pixels.total,
                  100.0 * static_cast<double>(report.pixels.used) /
                    static_cast<double>(std::max<std::size_t>(1, report.pixels.total)),
                  report.pixels.clipped,
                  report.pixels.notFinite);
  table += "method: " + report.method + "\n" + DescribeInput(report.input) + "\n";
  std::vector<QuantityEntry> rows;
  std::copy_if(QuantityList().begin(),
               QuantityList().end(),
               std::back_inserter(rows),
               [&](const QuantityEntry & entry) { return IsShown(entry, report); });
  const bool hasErrors = std::any_of(
    rows.begin(), rows.end(), [&](const QuantityEntry & entry) { return entry.of(report)->standardError.has_value(); });
  table += Format("%-24s %12s ", "quantity", "value") + (hasErrors ? Format("%-12s ", "  error") : " ");
  table += Format("%-8s %-17s %s\n", "unit", "status", hasErrors ? "95 % interval or limits" : "limits");
  for (const QuantityEntry & entry : rows)
  {
    table += QuantityLine(entry.label, entry.unit, *entry.of(report), hasErrors);
  }
  if (report.fit.line && !report.gain.value)
  {
    table += Format("\nindicative: variance = %.5g mean %+.5g (the line through all levels; no measurement)\n",
                    report.fit.line->gain,
                    report.fit.line->intercept);
  }
  bool isFirst = true;
  for (const std::string & line :
       { DescribeFit(report), DescribeResponse(report), DescribeNoise(report), DescribeLinearity(report) })
  {
    table += line.empty() ? "" : (isFirst ? "\n" : "") + line + "\n";
    isFirst = isFirst && line.empty();
  }
  return table;
}

std::string
TextOf(const Warning & warning)
{
  const WarningKind & kind = KindOf(warning.code);
  return std::string(NameOf(kind.severity)) + ": " + WithSigns(warning.message) + " [" + kind.name + "]\n";
}

std::string
MakeText(const Report & report)
{
  std::string text = MakeTable(report);
  for (const Warning & warning : report.warnings)
  {
    text += (&warning == &report.warnings.front() ? "\n" : "") + TextOf(warning);
  }
  return text;
}

} // namespace sensornoise
