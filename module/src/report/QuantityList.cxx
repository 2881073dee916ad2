// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"

#include "sensornoise/WarningCodes.h"
#include "report/JsonWriter.h"

#include <array>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns a quantity of the report, for QuantityEntry::of. */
template <Quantity Report::* VMember>
const Quantity *
OfReport(const Report & report)
{
  return &(report.*VMember);
}

/** Returns a quantity of the noise correlation; null: the noise correlation was not measured. */
template <Quantity NoiseCorrelationRecord::* VMember>
const Quantity *
OfNoise(const Report & report)
{
  return report.noiseCorrelation ? &((*report.noiseCorrelation).*VMember) : nullptr;
}
using Noise = NoiseCorrelationRecord;

/** Returns a quantity of the linearity. */
template <Quantity LinearityRecord::* VMember>
const Quantity *
OfLinearity(const Report & report)
{
  return &(report.linearity.*VMember);
}

constexpr std::array Entries{
  QuantityEntry{
    "gain",
    "gain g",
    "DN/e-",
    "Slope of the variance against the level. It is the number of DN per electron if nothing multiplies or adds noise "
    "to the signal. For an EMCCD or an intensified camera it is the excess noise factor times the gain.",
    ShownIn::EveryTable,
    QuantityDomain::Positive,
    OfReport<&Report::gain> },
  QuantityEntry{ "offset",
                 "offset mu",
                 "DN",
                 "Dark offset: the level without signal. Without dark frames it is the component of the level that "
                 "does not change with the illumination.",
                 ShownIn::EveryTable,
                 QuantityDomain::Offset,
                 OfReport<&Report::offset> },
  QuantityEntry{ "read_noise",
                 "read noise sigma",
                 "DN",
                 "Standard deviation of the noise without signal, rms over all pixels that are not defective. "
                 "Quantization noise is not included.",
                 ShownIn::EveryTable,
                 QuantityDomain::NonNegative,
                 OfReport<&Report::readNoise> },
  QuantityEntry{ "read_noise_median",
                 "read noise, median pixel",
                 "DN",
                 "Read noise of the median pixel, where the pixels differ. Only dark frames determine it.",
                 ShownIn::TableIfKnown,
                 QuantityDomain::NonNegative,
                 OfReport<&Report::readNoiseMedian> },
  QuantityEntry{ "read_noise_electrons",
                 "read noise sigma / g",
                 "e-",
                 "Read noise divided by the gain.",
                 ShownIn::EveryTable,
                 QuantityDomain::NonNegative,
                 OfReport<&Report::readNoiseElectrons> },
  QuantityEntry{
    "intercept",
    "intercept sigma^2 - g mu",
    "DN^2",
    "Intercept of the photon transfer line: the variance of the sensor at level 0, without quantization noise.",
    ShownIn::EveryTable,
    QuantityDomain::AnySign,
    OfReport<&Report::intercept> },
  QuantityEntry{ "variance_slope",
                 "variance slope",
                 "DN/e-",
                 "Slope of the variance of a pixel against its level, in the frames as they are, for a denoiser. It "
                 "equals the gain if the noise is white and the quantization is uniform.",
                 ShownIn::TableIfNotTheGain,
                 QuantityDomain::Positive,
                 OfReport<&Report::varianceSlope> },
  QuantityEntry{ "total_intercept",
                 "total intercept",
                 "DN^2",
                 "Variance of a pixel at level 0, in the frames as they are, with quantization noise, for a denoiser.",
                 ShownIn::EveryTable,
                 QuantityDomain::AnySign,
                 OfReport<&Report::totalIntercept> },
  QuantityEntry{ "flicker_sd",
                 "flicker sd",
                 "1",
                 "Standard deviation of the illumination factor from frame to frame, relative to its mean.",
                 ShownIn::EveryTable,
                 QuantityDomain::NonNegative,
                 OfReport<&Report::flickerSd> },
  QuantityEntry{ "vibration.sd_x",
                 "vibration sd x",
                 "pixel",
                 "Standard deviation of the motion along x.",
                 ShownIn::EveryTable,
                 QuantityDomain::NonNegative,
                 OfReport<&Report::vibrationSdX> },
  QuantityEntry{ "vibration.sd_y",
                 "vibration sd y",
                 "pixel",
                 "Standard deviation of the motion along y.",
                 ShownIn::EveryTable,
                 QuantityDomain::NonNegative,
                 OfReport<&Report::vibrationSdY> },
  QuantityEntry{ "vibration.covariance",
                 "vibration covariance",
                 "pixel^2",
                 "Covariance of the motions along x and along y.",
                 ShownIn::Record,
                 QuantityDomain::AnySign,
                 OfReport<&Report::vibrationCovariance> },
  QuantityEntry{ "noise_correlation.row_noise",
                 "row noise",
                 "DN",
                 "Standard deviation of the noise that all pixels of a row have in common in one frame.",
                 ShownIn::TableIfKnown,
                 QuantityDomain::NonNegative,
                 OfNoise<&Noise::rowNoise> },
  QuantityEntry{ "noise_correlation.column_noise",
                 "column noise",
                 "DN",
                 "Standard deviation of the noise that all pixels of a column have in common in one frame.",
                 ShownIn::TableIfKnown,
                 QuantityDomain::NonNegative,
                 OfNoise<&Noise::columnNoise> },
  QuantityEntry{ "noise_correlation.excess_kurtosis",
                 "excess kurtosis",
                 "1",
                 "Excess kurtosis of the noise of a pixel. It is 0 for normal noise.",
                 ShownIn::Record,
                 QuantityDomain::AnySign,
                 OfNoise<&Noise::excessKurtosis> },
  QuantityEntry{
    "linearity.linearity_error_percent",
    "linearity error",
    "%",
    "Mean absolute deviation of the levels from a line through the exposures, from 5 to 95 % of saturation.",
    ShownIn::TableIfLimited,
    QuantityDomain::NonNegative,
    OfLinearity<&LinearityRecord::errorPercent> },
  QuantityEntry{ "linearity.offset_dn",
                 "offset by exposures",
                 "DN",
                 "Level at exposure 0: the mean of frames of that exposure if there are any, else the value of the "
                 "line through the exposures.",
                 ShownIn::TableIfLimited,
                 QuantityDomain::Offset,
                 OfLinearity<&LinearityRecord::offsetDn> },
  QuantityEntry{ "linearity.responsivity_dn_per_exposure",
                 "responsivity",
                 "DN/unit",
                 "Slope of the line through the exposures, at the brightest parts of the frames.",
                 ShownIn::TableIfLimited,
                 QuantityDomain::Positive,
                 OfLinearity<&LinearityRecord::responsivity> },
};
} // namespace

const std::vector<QuantityEntry> &
QuantityList()
{
  static const std::vector<QuantityEntry> list(Entries.begin(), Entries.end());
  return list;
}

/** Writes an entry of the catalogue. JsonWriter::Write() calls these functions by their argument. */
static void
WriteJson(JsonWriter & json, const WarningKind & kind)
{
  json.Object([&] {
    json.Member("code", kind.name).Member("severity", NameOf(kind.severity)).Member("sentence", kind.sentence);
  });
}

static void
WriteJson(JsonWriter & json, const QuantityEntry & entry)
{
  json.Object([&] {
    json.Member("path", entry.path).Member("label", entry.label).Member("unit", entry.unit);
    json.Member("meaning", entry.meaning);
  });
}

std::string
CatalogueAsJson()
{
  std::string text;
  JsonWriter  json(text);
  json.Object([&] { json.Member("warnings", WarningTable).Member("quantities", QuantityList()); });
  text += '\n';
  return text;
}

} // namespace sensornoise
