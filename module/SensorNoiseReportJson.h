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
#ifndef SensorNoiseReportJson_h
#define SensorNoiseReportJson_h

#include "SensorNoiseReport.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>

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

namespace detail
{
/** Appends JSON to a string. Numbers are the shortest that read back as the same double; NaN and infinity, which JSON
 * does not know, are null. */
class JsonWriter
{
public:
  explicit JsonWriter(std::string & text)
    : m_Text(text)
  {}

  void
  Write(double number)
  {
    if (!std::isfinite(number))
    {
      m_Text += "null";
      return;
    }
    char       buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof(buffer), number).ptr;
    m_Text.append(buffer, end);
  }
  void
  Write(std::size_t number)
  {
    m_Text += std::to_string(number);
  }
  void
  Write(int number)
  {
    m_Text += std::to_string(number);
  }
  void
  Write(bool truth)
  {
    m_Text += truth ? "true" : "false";
  }
  void
  Write(const char * string)
  {
    this->Write(std::string(string));
  }
  void
  Write(const std::string & string)
  {
    m_Text += '"';
    for (const char c : string)
    {
      if (c == '"' || c == '\\')
      {
        m_Text += '\\';
        m_Text += c;
      }
      else if (static_cast<unsigned char>(c) < 0x20)
      {
        char buffer[8];
        std::snprintf(buffer, sizeof(buffer), "\\u%04x", static_cast<unsigned int>(c));
        m_Text += buffer;
      }
      else
      {
        m_Text += c;
      }
    }
    m_Text += '"';
  }
  template <typename T>
  void
  Write(const std::optional<T> & optional)
  {
    if (optional)
    {
      this->Write(*optional);
    }
    else
    {
      m_Text += "null";
    }
  }
  void
  Write(const Interval & interval)
  {
    m_Text += '[';
    this->Write(interval.low);
    m_Text += ", ";
    this->Write(interval.high);
    m_Text += ']';
  }
  void
  Write(const Report::SettingValue & value)
  {
    std::visit([this](const auto & held) { this->Write(held); }, value);
  }
  template <typename T, std::size_t VSize>
  void
  Write(const std::array<T, VSize> & values)
  {
    this->WriteList(values);
  }
  template <typename T>
  void
  Write(const std::vector<T> & values)
  {
    this->WriteList(values);
  }
  void
  Write(const Warning & warning)
  {
    this->Object([&] { this->Member("code", warning.code).Member("message", warning.message); });
  }
  void
  Write(const Quantity & quantity)
  {
    this->Object([&] {
      this->Member("value", quantity.value)
        .Member("standard_error", quantity.standardError)
        .Member("interval95", quantity.interval95)
        .Member("status", NameOf(quantity.status))
        .Member("unit", quantity.unit)
        .Member("bracket", quantity.bracket);
    });
  }

  /** Writes {...} around the members that \a members writes. */
  template <typename TMembers>
  void
  Object(TMembers members)
  {
    m_Text += '{';
    m_First = true;
    members();
    m_Text += '}';
    m_First = false;
  }
  template <typename T>
  JsonWriter &
  Member(const char * name, const T & value)
  {
    this->Name(name);
    this->Write(value);
    m_First = false;
    return *this;
  }
  template <typename TMembers>
  JsonWriter &
  ObjectMember(const char * name, TMembers members)
  {
    this->Name(name);
    this->Object(members);
    return *this;
  }

private:
  void
  Name(const char * name)
  {
    m_Text += m_First ? "" : ", ";
    this->Write(name);
    m_Text += ": ";
  }
  template <typename TValues>
  void
  WriteList(const TValues & values)
  {
    m_Text += '[';
    const char * separator = "";
    for (const auto & value : values)
    {
      m_Text += separator;
      this->Write(value);
      separator = ", ";
    }
    m_Text += ']';
  }

  std::string & m_Text;
  bool          m_First{ true };
};
} // namespace detail

/** The record as JSON, schema "itk-sensornoise-report/1": one object, units in each quantity, null for what is unknown.
 */
inline std::string
ToJson(const Report & report)
{
  std::string        text;
  detail::JsonWriter json(text);
  const auto         baseline = [&json](const char * name, const std::optional<Report::Baseline> & fit, bool curved) {
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
