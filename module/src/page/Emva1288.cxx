// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Emva1288.h"

#include "base/Text.h"
#include "page/HtmlText.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
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

/** What the standard's linear model makes of the report; null: something of it is not known. */
struct Computations
{
  Number quantisationDn;      ///< sigma_q
  Number darkNoiseDn;         ///< sigma_y.dark, rounding included
  Number saturationElectrons; ///< mu_e.sat
  Number thresholdElectrons;  ///< mu_e.min, where the signal is as large as its noise

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
      // n = sqrt(noise^2 + n) solved for n
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

/** Measured where exposures were given. */
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
} // namespace

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
    { "\u03C3_q", "quantisation noise", Computed(computed.quantisationDn, "DN"), "code step / \u221A12" },
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

} // namespace sensornoise
