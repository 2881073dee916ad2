// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ProfileCheck.h"

#include "base/Text.h"
#include "exports/Darktable.h"
#include "exports/ExportFormats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace sensornoise
{
namespace
{
/** Returns the place of the burst's channel among the names in a profile: of its own name, of "G" for both greens, or
 * of the only one, which is for all channels. */
std::size_t
PlaceOfChannel(const std::string & file, const std::vector<std::string> & names, const std::string & wanted)
{
  const auto find = [&](const std::string & name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  std::size_t place = find(wanted);
  if (place == names.size() && (wanted == "G1" || wanted == "G2"))
  {
    place = find("G");
  }
  if (place < names.size() || names.size() == 1)
  {
    return std::min(place, names.size() - 1);
  }
  std::string list;
  for (const std::string & name : names)
  {
    list += (list.empty() ? "" : ", ") + name;
  }
  throw ExportError("the profile " + file + " has the channels " + list + ", and the frames have the channel " +
                    wanted + "; expected a profile of this camera, or give the mosaic of the frames (--bayer)");
}

/** Returns scale and offset of Android's model at the ISO speed of the burst. */
ProfileChannel
AndroidChannelAt(const NoiseProfile & profile, const CameraNoise & burst)
{
  const AndroidProfile & android = *profile.android;
  const std::size_t      i = PlaceOfChannel(profile.file, android.channels, burst.channels.front().channel);
  if (!burst.isoSpeed || !(*burst.isoSpeed > 0.0))
  {
    throw ExportError("the profile " + profile.file +
                      " depends on the ISO speed, and the frames' files do not have "
                      "it; expected camera raw files");
  }
  const double iso = *burst.isoSpeed;
  const double digital = android.maxAnalogueIso ? std::max(1.0, iso / *android.maxAnalogueIso) : 1.0;
  return { "mono", android.a[i] * iso + android.b[i], android.c[i] * iso * iso + android.d[i] * digital * digital, {} };
}

ProfileChannel
ChannelFor(const NoiseProfile & profile, const CameraNoise & burst)
{
  if (profile.android)
  {
    return AndroidChannelAt(profile, burst);
  }
  if (!profile.darktable.empty())
  {
    return DarktableChannelAt(profile, burst);
  }
  std::vector<std::string> names;
  for (const ProfileChannel & channel : profile.channels)
  {
    names.push_back(channel.channel);
  }
  return profile.channels[PlaceOfChannel(profile.file, names, burst.channels.front().channel)];
}

void
SetNormalised(const ProfileChannel & channel, const CameraNoise & burst, ProfileVariance & variance)
{
  variance.levelDn = BlackLevelOf(burst);
  variance.unitDn = WhiteLevelOf(burst) - variance.levelDn;
  if (!(variance.unitDn > 0.0))
  {
    throw ExportError(
      "the white level is " + Text(WhiteLevelOf(burst)) + " DN and the black level " + Text(variance.levelDn) +
      " DN; expected a white level above the black level. Give both (--black, --white), or correct them "
      "in the profile.");
  }
  variance.slope = channel.scale * variance.unitDn;
  variance.darkDn2 = channel.constant.value_or(0.0) * Squared(variance.unitDn);
}

void
SetLine(const ProfileChannel & channel, const CameraNoise & burst, ProfileVariance & variance)
{
  variance.levelDn = DarkLevelOf(burst).value_or(0.0);
  variance.slope = channel.scale;
  variance.darkDn2 = channel.constant.value_or(0.0) + channel.scale * variance.levelDn;
}

/** Sets the variance of a sensor's record. What it lacks is the burst's: without a read noise the burst's if it is
 * identified, else the variance of its line at the file's offset. */
void
SetSensor(const std::string &    file,
          const ProfileChannel & channel,
          const CameraNoise &    burst,
          ProfileVariance &      variance)
{
  const ChannelNoise & measured = burst.channels.front();
  const auto           level = channel.offsetDn ? channel.offsetDn : DarkLevelOf(burst);
  if (!level)
  {
    throw ExportError("the profile " + file +
                      " has no dark offset, and the offset of the frames is not known. Give dark "
                      "frames (--dark), the offset (--offset) or the black level (--black).");
  }
  const NoiseModel line = ModelOf(burst, measured);
  variance.excess = burst.excessNoiseFactor;
  variance.smoothing = measured.gain.value && *measured.gain.value > 0.0
                         ? line.varianceSlopeDn / (*measured.gain.value * variance.excess)
                         : 1.0;
  variance.levelDn = *level;
  variance.slope = 1.0 / channel.scale;
  variance.unitDn = variance.slope;
  variance.hasReadNoise = channel.constant.has_value();
  const auto burstDark = DarkLevelOf(burst);
  variance.isOffsetTested = channel.constant || measured.readNoise.value || burstDark;
  variance.darkDn2 = channel.constant ? Squared(*channel.constant * variance.slope)
                     : measured.readNoise.value
                       ? Squared(*measured.readNoise.value)
                       : std::max(0.0, line.VarianceAt(burstDark.value_or(*level))) / variance.smoothing;
}
} // namespace

double
ProfileVariance::At(double level) const
{
  if (form == ProfileForm::Root)
  {
    return LibcameraVariance(root, camera, level);
  }
  const double variance = smoothing * (excess * slope * (level - levelDn) + darkDn2);
  // Where rounding may have made a variance negative, the largest that it allows is taken.
  const bool isRoundedAway = !(variance > 0.0) && variance + roundingDn2 > 0.0;
  return std::max(floorDn2, isRoundedAway ? variance + roundingDn2 : variance);
}

double
ProfileVariance::UnavoidableErrorAt(double level) const
{
  const double variance = this->At(level);
  const double rounding = variance > 0.0 ? roundingDn2 / variance : 0.0;
  if (form != ProfileForm::Root)
  {
    return rounding + relativeError;
  }
  const LibcameraNoise best = FitLibcamera(camera);
  const double         fitted = LibcameraVariance(best, camera, level);
  const double         rounded = LibcameraVariance({ best.constant + 1.0, best.slope }, camera, level);
  const double         measured = ModelOf(camera, camera.channels.front()).VarianceAt(level);
  return fitted > 0.0 ? std::abs(measured / fitted - 1.0) + std::abs(rounded / fitted - 1.0) : 0.0;
}

std::optional<double>
DarkLevelOf(const CameraNoise & burst)
{
  const auto offset = burst.channels.front().offset.value;
  return offset ? offset : burst.blackLevelDn;
}

ProfileVariance
VarianceOfProfile(const NoiseProfile & profile, const CameraNoise & burst)
{
  const ProfileChannel channel = ChannelFor(profile, burst);
  ProfileVariance      variance;
  variance.form = profile.form;
  variance.floorDn2 = profile.floorDn2;
  variance.roundingDn2 = profile.roundingDn2;
  variance.relativeError = profile.relativeError;
  variance.isOfDarktable = !profile.darktable.empty() && burst.channels.front().channel != "mono";
  variance.camera = burst;
  variance.camera.blackLevelDn = profile.blackLevelDn ? profile.blackLevelDn : burst.blackLevelDn;
  variance.camera.whiteLevelDn = profile.whiteLevelDn ? profile.whiteLevelDn : burst.whiteLevelDn;
  switch (profile.form)
  {
    case ProfileForm::Line:
      SetLine(channel, burst, variance);
      break;
    case ProfileForm::Normalised:
      SetNormalised(channel, variance.camera, variance);
      break;
    case ProfileForm::Sensor:
      SetSensor(profile.file, channel, burst, variance);
      break;
    default:
      variance.root = { channel.constant.value_or(0.0), channel.scale };
      variance.levelDn = BlackLevelOf(burst);
      FitLibcamera(variance.camera); // throws if a level is missing
  }
  return variance;
}

} // namespace sensornoise
