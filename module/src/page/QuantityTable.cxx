// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PageSections.h"

#include "base/Text.h"
#include "sensornoise/ReportText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace sensornoise
{
namespace
{
enum class QuantityGroup : std::uint8_t
{
  Sensor,
  Scene,
  Denoiser
};

constexpr std::array<std::pair<QuantityGroup, const char *>, 3> Groups{
  { { QuantityGroup::Sensor, "Sensor" },
    { QuantityGroup::Scene, "Illumination and motion" },
    { QuantityGroup::Denoiser, "For a denoiser: variance = slope \u00D7 level + intercept" } }
};

QuantityGroup
GroupOf(const std::string & path)
{
  if (path == "variance_slope" || path == "total_intercept")
  {
    return QuantityGroup::Denoiser;
  }
  return path == "flicker_sd" || path.rfind("vibration.", 0) == 0 ? QuantityGroup::Scene : QuantityGroup::Sensor;
}

bool
HasValue(const Quantity & quantity)
{
  return quantity.value && std::isfinite(*quantity.value);
}

/** Returns whether the page has a row for a quantity: it has a value, or an upper limit that tables show, or it is in
 * every table. */
bool
HasRow(const QuantityEntry & entry, const Report & report)
{
  const Quantity * const quantity = entry.of(report);
  return quantity != nullptr &&
         (entry.shown == ShownIn::EveryTable || HasValue(*quantity) ||
          (entry.shown == ShownIn::TableIfLimited && quantity->status == EstimateStatus::UpperLimit));
}

/** Returns "5.0004" and "± 0.0026" as HTML; the second is "" without an error. */
std::pair<std::string, std::string>
ValueAndError(const Quantity & quantity)
{
  const std::string sign = " \u00B1 ";
  const std::string text = Escaped(ValueText(quantity));
  const std::size_t at = text.find(sign);
  return at == std::string::npos ? std::pair(text, std::string())
                                 : std::pair(text.substr(0, at), "\u00B1&#160;" + text.substr(at + sign.size()));
}

/** Returns "upper limit", "not identifiable" or "failed"; "" for an identified quantity. */
std::string
StatusWords(const Quantity & quantity)
{
  std::string words = quantity.status == EstimateStatus::Identified ? "" : NameOf(quantity.status);
  std::replace(words.begin(), words.end(), '-', ' ');
  return words;
}

/** Returns the unit for a value or an upper limit; "" if there is no number. */
std::string
UnitOf(const Quantity & quantity, const std::string & unit)
{
  return HasValue(quantity) || ValueText(quantity).front() == '<' ? UnitText(unit) : "";
}

/** Returns the status and the range, for example "upper limit, limits 0 to 1.58". \a nameOfInterval replaces "limits "
 * before a 95 % interval. */
std::string
StatusAndRange(const Quantity & quantity, const std::string & nameOfInterval)
{
  const std::string status = StatusWords(quantity);
  const std::string range = RangeText(quantity);
  return status + (status.empty() || range.empty() ? "" : ", ") +
         (range.empty() ? "" : (quantity.interval95 ? nameOfInterval : "limits ") + range);
}

} // namespace

std::string
QuantityRow(const std::string & label, const std::string & meaning, const Quantity & quantity, const std::string & unit)
{
  const auto [value, error] = ValueAndError(quantity);
  return "<tr role=\"row\"><th role=\"rowheader\" scope=\"row\" abbr=\"" + Escaped(label) + "\"><span>" +
         Escaped(label) + "</span><small>" + meaning + "</small></th><td role=\"cell\" class=\"number\">" + value +
         "</td><td role=\"cell\" class=\"number\">" + error + "</td><td role=\"cell\" class=\"unit\">" +
         UnitOf(quantity, unit) + "</td><td role=\"cell\" class=\"range\">" + Escaped(StatusAndRange(quantity, "")) +
         "</td></tr>\n";
}

std::string
QuantityGroupRows(const std::string & title, const std::string & rows)
{
  return rows.empty() ? ""
                      : "<tbody role=\"rowgroup\"><tr role=\"row\"><th role=\"rowheader\" scope=\"rowgroup\" "
                        "colspan=\"5\" class=\"group\">" +
                          Escaped(title) + "</th></tr>\n" + rows + "</tbody>\n";
}

std::string
TableOfGroups(const std::string & groups)
{
  const auto head = [](const char * style, const char * words) {
    return "<th role=\"columnheader\" scope=\"col\" class=\"" + std::string(style) + "\">" + words + "</th>";
  };
  return "<table role=\"table\" class=\"quantities\"><thead role=\"rowgroup\"><tr role=\"row\">" +
         head("label", "<span>Quantity</span>") + head("number", "Value") + head("number", "Error") +
         head("unit", "Unit") + head("range", "95 % interval, or status") + "</tr></thead>\n" + groups + "</table>\n";
}

std::string
KeyCard(const std::string & name, const Quantity & quantity, const std::string & unit, const std::string & besides)
{
  const auto [value, error] = ValueAndError(quantity);
  const std::string below = StatusAndRange(quantity, "95 %: ");
  const bool        isPlain = quantity.status == EstimateStatus::Identified;
  return std::string("<div class=\"key") + (isPlain ? "" : " is-warning") + "\"><dt>" + Escaped(name) + "</dt><dd><b>" +
         value + "</b> <span class=\"nowrap\">" + error + (error.empty() ? "" : " ") + UnitOf(quantity, unit) +
         "</span></dd><dd class=\"soft\">" + Unbroken(Escaped(below)) +
         (besides.empty() ? "" : "; <span class=\"nowrap\">" + Escaped(besides) + "</span>") + "</dd></div>\n";
}

namespace
{
/** Returns the card of the read noise in electrons, with its value in DN below. If only the value in DN is known, the
 * card shows this value. */
std::string
ReadNoiseCard(const Report & report)
{
  const auto is = [](const Quantity & quantity) {
    return HasValue(quantity) || quantity.status == EstimateStatus::UpperLimit;
  };
  const bool isInElectrons = is(report.readNoiseElectrons) || !is(report.readNoise);
  const bool hasBoth = isInElectrons && is(report.readNoise);
  return KeyCard("Read noise",
                 isInElectrons ? report.readNoiseElectrons : report.readNoise,
                 isInElectrons ? "e-" : "DN",
                 hasBoth ? ValueText(report.readNoise) + " DN" : "");
}
} // namespace

bool
HasValues(const Report & report)
{
  return std::any_of(QuantityList().begin(), QuantityList().end(), [&](const QuantityEntry & entry) {
    const Quantity * const quantity = entry.of(report);
    return quantity != nullptr && (quantity->value || quantity->status == EstimateStatus::UpperLimit);
  });
}

std::string
KeyNumbers(const Report & report)
{
  return HasValues(report) ? "<dl class=\"keys\">\n" + KeyCard("Gain", report.gain, "DN/e-") + ReadNoiseCard(report) +
                               KeyCard("Offset", report.offset, "DN") + "</dl>\n"
                           : "";
}

std::string
QuantityTable(const Report & report)
{
  if (!HasValues(report))
  {
    return "<p>No quantity has a value.</p>\n";
  }
  std::string bodies;
  for (const auto & [group, name] : Groups)
  {
    std::string rows;
    for (const QuantityEntry & entry : QuantityList())
    {
      rows += GroupOf(entry.path) == group && HasRow(entry, report)
                ? QuantityRow(LabelText(entry.label), WithCode(entry.meaning), *entry.of(report), entry.unit)
                : std::string();
    }
    bodies += QuantityGroupRows(name, rows);
  }
  return TableOfGroups(bodies);
}

} // namespace sensornoise
