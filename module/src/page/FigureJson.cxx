// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportPage.h"

#include "page/FigureData.h"
#include "report/JsonWriter.h"
#include "report/ReportJson.h"

#include <string>

namespace sensornoise
{

/** Found by JsonWriter. */
void
WriteJson(JsonWriter & json, const FigureData & data)
{
  json.Object([&] {
    json.Member("mean", data.mean).Member("variance", data.variance).Member("corrected_variance", data.corrected);
    json.Member("residual_mean", data.meanResiduals).Member("residual", data.residuals);
    json.Member("residual_spread", data.residualSpread);
    json.Member("line_mean", data.lineMean).Member("line_variance", data.lineVariance);
    json.Member("band_low", data.bandLow).Member("band_high", data.bandHigh);
    json.Member("is_indicative", data.isIndicative);
    json.Member("flicker", data.flicker).Member("motion_x", data.motionX).Member("motion_y", data.motionY);
    json.Member("lags", data.lags);
  });
}

std::string
FigureAsJson(const Report & report)
{
  std::string text;
  JsonWriter(text).Write(MakeFigureData(report));
  return text + '\n';
}

std::string
FigureAsJson(const ChannelReports & reports)
{
  std::string text;
  JsonWriter  json(text);
  json.Object([&] {
    for (const Report & report : reports.channels)
    {
      json.Member(report.channel.c_str(), MakeFigureData(report));
    }
  });
  return text + '\n';
}

} // namespace sensornoise
