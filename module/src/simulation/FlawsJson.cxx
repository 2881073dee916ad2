// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FlawsJson.h"

#include <array>

namespace sensornoise
{

void
WriteJson(JsonWriter & json, const SensorFlaws & flaws)
{
  json.Object([&] {
    json.ObjectMember("filters", [&] {
      const ColourFilterSettings & filters = flaws.filters;
      json.Member("bayer", filters.pattern ? NameOf(*filters.pattern) : "none");
      json.Member("transmission",
                  std::array<double, 3>{ filters.transmissionR, filters.transmissionG, filters.transmissionB });
    });
    json.ObjectMember("pattern", [&] {
      json.Member("gain_sd", flaws.pattern.gainSd).Member("column_gain_sd", flaws.pattern.columnGainSd);
      json.Member("column_efficiency_sd", flaws.pattern.columnEfficiencySd);
      json.Member("column_offset_sd", flaws.pattern.columnOffsetSdDn);
    });
    json.Member("brighter_fatter_per_electron", flaws.brighterFatter.perElectron);
    json.Member("coupling_fraction", flaws.coupling.fraction);
    json.ObjectMember("read_noise", [&] {
      json.Member("spread", flaws.readNoise.spread).Member("tail_fraction", flaws.readNoise.tailFraction);
      json.Member("tail_spread", flaws.readNoise.tailSpread);
    });
    json.ObjectMember("response", [&] {
      json.Member("shape", NameOf(flaws.response.shape)).Member("size", flaws.response.size);
      json.Member("full_scale_electrons", flaws.response.fullScaleElectrons);
    });
    json.ObjectMember("line_noise", [&] {
      json.Member("row_noise_sd", flaws.lineNoise.rowNoiseSdDn);
      json.Member("column_noise_sd", flaws.lineNoise.columnNoiseSdDn);
      json.Member("banding_amplitude", flaws.lineNoise.bandingAmplitudeDn);
      json.Member("banding_period", flaws.lineNoise.bandingPeriodRows);
    });
    json.Member("defect_threshold_sd", flaws.defectCorrection.thresholdSd);
    json.Member("temporal_filter_weight", flaws.temporalFilter.weight);
    json.Member("median_radius", flaws.median.radiusPixels);
    json.Member("smoothing_sd", flaws.smoothing.sdPixels);
    json.ObjectMember("binning", [&] {
      json.Member("factor", flaws.binning.factor).Member("interpolation", NameOf(flaws.binning.interpolation));
    });
    json.Member("resampling_shift",
                std::array<double, 2>{ flaws.resampling.shiftXPixels, flaws.resampling.shiftYPixels });
    json.Member("resampling_interpolation", NameOf(flaws.resampling.interpolation));
    json.Member("block_quality", flaws.blocks.quality);
    json.Member("companding_bits", flaws.companding.bits);
    json.Member("repeat_count", flaws.repetition.count).Member("repeat_period", flaws.repetition.period);
  });
}

} // namespace sensornoise
