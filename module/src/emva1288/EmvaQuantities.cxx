// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Emva1288.h"

namespace sensornoise
{

const std::vector<EmvaQuantityEntry> &
EmvaQuantityList()
{
  using Of = EmvaReport;
  static const std::vector<EmvaQuantityEntry> entries{
    { "sensitivity", "gain", "K", "system gain", "DN/e-", "(50)", &Of::gain },
    { "sensitivity", "weighted_gain", "", "weighted gain", "DN/e-", "", &Of::weightedGain },
    { "sensitivity", "weighted_intercept", "", "weighted intercept", "DN^2", "", &Of::weightedIntercept },
    { "sensitivity", "weighted_reduced_chi2", "", "weighted reduced chi2", "1", "", &Of::weightedReducedChi2 },
    { "sensitivity", "responsivity", "R", "responsivity", "DN/photon", "(49)", &Of::responsivity },
    { "sensitivity", "quantum_efficiency", "η", "quantum efficiency", "%", "(52)", &Of::quantumEfficiency },
    { "sensitivity", "dark_signal", "μ_y.dark", "dark signal", "DN", "(16)", &Of::darkSignal },
    { "sensitivity", "dark_noise_dn", "σ_y.dark", "dark noise", "DN", "(18)", &Of::darkNoise },
    { "sensitivity", "dark_noise", "σ_d", "dark noise", "e-", "(53)", &Of::darkNoiseElectrons },
    { "sensitivity", "saturation_dn", "μ_y.sat - μ_y.dark", "saturation", "DN", "6.6", &Of::saturationSignal },
    { "sensitivity", "saturation_photons", "μ_p.sat", "saturation capacity", "photon", "6.6", &Of::saturationPhotons },
    { "sensitivity", "saturation_electrons", "μ_e.sat", "saturation capacity", "e-", "6.6", &Of::saturationElectrons },
    { "sensitivity", "threshold_photons", "μ_p.min", "sensitivity threshold", "photon", "(26)", &Of::thresholdPhotons },
    { "sensitivity", "threshold_electrons", "μ_e.min", "sensitivity threshold", "e-", "(26)", &Of::thresholdElectrons },
    { "sensitivity", "snr_max", "SNR_max", "maximum SNR", "1", "(55)", &Of::largestSnr },
    { "sensitivity", "dynamic_range", "DR", "dynamic range", "1", "(28)", &Of::dynamicRange },
    { "linearity", "linearity_error", "LE", "linearity error", "%", "(63)", &Of::linearityError },
    { "linearity",
      "linearity_error_without_noise",
      "",
      "the same without noise",
      "%",
      "",
      &Of::linearityErrorCorrected },
    { "linearity", "lowest_deviation", "", "lowest deviation", "%", "(62)", &Of::lowestDeviation },
    { "linearity", "highest_deviation", "", "highest deviation", "%", "(62)", &Of::highestDeviation },
    { "linearity", "slope", "a_1", "slope of the line", "DN/unit", "(60)", &Of::linearitySlope },
    { "linearity", "offset", "a_0", "offset of the line", "DN", "(59)", &Of::linearityOffset },
    { "dark_current", "dark_current_dn", "μ_I.y", "dark current, mean", "DN/unit", "7.1", &Of::darkCurrent },
    { "dark_current", "dark_current", "μ_I.e", "dark current, mean", "e-/unit", "7.1", &Of::darkCurrentElectrons },
    { "dark_current",
      "dark_current_of_variance",
      "μ_I.e",
      "dark current, variance",
      "e-/unit",
      "7.1",
      &Of::darkCurrentOfVariance },
    { "spatial", "dsnu", "DSNU_1288", "DSNU", "e-", "(66)", &Of::dsnu },
    { "spatial", "dsnu_column", "DSNU_1288.col", "DSNU, columns", "e-", "(66)", &Of::dsnuColumn },
    { "spatial", "dsnu_row", "DSNU_1288.row", "DSNU, rows", "e-", "(66)", &Of::dsnuRow },
    { "spatial", "dsnu_pixel", "DSNU_1288.pixel", "DSNU, pixels", "e-", "(66)", &Of::dsnuPixel },
    { "spatial", "prnu", "PRNU_1288", "PRNU", "%", "(67)", &Of::prnu },
    { "spatial", "prnu_column", "PRNU_1288.col", "PRNU, columns", "%", "(67)", &Of::prnuColumn },
    { "spatial", "prnu_row", "PRNU_1288.row", "PRNU, rows", "%", "(67)", &Of::prnuRow },
    { "spatial", "prnu_pixel", "PRNU_1288.pixel", "PRNU, pixels", "%", "(67)", &Of::prnuPixel },
    { "comparison", "gain_through_origin", "", "gain, no offset", "DN/e-", "", &Of::gainThroughOrigin },
    { "comparison", "dsnu_unfiltered", "", "DSNU, unfiltered", "e-", "", &Of::dsnuUnfiltered },
    { "comparison", "prnu_unfiltered", "", "PRNU, unfiltered", "%", "", &Of::prnuUnfiltered },
  };
  return entries;
}

} // namespace sensornoise
