// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/NoiseProfile.h"

#include "base/Text.h"
#include "exports/ExportFormats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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

/** Sets the variance of a sensor's record. Numbers that the record lacks are taken from the burst. In place of a read
 * noise this is the read noise of the burst if it is identified, else the variance of its line at the offset in the
 * file. */
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

namespace
{
/** Returns a number of a report; NaN if it is null or missing. */
double
NumberOrNan(const StoredReport & report, const std::string & pointer)
{
  const auto found = report.numbers.find(pointer);
  return found == report.numbers.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

/** Returns a number of a report that counts something; 0 if it is missing or is none. */
std::size_t
CountAt(const StoredReport & report, const std::string & pointer)
{
  constexpr double most = 9007199254740992.0; // 2^53: the largest count that a double holds exactly
  const double     number = NumberOrNan(report, pointer);
  return number > 0.0 && number <= most ? static_cast<std::size_t>(number) : 0;
}

/** Returns the noise curve of a channel of a stored report, its number of frames, and its first warning. \a at is the
 * JSON Pointer of the channel. */
Report
FramesAt(const StoredReport & report, const std::string & at)
{
  const auto method = report.texts.find(at + "/method");
  if (method != report.texts.end() && method->second != "refined")
  {
    throw ExportError("the report " + report.name + " is of the method " + method->second +
                      "; expected a report of the refined method, which gives the variance of each level");
  }
  Report frames;
  frames.framesDistinct = CountAt(report, at + "/frames_distinct");
  const std::string curve = at + "/scatter/";
  for (std::size_t i = 0; report.numbers.count(curve + "mean/" + std::to_string(i)) > 0; ++i)
  {
    const std::string bin = "/" + std::to_string(i);
    const std::size_t pixels = CountAt(report, curve + "count" + bin);
    if (pixels == 0)
    {
      throw ExportError("the report " + report.name + " has a noise curve without its numbers of pixels (scatter" +
                        "/count" + bin + "); expected a whole report of estimate-sensor-noise");
    }
    frames.scatter.mean.push_back(NumberOrNan(report, curve + "mean" + bin));
    frames.scatter.variance.push_back(NumberOrNan(report, curve + "variance" + bin));
    frames.scatter.correctedVariance.push_back(NumberOrNan(report, curve + "corrected_variance" + bin));
    frames.scatter.count.push_back(pixels);
  }
  if (!std::is_sorted(frames.scatter.mean.begin(), frames.scatter.mean.end()))
  {
    throw ExportError("the report " + report.name +
                      " has a noise curve whose levels do not rise (scatter/mean); expected a report as "
                      "estimate-sensor-noise writes it");
  }
  const auto warning = report.texts.find(at + "/warnings/0/message");
  if (warning != report.texts.end())
  {
    frames.warnings.push_back({ WarningCode::FewFrames, warning->second }); // the message alone is used
  }
  return frames;
}
} // namespace

std::vector<ChannelProfileCheck>
CheckStoredFrames(const NoiseProfile & profile, const StoredReport & frames, const CameraNoise & noise)
{
  const bool                       isMosaic = frames.texts.count("/channels/0/channel") > 0;
  std::vector<ChannelProfileCheck> checks;
  for (std::size_t i = 0; i < noise.channels.size(); ++i)
  {
    ChannelProfileCheck made;
    made.channel = noise.channels[i].channel;
    CameraNoise burst = noise;
    burst.channels = { noise.channels[i] };
    const Report measured = FramesAt(frames, isMosaic ? "/channels/" + std::to_string(i) : "");
    try
    {
      made.check = CheckNoiseProfile(profile, measured, burst);
    }
    catch (const ExportError & error)
    {
      made.reason = error.what();
    }
    checks.push_back(made);
  }
  return checks;
}

} // namespace sensornoise
