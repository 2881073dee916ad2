// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"
#include "exports/NoiseProfile.h"

#include "base/Text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** Most amplifiers of a record. Chosen: a detector of LSST has 16. */
constexpr std::size_t mostAmplifiers = 256;

NoiseProfile
OneChannel(ProfileForm form, double scale, std::optional<double> constant, std::optional<double> offsetDn = {})
{
  NoiseProfile profile;
  profile.form = form;
  profile.channels.push_back({ "mono", scale, constant, offsetDn });
  return profile;
}

/** The channel of a mosaic by the name that other programs give it. */
std::string
ChannelName(const std::string & name)
{
  return name == "Gr" ? "G1" : name == "Gb" ? "G2" : name;
}

void
RequireNoMultiplication(const ProfileValues & values, const std::string & member)
{
  const double factor = values.Find(member).value_or(1.0);
  if (factor != 1.0)
  {
    throw ExportError("the profile " + values.File() + " has " + member + " = " + Text(factor) +
                      ": its camera multiplies electrons, whose excess noise the file does not hold. Expected a "
                      "profile without multiplication.");
  }
}

void
RequireAsMany(const ProfileValues & values, const std::string & list, std::size_t found, std::size_t expected)
{
  if (found != expected || expected == 0)
  {
    throw ExportError("the profile " + values.File() + " has " + std::to_string(found) + " numbers in " + list +
                      "; expected " + std::to_string(std::max<std::size_t>(expected, 1)) + ", one for each channel");
  }
}

NoiseProfile
ReadReport(const ProfileValues & values)
{
  const CameraNoise noise = ReadCameraNoise(values.Record());
  NoiseProfile      profile;
  for (const ChannelNoise & channel : noise.channels)
  {
    const NoiseModel model = ModelOf(noise, channel);
    profile.channels.push_back({ channel.channel, model.varianceSlopeDn, model.totalInterceptDn2, {} });
  }
  return profile;
}

NoiseProfile
ReadLibcamera(const ProfileValues & values)
{
  return OneChannel(ProfileForm::Root, values.Positive("reference_slope"), values.NotNegative("reference_constant"));
}

NoiseProfile
ReadAndroid(const ProfileValues & values)
{
  NoiseProfile profile;
  profile.form = ProfileForm::Normalised;
  AndroidProfile & android = profile.android.emplace();
  android.a = values.List("noise_model_A");
  android.b = values.List("noise_model_B");
  android.c = values.List("noise_model_C");
  android.d = values.List("noise_model_D");
  for (const std::string & name : values.Texts("channels"))
  {
    android.channels.push_back(ChannelName(name));
  }
  if (android.channels.empty())
  {
    android.channels =
      android.a.size() == 4 ? std::vector<std::string>{ "R", "G1", "G2", "B" } : std::vector<std::string>{ "mono" };
  }
  for (const auto & each : { &android.a, &android.b, &android.c, &android.d })
  {
    RequireAsMany(values, "noise_model_A to noise_model_D", each->size(), android.channels.size());
  }
  android.maxAnalogueIso = values.Find("max_analog_iso");
  return profile;
}

NoiseProfile
ReadNdsafir(const ProfileValues & values)
{
  const auto   gains = values.List("gains");
  const auto   offsets = values.List("offsets");
  auto         names = values.Texts("channels");
  NoiseProfile profile;
  names.resize(std::max(names.size(), gains.size() == 1 ? std::size_t(1) : names.size()), "mono");
  RequireAsMany(values, "gains", gains.size(), names.size());
  RequireAsMany(values, "offsets", offsets.size(), names.size());
  for (std::size_t i = 0; i < gains.size(); ++i)
  {
    if (!(gains[i] > 0.0))
    {
      throw ExportError("the profile " + values.File() + " has a gain of " + Text(gains[i]) +
                        "; expected a number above 0");
    }
    profile.channels.push_back({ ChannelName(names[i]), gains[i], offsets[i], {} });
  }
  return profile;
}

NoiseProfile
ReadAnscombeTransform(const ProfileValues & values)
{
  const double gain = values.Positive("conversion_gain");
  NoiseProfile profile = OneChannel(ProfileForm::Line, gain, -gain * values.Number("zero_level"));
  profile.roundingDn2 = 0.5 * gain;
  return profile;
}

NoiseProfile
ReadDeepinv(const ProfileValues & values)
{
  const double sigma = values.NotNegative("sigma");
  NoiseProfile profile = OneChannel(ProfileForm::Normalised, values.Positive("gain"), sigma * sigma);
  profile.blackLevelDn = values.Find("black_level");
  profile.whiteLevelDn = values.Find("white_level");
  return profile;
}

NoiseProfile
ReadSmap(const ProfileValues & values)
{
  RequireNoMultiplication(values, "emgain");
  return OneChannel(ProfileForm::Sensor, values.Positive("conversion"), {}, values.Number("offset"));
}

/** Throws ExportError if a quantity of astropy has another unit. A quantity without a unit has the expected one. */
void
RequireUnit(const ProfileValues & values, const std::string & quantity, const std::string & unit)
{
  const auto packed = [](std::string text) {
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    return text;
  };
  for (const auto & [pointer, text] : values.Record().texts)
  {
    const std::string end = "/" + quantity + "/unit";
    const bool        isUnit =
      pointer.size() >= end.size() && pointer.compare(pointer.size() - end.size(), end.size(), end) == 0;
    if (isUnit && packed(text) != packed(unit))
    {
      throw ExportError("the profile " + values.File() + " has " + quantity + " in \"" + text + "\"; expected \"" +
                        unit + "\", as ccdproc takes it. Convert the number and its unit.");
    }
  }
}

NoiseProfile
ReadCcdproc(const ProfileValues & values)
{
  RequireUnit(values, "gain", "electron / adu");
  RequireUnit(values, "readnoise", "electron");
  RequireUnit(values, "offset", "adu");
  return OneChannel(ProfileForm::Sensor,
                    values.Positive("gain/value"),
                    values.NotNegative("readnoise/value"),
                    values.Find("offset/value"));
}

NoiseProfile
ReadLsst(const ProfileValues & values)
{
  NoiseProfile profile;
  profile.form = ProfileForm::Sensor;
  const std::vector<std::string> names = values.Texts("ampNames");
  if (names.size() > mostAmplifiers)
  {
    throw ExportError("the record has " + std::to_string(names.size()) + " amplifiers; expected at most " +
                      std::to_string(mostAmplifiers));
  }
  for (const std::string & name : names)
  {
    profile.channels.push_back({ name, values.Positive("gain/" + name), values.NotNegative("noise/" + name), {} });
  }
  RequireAsMany(values, "ampNames", profile.channels.size(), std::max<std::size_t>(profile.channels.size(), 1));
  return profile;
}

NoiseProfile
ReadPyme(const ProfileValues & values)
{
  return OneChannel(ProfileForm::Sensor,
                    values.Positive("ElectronsPerCount"),
                    values.NotNegative("ReadNoise"),
                    values.Number("ADOffset"));
}

/** Returns the path of picasso's Sensitivity: a number, or mappings of the modes of the camera, which end in one
 * number. Throws ExportError if there are several modes. */
std::string
SensitivityMember(const ProfileValues & values)
{
  const std::string        name = "Sensitivity";
  std::vector<std::string> modes;
  for (const auto & [pointer, number] : values.Record().numbers)
  {
    const std::size_t at = pointer.find("/" + name + "/");
    if (at != std::string::npos)
    {
      modes.push_back(pointer.substr(at + 1));
    }
  }
  if (modes.size() > 1)
  {
    throw ExportError("the profile " + values.File() + " has " + std::to_string(modes.size()) + " modes in " + name +
                      ", as " + modes.front() + " and " + modes.back() +
                      "; expected one. Leave only the mode of these frames in a copy of the file.");
  }
  return modes.empty() ? name : modes.front();
}

NoiseProfile
ReadPicasso(const ProfileValues & values)
{
  RequireNoMultiplication(values, "Gain");
  return OneChannel(ProfileForm::Sensor, values.Positive(SensitivityMember(values)), {}, values.Number("Baseline"));
}

NoiseProfile
ReadDecode(const ProfileValues & values)
{
  RequireNoMultiplication(values, "em_gain");
  return OneChannel(
    ProfileForm::Sensor, values.Positive("e_per_adu"), values.NotNegative("read_sigma"), values.Number("baseline"));
}

/** The members by which a record of each format is known. */
struct RecordFormat
{
  const char * name{ nullptr };
  const char * member{ nullptr };
  const char * otherMember{ nullptr }; ///< second member that is needed; null: none
  NoiseProfile (*read)(const ProfileValues &){ nullptr };
};

constexpr std::array<RecordFormat, 12> Records{ {
  { "libcamera", "reference_slope", "reference_constant", ReadLibcamera },
  { "android", "noise_model_A", "noise_model_C", ReadAndroid },
  { "darktable", "noiseprofiles", "version", ReadDarktablePresets },
  { "ndsafir", "gains", "offsets", ReadNdsafir },
  { "anscombe-transform", "conversion_gain", "zero_level", ReadAnscombeTransform },
  { "lsst", "ampNames", "noise", ReadLsst },
  { "ccdproc", "gain/value", "readnoise/value", ReadCcdproc },
  { "deepinv", "gain", "sigma", ReadDeepinv },
  { "smap", "conversion", "offset", ReadSmap },
  { "pyme", "ElectronsPerCount", "ADOffset", ReadPyme },
  { "picasso", "Sensitivity", "Baseline", ReadPicasso },
  { "decode", "e_per_adu", "baseline", ReadDecode },
} };
} // namespace

NoiseProfile
ReadNoiseProfile(const StoredReport & values)
{
  const ProfileValues members(values);
  NoiseProfile        profile;
  const auto          schema = values.texts.find("/schema");
  const bool          isReport = schema != values.texts.end() && schema->second.rfind("itk-sensornoise", 0) == 0;
  const auto          found = std::find_if(Records.begin(), Records.end(), [&](const RecordFormat & each) {
    return members.Has(each.member) && members.Has(each.otherMember);
  });
  if (!isReport && found == Records.end())
  {
    std::string known;
    for (const RecordFormat & each : Records)
    {
      known +=
        std::string(known.empty() ? "" : "; ") + each.member + " and " + each.otherMember + " (" + each.name + ")";
    }
    throw ExportError("the profile " + values.name + " has the members of no format that is known; expected " + known);
  }
  profile = isReport ? ReadReport(members) : found->read(members);
  profile.file = values.name;
  profile.format = isReport ? "report" : found->name;
  return profile;
}

} // namespace sensornoise
