// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "stabilise/NoiseModelCheck.h"

#include "base/Text.h"
#include "report/JsonWriter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

namespace sensornoise
{

namespace
{
using Band = NoiseModelCheck::Band;

std::string
WithDecimals(double number, int decimals)
{
  char buffer[512]; // fits every number
  std::snprintf(buffer, sizeof(buffer), "%.*f", decimals, number);
  return buffer;
}

/** Returns "1.00 +- 0.01". */
std::string
WithError(double number, double error, int decimals)
{
  return WithDecimals(number, decimals) + " +- " + WithDecimals(error, decimals);
}

/** Returns the row of a table, without its end. An empty \a transform is a table without this column. */
std::string
RowOf(const std::string & levels, const std::string & pixels, const std::string & ratio, const std::string & transform)
{
  const std::string text = PaddedRight(levels, 22) + ' ' + PaddedLeft(pixels, 10) + "  ";
  return transform.empty() ? text + ratio : text + PaddedRight(ratio, 17) + ' ' + PaddedLeft(transform, 10);
}

} // namespace

std::string
LevelText(double levelDn)
{
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%.2g", levelDn);
  std::string       text = std::abs(levelDn) < 10.0 ? buffer : WithDecimals(levelDn, 0);
  const std::size_t first = text.find_first_of("0123456789");
  if (text.find_first_not_of("-0123456789") == std::string::npos)
  {
    for (std::size_t place = text.size(); place > first + 3;)
    {
      place -= 3;
      text.insert(place, ",");
    }
  }
  return text;
}

namespace
{
/** Describes adjacent bands as one: "1.00 +- 0.01 from 20 to 3,000 DN". */
std::string
DescribeRange(const Band * begin, const Band * end)
{
  const std::string range = " from " + LevelText(begin->lowDn) + " to " + LevelText((end - 1)->highDn) + " DN";
  double            sum = 0.0;
  double            weights = 0.0;
  for (const Band * band = begin; band != end; ++band)
  {
    if (!band->ratio)
    {
      return "not there in the model" + range;
    }
    const double weight = 1.0 / std::max(1e-12, band->standardError * band->standardError);
    sum += weight * *band->ratio;
    weights += weight;
  }
  const double mean = sum / weights;
  double       squares = 0.0;
  for (const Band * band = begin; band != end; ++band)
  {
    squares += (*band->ratio - mean) * (*band->ratio - mean) / static_cast<double>(end - begin);
  }
  const double error = std::max(0.005, std::sqrt(std::max(squares, 1.0 / weights)));
  return WithError(mean, error, error < 0.095 ? 2 : 1) + range;
}

/** Describes all bands that fit, or all that do not fit. Bands in which the model has no variance are described
 * separately. */
std::string
DescribeBands(const std::vector<Band> & bands, bool fits)
{
  std::string text;
  const auto  kind = [](const Band & band) { return (band.fits ? 2 : 0) + (band.ratio ? 1 : 0); };
  for (std::size_t begin = 0; begin < bands.size();)
  {
    std::size_t end = begin + 1;
    while (end < bands.size() && kind(bands[end]) == kind(bands[begin]))
    {
      ++end;
    }
    if (bands[begin].fits == fits)
    {
      text += (text.empty() ? "" : ", ") + DescribeRange(bands.data() + begin, bands.data() + end);
    }
    begin = end;
  }
  return text;
}

} // namespace

std::string
MakeCheckSentence(const NoiseModelCheck & check, const Report & frames)
{
  if (check.bands.empty())
  {
    const std::string reason = frames.warnings.empty() ? "" : ": " + frames.warnings.front().message;
    return "the variance of these frames could not be measured" + reason;
  }
  const std::string fitting = DescribeBands(check.bands, true);
  const std::string failing = DescribeBands(check.bands, false);
  switch (check.verdict)
  {
    case NoiseModelCheck::Verdict::Fits:
      return "variance " + fitting + ": this model can be used";
    case NoiseModelCheck::Verdict::NotDetermined:
      return "variance " + fitting + ": too few frames or pixels to test whether this model can be used";
    default:
      return fitting.empty() ? "variance " + failing + ": this is not the model of these frames"
                             : "variance " + fitting + ", but " + failing + ": this model does not fit there";
  }
}

const char *
NameOf(NoiseModelCheck::Verdict verdict)
{
  return verdict == NoiseModelCheck::Verdict::Fits         ? "fits"
         : verdict == NoiseModelCheck::Verdict::DoesNotFit ? "does-not-fit"
                                                           : "not-told";
}

void
WriteJson(JsonWriter & json, const NoiseModelCheck::Band & band)
{
  json.Object([&] {
    json.Member("low", band.lowDn)
      .Member("high", band.highDn)
      .Member("pixels", band.pixels)
      .Member("variance", band.ratio)
      .Member("standard_error", band.standardError)
      .Member("transform_variance", band.transformVariance)
      .Member("fits", band.fits);
  });
}

std::string
ToJson(const NoiseModelCheck & check)
{
  std::string text;
  JsonWriter  json(text);
  json.Object([&] {
    json.Member("schema", "itk-sensornoise-check/1")
      .Member("verdict", NameOf(check.verdict))
      .Member("sentence", check.sentence)
      .Member("bands", check.bands);
  });
  return text + "\n";
}

std::string
MakeTable(const NoiseModelCheck & check)
{
  const bool hasTransform = std::any_of(
    check.bands.begin(), check.bands.end(), [](const auto & band) { return band.transformVariance.has_value(); });
  std::string text = RowOf("level [DN]", "pixels", "variance/model", hasTransform ? "transform" : "") + '\n';
  for (const NoiseModelCheck::Band & band : check.bands)
  {
    const std::string levels = LevelText(band.lowDn) + " to " + LevelText(band.highDn);
    const std::string ratio = band.ratio ? WithError(*band.ratio, band.standardError, 3) : "no variance";
    const std::string transform = band.transformVariance ? WithDecimals(*band.transformVariance, 3)
                                  : hasTransform         ? "-"
                                                         : "";
    text +=
      RowOf(levels, std::to_string(band.pixels), WithSigns(ratio), transform) + (band.fits ? "\n" : "  does not fit\n");
  }
  return text + WithSigns(check.sentence) + "\n";
}

} // namespace sensornoise
