/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_report_ReportJson_h
#define sensornoise_report_ReportJson_h

#include "sensornoise/report/JsonWriter.h"
#include "sensornoise/report/Report.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** The version of the record and of the module. */
inline constexpr const char * ReportSchema = "itk-sensornoise-report/1";
inline constexpr const char * ModuleVersion = "0.1.0";

/** The JSON name of a status. */
inline const char *
NameOf(EstimateStatus status)
{
  switch (status)
  {
    case EstimateStatus::Identified:
      return "identified";
    case EstimateStatus::NotIdentifiable:
      return "not-identifiable";
    case EstimateStatus::UpperLimit:
      return "upper-limit";
    case EstimateStatus::Failed:
      break;
  }
  return "failed";
}

inline void
WriteJson(JsonWriter & json, const Interval & interval)
{
  json.Write(std::array<std::optional<double>, 2>{ interval.low, interval.high });
}

inline void
WriteJson(JsonWriter & json, const Warning & warning)
{
  json.Object([&] { json.Member("code", warning.code).Member("message", warning.message); });
}

inline void
WriteJson(JsonWriter & json, const Quantity & quantity)
{
  json.Object([&] {
    json.Member("value", quantity.value)
      .Member("standard_error", quantity.standardError)
      .Member("interval95", quantity.interval95)
      .Member("status", NameOf(quantity.status))
      .Member("unit", quantity.unit)
      .Member("bracket", quantity.bracket);
  });
}

/** The record as JSON, schema "itk-sensornoise-report/1": one object, units in each quantity, null for what is unknown.
 */
inline std::string
ToJson(const Report & report)
{
  std::string text;
  JsonWriter  json(text);
  const auto  baseline = [&json](const char * name, const std::optional<Report::Baseline> & fit, bool curved) {
    if (!fit)
    {
      json.Member(name, std::optional<double>());
      return;
    }
    json.ObjectMember(name, [&] {
      if (curved)
      {
        json.Member("curvature", fit->curvature);
      }
      json.Member("gain", fit->gain).Member("intercept", fit->intercept);
    });
  };
  json.Object([&] {
    json.Member("schema", ReportSchema).Member("version", ModuleVersion).Member("method", report.method);
    json.ObjectMember("settings", [&] {
      for (const auto & setting : report.settings)
      {
        json.Member(setting.first.c_str(), setting.second);
      }
    });
    json.Member("frames", report.frames).Member("width", report.width).Member("height", report.height);
    json.Member("channel", report.channel);
    json.Member("bit_depth", report.bitDepth).Member("bit_depth_source", report.bitDepthSource);
    json.Member("quantisation_step", report.quantisationStepDn);
    json.Member("clip_low", report.clipLowDn).Member("clip_high", report.clipHighDn);
    json.Member("clip_source", report.clipSource);
    json.ObjectMember("pixels", [&] {
      json.Member("total", report.pixels.total).Member("valid", report.pixels.valid).Member("used", report.pixels.used);
      json.Member("clipped", report.pixels.clipped).Member("not_finite", report.pixels.notFinite);
    });
    json.Member("gain", report.gain).Member("offset", report.offset).Member("read_noise", report.readNoise);
    json.Member("read_noise_electrons", report.readNoiseElectrons);
    json.Member("intercept", report.intercept).Member("total_intercept", report.totalIntercept);
    json.ObjectMember("covariance", [&] {
      json.Member("of", std::array<const char *, 3>{ "gain", "intercept", "offset" });
      json.Member("matrix", report.covariance);
    });
    json.Member("flicker_sd", report.flickerSd);
    json.ObjectMember("vibration", [&] {
      json.Member("sd_x", report.vibrationSdX).Member("sd_y", report.vibrationSdY);
      json.Member("covariance", report.vibrationCovariance);
    });
    json.Member("flicker", report.flicker);
    json.Member("flicker_rows",
                report.flickerRows.empty() ? std::optional<std::vector<std::vector<double>>>() : report.flickerRows);
    json.Member("motion", report.motion.empty() ? std::optional<std::vector<std::array<double, 2>>>() : report.motion);
    json.ObjectMember("fit", [&] {
      json.Member("reduced_chi2", report.fit.reducedChi2).Member("curvature", report.fit.curvature);
      json.Member("curvature_z", report.fit.curvatureZ).Member("offset_line_phi", report.fit.offsetLinePhi);
    });
    baseline("affine_baseline", report.affineBaseline, false);
    baseline("quadratic_baseline", report.quadraticBaseline, true);
    json.Member("warnings", report.warnings);
    json.ObjectMember("scatter", [&] {
      json.Member("mean", report.scatter.mean).Member("variance", report.scatter.variance);
      json.Member("corrected_variance", report.scatter.correctedVariance).Member("count", report.scatter.count);
    });
  });
  text += '\n';
  return text;
}

} // namespace sensornoise

#endif
