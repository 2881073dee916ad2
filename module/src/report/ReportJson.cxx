// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/ReportParts.h"

#include "report/JsonWriter.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Version.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{
const char *
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

void
WriteJson(JsonWriter & json, const Interval & interval)
{
  json.Write(std::array<std::optional<double>, 2>{ interval.low, interval.high });
}

void
WriteJson(JsonWriter & json, const Warning & warning)
{
  const WarningKind & kind = KindOf(warning.code);
  json.Object([&] {
    json.Member("code", kind.name).Member("severity", NameOf(kind.severity)).Member("message", warning.message);
  });
}

void
WriteJson(JsonWriter & json, const LeftOutFrame & frame)
{
  json.Object([&] { json.Member("frame", frame.frame).Member("reason", NameOf(frame.fault)); });
}

/** Writes a part of the record. JsonWriter::Write() calls these functions by their argument. */
static void
WriteJson(JsonWriter & json, const SingleImageRecord::Line & line)
{
  json.Object([&] {
    json.Member("slope", line.slope).Member("slope_standard_error", line.slopeStandardError);
    json.Member("intercept", line.intercept).Member("intercept_standard_error", line.interceptStandardError);
  });
}

static void
WriteJson(JsonWriter & json, const SingleImageRecord & record)
{
  json.Object([&] {
    json.Member("even_fraction", record.evenFraction).Member("band_excess", record.bandExcess);
    json.Member("band_excess_standard_error", record.bandExcessStandardError);
    json.Member("frames", record.frames).Member("frame_reduced_chi2", record.frameReducedChi2);
    json.Member("mean_image", record.meanImage);
  });
}

void
WriteQuantity(JsonWriter & json, const char * name, const Quantity & quantity, const char * unit)
{
  json.ObjectMember(name, [&] {
    json.Member("value", quantity.value)
      .Member("standard_error", quantity.standardError)
      .Member("interval95", quantity.interval95)
      .Member("status", NameOf(quantity.status))
      .Member("unit", unit)
      .Member("bracket", quantity.bracket);
  });
}

namespace
{
/** Writes the quantities of \a report whose path is \a object and a name. \a object ends with a dot, for example
 * "vibration.", or is "" for the quantities of the record itself. */
void
WriteQuantities(JsonWriter & json, const Report & report, const std::string & object)
{
  for (const QuantityEntry & entry : QuantityList())
  {
    const std::string path = entry.path;
    const std::size_t dot = path.rfind('.') + 1; // where the name begins
    const Quantity *  quantity = entry.of(report);
    if (quantity != nullptr && path.substr(0, dot) == object)
    {
      WriteQuantity(json, entry.path + dot, *quantity, entry.unit);
    }
  }
}
} // namespace

void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Lag & lag)
{
  json.Object([&] {
    if (lag.frames > 0)
    {
      json.Member("lag", lag.frames);
    }
    else
    {
      json.Member("lag", std::array<int, 2>{ lag.x, lag.y });
    }
    json.Member("value", lag.value).Member("standard_error", lag.standardError);
  });
}

void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Line & line)
{
  json.Object([&] {
    json.Member("lag", std::array<int, 2>{ line.x, line.y });
    json.Member("slope", line.slope).Member("slope_standard_error", line.slopeStandardError);
    json.Member("intercept", line.intercept).Member("intercept_standard_error", line.interceptStandardError);
  });
}

void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord::Interference & wave)
{
  json.Object([&] {
    json.Member("cycles_per_column", wave.cyclesPerColumn).Member("cycles_per_row", wave.cyclesPerRow);
    json.Member("rms", wave.rmsDn).Member("rms_standard_error", wave.rmsStandardErrorDn);
  });
}

void
WriteJson(JsonWriter & json, const NoiseCorrelationRecord & correlation)
{
  json.Object([&] {
    json.Member("kind", correlation.kind);
    json.Member("space", correlation.space).Member("time", correlation.time);
    json.Member("covariance_lines", correlation.covarianceLines);
    json.Member("interference", correlation.interference);
    Report report;
    report.noiseCorrelation = correlation;
    WriteQuantities(json, report, "noise_correlation.");
  });
}

void
WriteJson(JsonWriter & json, const GainByPartsRecord::Part & part)
{
  json.Object([&] {
    json.Member("part", part.name).Member("gain", part.gain).Member("standard_error", part.standardError);
    json.Member("pixel_fraction", part.pixelFraction);
  });
}

void
WriteJson(JsonWriter & json, const GainByPartsRecord & record)
{
  json.Object([&] { json.Member("pattern", record.pattern).Member("parts", record.parts); });
}

void
WriteJson(JsonWriter & json, const LinearityRecord::Level & level)
{
  json.Object([&] {
    json.Member("exposure", level.exposure).Member("frames", level.frames).Member("mean_dn", level.meanDn);
    json.Member("deviation_percent", level.deviationPercent);
  });
}

namespace
{
/** Writes the linearity. The member is present without exposures, too, so that programs can read its status. */
void
WriteLinearity(JsonWriter & json, const Report & report)
{
  const LinearityRecord & linearity = report.linearity;
  json.ObjectMember("linearity", [&] {
    json.Member("status", NameOf(linearity.errorPercent.status));
    json.Member("reason", linearity.reason.empty() ? std::nullopt : std::optional<std::string>(linearity.reason));
    WriteQuantities(json, report, "linearity.");
    json.Member("offset_source", linearity.offsetSource).Member("saturation_dn", linearity.saturationDn);
    json.Member("saturation_source", linearity.saturationSource).Member("levels", linearity.levels);
  });
}

/** Writes the identification of the frames, as members of the current object. */
void
WriteFiles(JsonWriter & json, const InputFiles & input)
{
  json.Member("of", input.IsOfPixels() ? "pixels" : "files");
  json.Member("sha256", input.sha256.empty() ? std::nullopt : std::optional<std::string>(input.sha256));
  json.Member("files", input.files).Member("bytes", static_cast<std::size_t>(input.bytes));
}
} // namespace

void
WriteJson(JsonWriter & json, const InputRecord & input)
{
  json.Object([&] {
    WriteFiles(json, input.frames);
    if (input.dark)
    {
      json.ObjectMember("dark", [&] { WriteFiles(json, *input.dark); });
    }
  });
}

namespace
{
/** Writes a polynomial as member \a name; null: it was not fitted. \a isCurved: the polynomial is a parabola. */
void
WriteBaseline(JsonWriter & json, const char * name, const std::optional<Report::Baseline> & fit, bool isCurved)
{
  if (!fit)
  {
    json.Member(name, std::optional<double>());
    return;
  }
  json.ObjectMember(name, [&] {
    if (isCurved)
    {
      json.Member("curvature", fit->curvature);
    }
    json.Member("gain", fit->gain).Member("intercept", fit->intercept);
  });
}

/** Writes the settings of the camera that the file records, if there are any. Settings that are not recorded are null.
 */
void
WriteCamera(JsonWriter & json, const CameraSettings & camera)
{
  if (!camera.IsKnown())
  {
    return;
  }
  const auto text = [](const std::string & said) {
    return said.empty() ? std::nullopt : std::optional<std::string>(said);
  };
  json.ObjectMember("camera", [&] {
    json.Member("name", text(camera.camera)).Member("bayer_pattern", text(camera.bayerPattern));
    json.Member("bit_depth", camera.bitDepth > 0 ? std::optional<unsigned int>(camera.bitDepth) : std::nullopt);
    json.Member("black_level", camera.blackLevelDn).Member("white_level", camera.whiteLevelDn);
    json.Member("masked_level", camera.opticalBlackDn).Member("masked_level_error", camera.opticalBlackErrorDn);
    json.Member("iso_speed", camera.isoSpeed).Member("exposure_seconds", camera.exposureSeconds);
  });
}

/** Writes the properties of the stack and the numbers of its pixels. */
void
WriteStack(JsonWriter & json, const Report & report)
{
  json.Member("frames", report.frames).Member("frames_distinct", report.framesDistinct);
  json.Member("frames_left_out", report.framesLeftOut);
  json.Member("width", report.width).Member("height", report.height);
  json.Member("channel", report.channel);
  WriteCamera(json, report.camera);
  json.Member("bit_depth", report.bitDepth).Member("bit_depth_source", report.bitDepthSource);
  json.Member("quantisation_step", report.quantisationStepDn);
  json.Member("clip_low", report.clipLowDn).Member("clip_high", report.clipHighDn);
  json.Member("clip_source", report.clipSource);
  json.ObjectMember("pixels", [&] {
    json.Member("total", report.pixels.total).Member("valid", report.pixels.valid).Member("used", report.pixels.used);
    json.Member("clipped", report.pixels.clipped).Member("not_finite", report.pixels.notFinite);
  });
}

/** Writes all quantities, and the covariance matrix of the errors of gain, intercept and offset. */
void
WriteAllQuantities(JsonWriter & json, const Report & report)
{
  WriteQuantities(json, report, "");
  json.ObjectMember("vibration", [&] { WriteQuantities(json, report, "vibration."); });
  json.ObjectMember("covariance", [&] {
    json.Member("of", std::array<const char *, 3>{ "gain", "intercept", "offset" });
    json.Member("matrix", report.covariance);
  });
}

/** Writes flicker and motion of every frame. */
void
WriteSeries(JsonWriter & json, const Report & report)
{
  json.Member("flicker", report.flicker);
  json.Member("flicker_rows",
              report.flickerRows.empty() ? std::optional<std::vector<std::vector<double>>>() : report.flickerRows);
  json.Member("motion", report.motion.empty() ? std::optional<std::vector<std::array<double, 2>>>() : report.motion);
}

/** Writes the quality of the fits, and the polynomials through the uncorrected variance for comparison. */
void
WriteFit(JsonWriter & json, const Report & report)
{
  json.ObjectMember("fit", [&] {
    json.Member("reduced_chi2", report.fit.reducedChi2).Member("curvature", report.fit.curvature);
    json.Member("curvature_z", report.fit.curvatureZ).Member("nonlinearity", report.fit.nonlinearity);
    json.Member("offset_line_phi", report.fit.offsetLinePhi);
    WriteBaseline(json, "line", report.fit.line, false);
  });
  WriteBaseline(json, "affine_baseline", report.affineBaseline, false);
  WriteBaseline(json, "quadratic_baseline", report.quadraticBaseline, true);
}
} // namespace

void
WriteJson(JsonWriter & json, const Report & report)
{
  json.Object([&] {
    json.Member("schema", ReportSchema).Member("version", GetModuleVersion()).Member("method", report.method);
    json.ObjectMember("settings", [&] {
      for (const auto & setting : report.settings)
      {
        json.Member(setting.first.c_str(), setting.second);
      }
    });
    if (report.input)
    {
      json.Member("input", *report.input);
    }
    WriteStack(json, report);
    WriteAllQuantities(json, report);
    if (!report.gainByParts.empty())
    {
      json.Member("gain_by_parts", report.gainByParts);
    }
    WriteSeries(json, report);
    json.Member("noise_correlation", report.noiseCorrelation);
    if (report.singleImage)
    {
      json.Member("single_image", *report.singleImage);
    }
    WriteLinearity(json, report);
    WriteFit(json, report);
    json.Member("warnings", report.warnings);
    json.ObjectMember("scatter", [&] {
      json.Member("mean", report.scatter.mean).Member("variance", report.scatter.variance);
      json.Member("corrected_variance", report.scatter.correctedVariance).Member("count", report.scatter.count);
    });
  });
}

std::string
ToJson(const Report & report)
{
  std::string text;
  JsonWriter  json(text);
  json.Write(report);
  text += '\n';
  return text;
}

} // namespace sensornoise
