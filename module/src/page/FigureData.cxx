// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Figures.h"

#include "base/ChiSquare.h"
#include "page/PageSections.h"
#include "report/JsonWriter.h"
#include "report/ReportParts.h"
#include "sensornoise/ReportPage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

PanelPlace::PanelPlace(const PlotAxis & across, std::initializer_list<PlotAxis> up)
{
  for (const PlotAxis & axis : up)
  {
    left = std::max(left, axis.LabelWidth() + 10.0);
  }
  width = FigureWidth - left - std::max(12.0, 0.5 * across.LabelWidth() + 2.0);
}

double
LegendEntry(std::string & svg, double x, double y, const std::string & sign, const std::string & words)
{
  svg += "<g transform=\"translate(" + SvgNumber(x) + " " + SvgNumber(y) + ")\">" + sign + "<text x=\"26\" y=\"5\">" +
         Escaped(words) + "</text></g>\n";
  return x + 44.0 + 7.2 * static_cast<double>(words.size());
}

std::string
LineSign(const char * style)
{
  return "<path class=\"" + std::string(style) + " line\" d=\"M0 0H20\"/>";
}

std::string
PointSign(const char * style)
{
  return "<path class=\"" + std::string(style) + "\" d=\"M7 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0\"/>";
}

namespace
{
/** Standard errors of half a two-sided 95 % interval of a normal distribution. */
constexpr double TwoSided95 = 1.959963984540054;
constexpr int    LinePieces = 32;

double
ElementOrNaN(const std::vector<double> & values, std::size_t i)
{
  return i < values.size() ? values[i] : std::numeric_limits<double>::quiet_NaN();
}

/** Returns the line of the report: variance slope and total intercept if both have values, else the indicative line of
 * the fit. None if there is no line, or if it is not finite. */
std::optional<Report::Baseline>
LineOf(const Report & report)
{
  std::optional<Report::Baseline> line = report.fit.line;
  if (report.varianceSlope.value && report.totalIntercept.value)
  {
    line = Report::Baseline{ 0.0, *report.varianceSlope.value, *report.totalIntercept.value };
  }
  return line && std::isfinite(line->gain) && std::isfinite(line->intercept) ? line : std::nullopt;
}

/** Returns the variance inflation of a sample variance of correlated values [1]: 1 + 2 sum rho^2, over one of the two
 * directions of each lag. The expected contribution of the errors is subtracted from each square. */
double
FactorOfLags(const std::vector<NoiseCorrelationRecord::Lag> & lags)
{
  double sum = 0.0;
  for (const NoiseCorrelationRecord::Lag & lag : lags)
  {
    const double square = lag.value * lag.value - lag.standardError * lag.standardError;
    sum += std::isfinite(square) ? std::max(square, 0.0) : 0.0;
  }
  return 1.0 + 2.0 * sum;
}

/** Returns the relative standard error of a variance that is the mean over \a count pixels [1]. Var(s^2) / sigma^4 of a
 * pixel with T frames has two parts: 2 / (T - 1) times the variance inflation of the temporal correlation, and the
 * excess kurtosis over T. NaN for fewer than two frames or no pixels. */
double
RelativeErrorOfBin(const Report & report, std::size_t count)
{
  if (report.framesDistinct < 2 || count == 0)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto   frames = static_cast<double>(report.framesDistinct);
  const double kurtosis = report.noiseCorrelation ? report.noiseCorrelation->excessKurtosis.value.value_or(0.0) : 0.0;
  const double shared = report.noiseCorrelation ? FactorOfLags(report.noiseCorrelation->time) : 1.0;
  const double ofPixel = std::max(2.0 / (frames - 1.0) * shared + kurtosis / frames, 0.0);
  return std::sqrt(ofPixel / static_cast<double>(count));
}

/** Returns the relative standard error of the variance of a level set of \a count detail coefficients [1]; NaN for
 * none. The coefficients of one image replace the frames of a burst. */
double
RelativeErrorOfLevelSet(std::size_t count)
{
  return count == 0 ? std::numeric_limits<double>::quiet_NaN()
                    : std::sqrt(TruncatedVariance / static_cast<double>(count));
}

/** Returns the error of the mean of a bin [DN], caused by the noise of the pixel means that decide on the bin. It is
 * the standard error of the mean of one pixel, times the dark fraction of the variance. Photon noise is skewed: it
 * moves mean and variance of a pixel together along the line, and adds no residual. \a expected: variance of the line
 * at the mean [DN^2]. \a dark: DarkVariance() [DN^2]. */
double
ErrorOfLevel(const Report & report, double expected, double dark)
{
  return std::sqrt(expected / static_cast<double>(report.framesDistinct)) * std::clamp(dark / expected, 0.0, 1.0);
}

/** Returns the variance of the line at the dark offset, or at the darkest level if the offset is not known [DN^2]. */
double
DarkVariance(const Report & report, const Report::Baseline & line)
{
  double level = report.offset.value.value_or(std::numeric_limits<double>::infinity());
  for (const double mean : report.scatter.mean)
  {
    level = report.offset.value || !std::isfinite(mean) ? level : std::min(level, mean);
  }
  return line.gain * level + line.intercept;
}

void
AddCurve(FigureData & data, const Report & report)
{
  const Report::Scatter & scatter = report.scatter;
  const auto              line = LineOf(report);
  const double            dark = line ? DarkVariance(report, *line) : 0.0;
  for (std::size_t i = 0; i < scatter.mean.size(); ++i)
  {
    const double mean = scatter.mean[i];
    const double corrected = ElementOrNaN(scatter.correctedVariance, i);
    if (!std::isfinite(mean) || !std::isfinite(corrected))
    {
      continue;
    }
    data.mean.push_back(mean);
    data.variance.push_back(ElementOrNaN(scatter.variance, i));
    data.corrected.push_back(corrected);
    if (!line || i >= scatter.count.size())
    {
      continue;
    }
    const double expected = line->gain * mean + line->intercept;
    const double relative =
      data.isOfLevelSets ? RelativeErrorOfLevelSet(scatter.count[i]) : RelativeErrorOfBin(report, scatter.count[i]);
    const double ofVariance = std::abs(expected) * relative;
    // The details of white noise are uncorrelated with the approximation, which decides on the level set.
    const double ofLevel = data.isOfLevelSets ? 0.0 : ErrorOfLevel(report, std::abs(expected), dark);
    const double error = std::hypot(ofVariance, line->gain * ofLevel);
    if (ofVariance > 0.0 && std::isfinite(error))
    {
      data.meanResiduals.push_back(mean);
      data.residuals.push_back((corrected - expected) / error);
    }
  }
}

/** Returns half the width of the 95 % interval of the line at a level [DN^2]; none if an error is not known. The
 * correlation of the errors of gain and intercept serves for variance slope and total intercept. */
std::optional<double>
HalfWidthAt(const Report & report, double mean)
{
  const std::optional<double> slopeError = report.varianceSlope.standardError;
  const std::optional<double> interceptError = report.totalIntercept.standardError;
  if (!report.covariance || !slopeError || !interceptError)
  {
    return std::nullopt;
  }
  const auto & matrix = *report.covariance;
  const double correlation = matrix[0][1] / std::sqrt(matrix[0][0] * matrix[1][1]);
  const double ofSlope = mean * *slopeError;
  const double variance =
    ofSlope * ofSlope + *interceptError * *interceptError + 2.0 * correlation * ofSlope * *interceptError;
  return std::isfinite(variance) ? std::optional<double>(TwoSided95 * std::sqrt(std::max(variance, 0.0)))
                                 : std::nullopt;
}

void
AddLine(FigureData & data, const Report & report)
{
  const auto line = LineOf(report);
  if (!line || data.mean.empty())
  {
    return;
  }
  data.isIndicative = !report.gain.value;
  const auto [darkest, brightest] = std::minmax_element(data.mean.begin(), data.mean.end());
  for (int i = 0; i <= LinePieces; ++i)
  {
    const double mean = *darkest + (*brightest - *darkest) * i / LinePieces;
    const double variance = line->gain * mean + line->intercept;
    data.lineMean.push_back(mean);
    data.lineVariance.push_back(variance);
    const std::optional<double> half = data.isIndicative ? std::nullopt : HalfWidthAt(report, mean);
    if (half)
    {
      data.bandLow.push_back(variance - *half);
      data.bandHigh.push_back(variance + *half);
    }
  }
}
} // namespace

FigureData
MakeFigureData(const Report & report)
{
  FigureData data;
  data.isOfLevelSets = report.singleImage.has_value();
  AddCurve(data, report);
  AddLine(data, report);
  data.flicker = report.flicker;
  for (const auto & shift : report.motion)
  {
    data.motionX.push_back(shift[0]);
    data.motionY.push_back(shift[1]);
  }
  if (report.noiseCorrelation)
  {
    data.residualSpread = std::sqrt(FactorOfLags(report.noiseCorrelation->space));
    data.lags = report.noiseCorrelation->space;
    data.lags.insert(data.lags.end(), report.noiseCorrelation->time.begin(), report.noiseCorrelation->time.end());
  }
  return data;
}

/** Writes the numbers as a JSON object. JsonWriter finds this overload. */
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
