// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PageSections.h"

#include "base/Text.h"
#include "sensornoise/ReportText.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

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
  const std::string  clip = "highest level less offset, over gain; clip level: " + report.clipSource;
  return {
    { "K", "system gain", Found(report.gain, "DN/e-"), "gain g" },
    { "\u03BC_y.dark", "dark signal", Found(report.offset, "DN"), "offset \u03BC" },
    { "\u03C3_d", "dark noise", Found(report.readNoiseElectrons, "e-"), "read noise \u03C3 / g" },
    { "\u03C3_y.dark", "dark noise", Computed(computed.darkNoiseDn, "DN"), "\u03C3 and rounding, added as squares" },
    { "\u03C3_q", "quantisation noise", Computed(computed.quantisationDn, "DN"), "quantization step / \u221A12" },
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
