// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"

#include <array>

namespace sensornoise
{

namespace
{
template <Quantity Report::* VMember>
const Quantity *
OfReport(const Report & report)
{
  return &(report.*VMember);
}

template <Quantity NoiseCorrelationRecord::* VMember>
const Quantity *
OfNoise(const Report & report)
{
  return report.noiseCorrelation ? &((*report.noiseCorrelation).*VMember) : nullptr;
}
using Noise = NoiseCorrelationRecord;

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
    "Slope of the variance against the level: DN per electron, if nothing multiplies or adds noise to the light. Of "
    "an EMCCD or an intensifier it is the excess noise factor times the gain.",
    ShownIn::EveryTable,
    QuantityDomain::Positive,
    OfReport<&Report::gain> },
  QuantityEntry{ "offset",
                 "offset mu",
                 "DN",
                 "Level without light; of a burst alone, the level that does not flicker.",
                 ShownIn::EveryTable,
                 QuantityDomain::Offset,
                 OfReport<&Report::offset> },
  QuantityEntry{ "read_noise",
                 "read noise sigma",
                 "DN",
                 "Noise without light, rms over all pixels that are not defective; without rounding.",
                 ShownIn::EveryTable,
                 QuantityDomain::NonNegative,
                 OfReport<&Report::readNoise> },
  QuantityEntry{ "read_noise_median",
                 "read noise, median pixel",
                 "DN",
                 "Of the median pixel, where pixels differ; only dark frames tell it.",
                 ShownIn::TableIfKnown,
                 QuantityDomain::NonNegative,
                 OfReport<&Report::readNoiseMedian> },
  QuantityEntry{ "read_noise_electrons",
                 "read noise sigma / g",
                 "e-",
                 "Read noise over gain.",
                 ShownIn::EveryTable,
                 QuantityDomain::NonNegative,
                 OfReport<&Report::readNoiseElectrons> },
  QuantityEntry{ "intercept",
                 "intercept sigma^2 - g mu",
                 "DN^2",
                 "Of the sensor's variance at level 0, without rounding.",
                 ShownIn::EveryTable,
                 QuantityDomain::AnySign,
                 OfReport<&Report::intercept> },
  QuantityEntry{
    "variance_slope",
    "variance slope",
    "DN/e-",
    "Of a pixel's variance against its level, in the frames as they are: for a denoiser. The gain where noise is "
    "white "
    "and codes are even.",
    ShownIn::TableIfNotTheGain,
    QuantityDomain::Positive,
    OfReport<&Report::varianceSlope> },
  QuantityEntry{ "total_intercept",
                 "total intercept",
                 "DN^2",
                 "Of a pixel's variance at level 0, in the frames as they are, rounding included: for a denoiser.",
                 ShownIn::EveryTable,
                 QuantityDomain::AnySign,
                 OfReport<&Report::totalIntercept> },
  QuantityEntry{ "flicker_sd",
                 "flicker sd",
                 "1",
                 "Standard deviation of the light from frame to frame, relative to it.",
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
                 "Of the motion along x and along y.",
                 ShownIn::Record,
                 QuantityDomain::AnySign,
                 OfReport<&Report::vibrationCovariance> },
  QuantityEntry{ "noise_correlation.row_noise",
                 "row noise",
                 "DN",
                 "Common to the pixels of a row in one frame.",
                 ShownIn::TableIfKnown,
                 QuantityDomain::NonNegative,
                 OfNoise<&Noise::rowNoise> },
  QuantityEntry{ "noise_correlation.column_noise",
                 "column noise",
                 "DN",
                 "Common to the pixels of a column in one frame.",
                 ShownIn::TableIfKnown,
                 QuantityDomain::NonNegative,
                 OfNoise<&Noise::columnNoise> },
  QuantityEntry{ "noise_correlation.excess_kurtosis",
                 "excess kurtosis",
                 "1",
                 "Of the noise of a pixel; 0: normal.",
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
                 "Level at exposure 0: of frames of that exposure, else of the line through the exposures.",
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

} // namespace sensornoise
