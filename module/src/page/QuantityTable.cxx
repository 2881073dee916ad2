// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PageSections.h"

#include "base/Text.h"
#include "report/ReportParts.h"
#include "sensornoise/ReportText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

namespace
{
/** Quantity of EMVA 1288 with its value from the report. */
struct Emva1288Row
{
  std::string symbol;
  std::string name;
  std::string value;  ///< value with its unit, "not given by this method", or "not known"
  std::string source; ///< quantity of the report that it is, or from which it is computed
};

const char * const NotGiven = "not given by this method";

using Number = std::optional<double>;

std::string
Computed(const Number & number, const std::string & unit)
{
  return number && std::isfinite(*number) ? "\u2248 " + Rounded(*number) + " " + unit : "not known";
}

std::string
Found(const Quantity & quantity, const char * unit)
{
  const bool isKnown = quantity.value || quantity.status == EstimateStatus::UpperLimit;
  return isKnown ? ValueText(quantity) + " " + UnitText(unit) : "not known";
}

/** Quantities that follow from the report by the linear model of EMVA 1288; none: an input of the formula is not known.
 */
struct Computations
{
  Number quantisationDn;      ///< quantization noise sigma_q [DN]
  Number darkNoiseDn;         ///< dark noise sigma_y.dark, with quantization noise [DN]
  Number saturationElectrons; ///< saturation capacity mu_e.sat [e-]
  Number thresholdElectrons;  ///< sensitivity threshold mu_e.min [e-], at which signal and noise are equal

  explicit Computations(const Report & report)
  {
    const Number gain = report.gain.value;
    if (report.quantisationStepDn)
    {
      quantisationDn = *report.quantisationStepDn / std::sqrt(12.0);
    }
    if (report.readNoise.value)
    {
      darkNoiseDn = std::hypot(*report.readNoise.value, quantisationDn.value_or(0.0));
    }
    if (!gain || !(*gain > 0.0))
    {
      return;
    }
    if (report.clipHighDn && report.offset.value && *report.clipHighDn > *report.offset.value)
    {
      saturationElectrons = (*report.clipHighDn - *report.offset.value) / *gain;
    }
    if (darkNoiseDn)
    {
      // solves n = sqrt(noise^2 + n)
      thresholdElectrons = 0.5 + std::hypot(*darkNoiseDn / *gain, 0.5);
    }
  }

  Number
  DynamicRangeDb() const
  {
    return saturationElectrons && thresholdElectrons
             ? Number(20.0 * std::log10(*saturationElectrons / *thresholdElectrons))
             : std::nullopt;
  }
  Number
  BestSnr() const
  {
    return saturationElectrons ? Number(std::sqrt(*saturationElectrons)) : std::nullopt;
  }
};

/** Returns the linearity error, which needs given exposures. */
Emva1288Row
LinearityRow(const Report & report)
{
  const LinearityRecord & linearity = report.linearity;
  const char * const      symbol = "LE";
  const char * const      name = "linearity error";
  return linearity.levels.empty()
           ? Emva1288Row{ symbol, name, NotGiven, "no exposures; the residuals above show the variance's deviation" }
           : Emva1288Row{
               symbol, name, Found(linearity.errorPercent, "%"), "levels of 5 to 95 % of saturation against exposures"
             };
}

/** Returns the quantities that EMVA 1288 requires. Quantum efficiency and measured SNR curve need a count of photons,
 * which a burst does not give. The linear model of the standard gives the quantities that follow from gain, read noise,
 * offset and saturation level. */
std::vector<Emva1288Row>
Emva1288Rows(const Report & report)
{
  const Computations computed(report);
  const std::string  electrons = "e\u207B";
  const std::string clip = "highest level less offset, over gain; clip level: " + DescribeClipSource(report.clipSource);
  return {
    { "K", "system gain", Found(report.gain, "DN/e-"), "gain g" },
    { "\u03BC_y.dark", "dark signal", Found(report.offset, "DN"), "offset \u03BC" },
    { "\u03C3_d", "dark noise", Found(report.readNoiseElectrons, "e-"), "read noise \u03C3 / g" },
    { "\u03C3_y.dark", "dark noise", Computed(computed.darkNoiseDn, "DN"), "\u03C3 and rounding, added as squares" },
    { "\u03C3_q", "quantization noise", Computed(computed.quantisationDn, "DN"), "quantization step / \u221A12" },
    { "\u03BC_e.sat", "saturation capacity", Computed(computed.saturationElectrons, electrons), clip },
    { "\u03BC_e.min",
      "sensitivity threshold",
      Computed(computed.thresholdElectrons, electrons),
      "where signal and noise are equal, by the model" },
    { "DR", "dynamic range", Computed(computed.DynamicRangeDb(), "dB"), "\u03BC_e.sat / \u03BC_e.min, by the model" },
    { "SNR_max", "largest signal to noise", Computed(computed.BestSnr(), ""), "\u221A\u03BC_e.sat, by the model" },
    { "SNR(\u03BC_p)", "measured SNR curve", NotGiven, "photons are not counted" },
    { "\u03B7", "quantum efficiency", NotGiven, "photons are not counted" },
    LinearityRow(report),
    { "DSNU, PRNU", "non-uniformity", NotGiven, "no dark and no flat field" },
    { "\u03BC_I", "dark current", NotGiven, "one exposure" },
  };
}
} // namespace

std::string
EmvaTable(const Report & report)
{
  if (!HasValues(report))
  {
    return "<p>None of its quantities is known.</p>\n";
  }
  std::string rows;
  for (const Emva1288Row & row : Emva1288Rows(report))
  {
    rows += "<tr><th scope=\"row\">" + WithIndices(row.symbol) + "</th><td>" + Escaped(row.name) + "</td><td>" +
            Escaped(row.value) + "<small>" + WithIndices(row.source) + "</small></td></tr>\n";
  }
  return "<p class=\"soft\">Symbols of EMVA 1288; values with \u2248 are computed from gain, read noise, offset and "
         "the "
         "highest level by the standard's linear model, not measured by its procedure.</p>\n<table><thead><tr><th "
         "scope=\"col\">Symbol</th><th scope=\"col\">Name</th><th scope=\"col\">Value</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

} // namespace sensornoise
