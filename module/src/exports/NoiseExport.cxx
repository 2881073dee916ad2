// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/NoiseExport.h"

#include "base/Text.h"
#include "exports/NoiseProfile.h"
#include "exports/ExportFormats.h"
#include "report/JsonWriter.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** A format that takes one setting of the camera. */
template <NoiseExport (*VExport)(const CameraNoise &)>
NoiseExport
OfOneSetting(const std::vector<CameraNoise> & settings)
{
  return VExport(settings.front());
}

constexpr std::array<ExportFormat, 18> Formats{ {
  { "dng",
    "DNG files: Lightroom, Camera Raw, and others",
    ExportTakes::Line,
    ExportExactness::Exact,
    "tag 51041 NoiseProfile: scale and offset, of a mosaic for R, G and B",
    true,
    1,
    false,
    OfOneSetting<ExportDng> },
  { "ndsafir",
    "ndsafir, denoiser of microscope images",
    ExportTakes::Line,
    ExportExactness::Exact,
    "JSON: gains, offsets of all channels",
    true,
    1,
    false,
    OfOneSetting<ExportNdsafir> },
  { "anscombe-transform",
    "Python package anscombe-transform",
    ExportTakes::Line,
    ExportExactness::Rounded,
    "JSON: conversion_gain, zero_level (a whole number)",
    true,
    1,
    false,
    OfOneSetting<ExportAnscombeTransform> },
  { "deepinv",
    "deepinv's PoissonGaussianNoise",
    ExportTakes::Line,
    ExportExactness::Exact,
    "JSON: gain, sigma, for levels from 0 to 1",
    true,
    1,
    false,
    OfOneSetting<ExportDeepinv> },
  { "careamics",
    "CAREamics' GaussianMixtureNoiseModel",
    ExportTakes::Line,
    ExportExactness::Exact,
    "npz: trained_weight, min_signal, max_signal, min_sigma",
    false,
    1,
    false,
    OfOneSetting<ExportCareamics> },
  { "pyme",
    "PYME (python-microscopy)",
    ExportTakes::Sensor,
    ExportExactness::Exact,
    "YAML: ADOffset [ADU], ElectronsPerCount, ReadNoise [e-], SaturationThreshold [ADU]",
    true,
    1,
    false,
    OfOneSetting<ExportPyme> },
  { "picasso",
    "picasso (Python package picassosr)",
    ExportTakes::Sensor,
    ExportExactness::Exact,
    "YAML: Baseline [ADU], Sensitivity [e-/ADU]",
    true,
    1,
    false,
    OfOneSetting<ExportPicasso> },
  { "smap",
    "SMAP",
    ExportTakes::Sensor,
    ExportExactness::Exact,
    "JSON: offset [ADU], conversion [e-/ADU], emgain",
    true,
    1,
    false,
    OfOneSetting<ExportSmap> },
  { "decode",
    "DECODE",
    ExportTakes::Sensor,
    ExportExactness::Exact,
    "YAML: baseline [ADU], e_per_adu, read_sigma [e-]",
    true,
    1,
    false,
    OfOneSetting<ExportDecode> },
  { "thunderstorm",
    "ThunderSTORM",
    ExportTakes::Sensor,
    ExportExactness::Exact,
    "ImageJ macro: offset [ADU], photons2adu [e-/ADU]",
    true,
    1,
    false,
    OfOneSetting<ExportThunderstorm> },
  { "fits",
    "FITS headers",
    ExportTakes::Sensor,
    ExportExactness::Exact,
    "cards EGAIN [e-/ADU], RDNOISE [e-]",
    true,
    1,
    false,
    OfOneSetting<ExportFits> },
  { "ccdproc",
    "ccdproc",
    ExportTakes::Sensor,
    ExportExactness::Exact,
    "JSON: gain, readnoise, offset, each with its unit",
    true,
    1,
    false,
    OfOneSetting<ExportCcdproc> },
  { "lsst",
    "LSST's PhotonTransferCurveDataset",
    ExportTakes::Sensor,
    ExportExactness::Exact,
    "JSON: gain [e-/ADU], noise [e-] of each channel, with errors",
    true,
    1,
    false,
    OfOneSetting<ExportLsst> },
  { "emva1288",
    "Python package emva1288",
    ExportTakes::Sensor,
    ExportExactness::Exact,
    "XML: K [DN/e-], inverse_K [e-/DN], sigma_d [e-]",
    true,
    1,
    false,
    OfOneSetting<ExportEmva1288> },
  { "libcamera",
    "libcamera on Raspberry Pi",
    ExportTakes::Line,
    ExportExactness::Fitted,
    "JSON: rpi.noise with reference_constant, reference_slope",
    true,
    1,
    false,
    OfOneSetting<ExportLibcamera> },
  { "android",
    "Android's sensor noise model",
    ExportTakes::Line,
    ExportExactness::Fitted,
    "JSON: noise_model_A to noise_model_D of each channel",
    true,
    2,
    true,
    ExportAndroid },
  { "darktable",
    "darktable's denoising (profiled)",
    ExportTakes::Line,
    ExportExactness::Calibrated,
    "JSON: noiseprofiles with a and b of each ISO speed",
    true,
    1,
    true,
    ExportDarktable },
  { "maps",
    "PYME, SMAP, navigate: correction of each pixel",
    ExportTakes::Maps,
    ExportExactness::Exact,
    "TIFF: offset [DN], variance [DN^2] or [e-^2]; MAT: both and the gain [e-/DN]",
    false,
    1,
    false,
    OfOneSetting<ExportMaps> },
} };

std::string
NamesOfFormats()
{
  std::string names;
  for (const ExportFormat & format : ExportFormats())
  {
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  return names;
}

/** Throws ExportError for the record of a sensor that multiplies electrons: it has no member for the excess noise,
 * which programs take only with a multiplication, and the frames do not determine the multiplication. */
void
RequireNoExcessNoise(const CameraNoise & noise, const std::string & format)
{
  if (!(noise.excessNoiseFactor > 1.0))
  {
    return;
  }
  const ChannelNoise & channel = noise.channels.front();
  const std::string    offset = channel.offset.value ? "the offset " + Text(*channel.offset.value) + " DN and " : "";
  const std::string    gain = channel.gain.value ? Text(1.0 / *channel.gain.value) + " e-/DN" : "its gain";
  const std::string    factor = Text(noise.excessNoiseFactor);
  throw ExportError("the report " + noise.name + " has an excess noise factor of " + factor + ", and " + format +
                    " has no member for it: its program would take a shot noise variance that is " + factor +
                    " times too low. Choose a format of the variance line, as ndsafir or careamics, or set the "
                    "multiplication of electrons in the program itself, with " +
                    offset + gain + " for each photoelectron.");
}
} // namespace

const std::vector<ExportFormat> &
ExportFormats()
{
  static const std::vector<ExportFormat> formats(Formats.begin(), Formats.end());
  return formats;
}

const char *
NameOf(ExportTakes takes)
{
  return takes == ExportTakes::Line ? "line" : takes == ExportTakes::Sensor ? "sensor" : "maps";
}

const char *
NameOf(ExportExactness exactness)
{
  return exactness == ExportExactness::Exact     ? "exact"
         : exactness == ExportExactness::Rounded ? "rounded"
         : exactness == ExportExactness::Fitted  ? "fitted"
                                                 : "calibrated";
}

static void
WriteJson(JsonWriter & json, const ExportFormat & format)
{
  json.Object([&] {
    json.Member("name", format.name).Member("consumer", format.consumer);
    json.Member("takes", NameOf(format.takes)).Member("exactness", NameOf(format.exactness));
    json.Member("fields", format.fields).Member("is_text", format.isText);
    json.Member("least_reports", format.leastReports).Member("takes_several", format.takesSeveral);
  });
}

std::string
ExportFormatsAsJson()
{
  std::string text;
  JsonWriter(text).Write(ExportFormats());
  return text + '\n';
}

NoiseExport
ExportNoise(const std::string & format, const std::vector<CameraNoise> & settings)
{
  const auto & formats = ExportFormats();
  const auto   found =
    std::find_if(formats.begin(), formats.end(), [&](const ExportFormat & each) { return format == each.name; });
  if (found == formats.end())
  {
    throw ExportUseError("the format is \"" + format + "\"; expected one of " + NamesOfFormats());
  }
  const std::size_t least = found->leastReports;
  const std::string given =
    (settings.size() == 1 ? "1 report was given; " : std::to_string(settings.size()) + " reports were given; ") +
    format + " takes ";
  if (!found->takesSeveral && settings.size() > least)
  {
    throw ExportUseError(given + "one. Leave out the reports of other settings.");
  }
  if (settings.size() < least)
  {
    throw ExportError(given + (!found->takesSeveral
                                 ? "one. Give the report of a setting."
                                 : std::to_string(least) +
                                     " or more, each of a different ISO speed. Measure bursts at more ISO "
                                     "speeds, as estimate-sensor-noise --sweep does."));
  }
  if (found->takes == ExportTakes::Sensor)
  {
    RequireNoExcessNoise(settings.front(), format);
  }
  return found->write(settings);
}

} // namespace sensornoise
