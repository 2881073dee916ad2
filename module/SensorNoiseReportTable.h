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
#ifndef SensorNoiseReportTable_h
#define SensorNoiseReportTable_h

#include "SensorNoiseReportJson.h"

#include <cstdio>
#include <optional>
#include <string>
#include <utility>

namespace sensornoise
{
namespace reporttable
{
template <typename... TArguments>
std::string
Format(const char * format, TArguments... arguments)
{
  char buffer[256];
  std::snprintf(buffer, sizeof(buffer), format, arguments...);
  return buffer;
}

inline std::string
Number(const std::optional<double> & number)
{
  return number ? Format("%.5g", *number) : "-";
}

/** The interval if there is one, else the bracket. */
inline std::string
Range(const Quantity & quantity)
{
  const std::optional<Interval> & range = quantity.interval95 ? quantity.interval95 : quantity.bracket;
  return range ? "[" + Number(range->low) + ", " + Number(range->high) + "]" : "";
}

inline std::string
Line(const char * name, const Quantity & quantity)
{
  return Format("%-24s %12s  %-8s %-17s %s\n",
                name,
                Number(quantity.value).c_str(),
                quantity.unit.c_str(),
                NameOf(quantity.status),
                Range(quantity).c_str());
}

inline std::string
DescribeCodes(const Report & report)
{
  std::string text;
  if (report.bitDepth)
  {
    text += Format(", %d bits (%s)", *report.bitDepth, report.bitDepthSource.c_str());
  }
  if (report.quantisationStepDn)
  {
    text += Format(", code step %g DN", *report.quantisationStepDn);
  }
  if (report.clipLowDn || report.clipHighDn)
  {
    text +=
      ", levels " + Number(report.clipLowDn) + " to " + Number(report.clipHighDn) + " DN (" + report.clipSource + ")";
  }
  return text;
}
} // namespace reporttable

/** The report as a table that a person can read: what was found, one line a quantity, no warnings. */
inline std::string
MakeTable(const Report & report)
{
  using reporttable::Format;
  std::string table = Format("%zu frames of %zu x %zu pixels", report.frames, report.width, report.height);
  table += reporttable::DescribeCodes(report) + "\n";
  table += Format("%zu of %zu pixels used (%.1f %%), %zu clipped, %zu not finite\n",
                  report.pixels.used,
                  report.pixels.total,
                  100.0 * static_cast<double>(report.pixels.used) / static_cast<double>(report.pixels.total),
                  report.pixels.clipped,
                  report.pixels.notFinite);
  table += "method: " + report.method + "\n\n";
  table += Format("%-24s %12s  %-8s %-17s %s\n", "quantity", "value", "unit", "status", "limits");
  for (const auto & [name, quantity] : { std::pair("gain g", &report.gain),
                                         std::pair("offset mu", &report.offset),
                                         std::pair("read noise sigma", &report.readNoise),
                                         std::pair("read noise sigma / g", &report.readNoiseElectrons),
                                         std::pair("intercept sigma^2 - g mu", &report.intercept),
                                         std::pair("flicker sd", &report.flickerSd),
                                         std::pair("vibration sd x", &report.vibrationSdX),
                                         std::pair("vibration sd y", &report.vibrationSdY) })
  {
    table += reporttable::Line(name, *quantity);
  }
  if (report.fit.reducedChi2)
  {
    table += Format("\nfit: reduced chi2 %.4g (1: only sampling noise is left)", *report.fit.reducedChi2);
    table += Format(", offset line %.4g (1: one flicker for all)\n", report.fit.offsetLinePhi.value_or(0.0));
  }
  return table;
}

/** The table and, a line each, what the user should know: for those who see nothing else. */
inline std::string
MakeText(const Report & report)
{
  std::string text = MakeTable(report);
  for (const Warning & warning : report.warnings)
  {
    text += (&warning == &report.warnings.front() ? "\nwarning: " : "warning: ") + warning.message + " [" +
            warning.code + "]\n";
  }
  return text;
}

} // namespace sensornoise

#endif
