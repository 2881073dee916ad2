// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/NoiseProfile.h"

#include "base/Text.h"
#include "exports/ExportFormats.h"
#include "stabilise/NoiseModelCheck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
using Band = NoiseModelCheck::Band;

/** Deviation of a band's ratio from 1 that is accepted in a profile, whatever its error [1]: profiles are rounded, and
 * cameras of one type differ by a few percent. */
constexpr double profileTolerance = 0.05;
/** Largest exponent of a factor that is a power of two: from 8 to 16 bits. */
constexpr int mostBits = 8;

/** A known mistake: the profile as it would be without it. */
struct ProfileMistake
{
  std::string     words;
  ProfileVariance corrected;
};

NoiseModelCheck
CheckProfileVariance(const Report & frames, const ProfileVariance & profile)
{
  const auto variance = [&](double level) { return profile.At(level); };
  const auto tolerance = [&](double level) { return profileTolerance + profile.UnavoidableErrorAt(level); };
  return CheckVariance(frames, variance, tolerance);
}

/** Adds mistakes of the gain: the inverse, and a variance in squared electrons. */
void
AddInverses(const ProfileVariance & profile, std::vector<ProfileMistake> & mistakes)
{
  const char * const exchanged = "e-/ADU and ADU/e- are exchanged";
  const double       inverse = 1.0 / profile.slope;
  ProfileVariance    corrected = profile;
  corrected.slope = inverse;
  // The read noise of the profile is in DN, or it is in electrons and was converted by the wrong gain.
  for (const double dark : { profile.darkDn2, profile.darkDn2 * Squared(Squared(inverse)) })
  {
    corrected.darkDn2 = profile.hasReadNoise ? dark : profile.darkDn2;
    mistakes.push_back({ exchanged, corrected });
  }
  if (profile.form == ProfileForm::Line)
  {
    corrected.darkDn2 = profile.darkDn2 + (inverse - profile.slope) * profile.levelDn; // the intercept is right
    mistakes.push_back({ exchanged, corrected });
  }
  if (profile.form != ProfileForm::Sensor)
  {
    corrected.darkDn2 = profile.darkDn2 * Squared(inverse);
    mistakes.push_back({ "the variance is in e-^2 in place of DN^2", corrected });
  }
}

/** Adds mistakes of the black level. */
void
AddLevels(const ProfileVariance & profile, std::vector<ProfileMistake> & mistakes)
{
  const auto level = DarkLevelOf(profile.camera);
  if (!level)
  {
    return;
  }
  ProfileVariance corrected = profile;
  corrected.levelDn = *level;
  std::string words = "the black level of " + LevelText(*level) + " DN is not subtracted";
  if (profile.form == ProfileForm::Line)
  {
    corrected.darkDn2 = profile.darkDn2 - profile.slope * profile.levelDn;
  }
  else if (profile.levelDn != 0.0)
  {
    words = "the black level is " + LevelText(profile.levelDn) + " DN in the profile and " + LevelText(*level) +
            " DN in the frames";
  }
  mistakes.push_back({ words, corrected });
  if (profile.form == ProfileForm::Normalised)
  {
    const double range = profile.unitDn + profile.levelDn;
    corrected = profile;
    corrected.levelDn = 0.0;
    corrected.slope *= range / profile.unitDn;
    corrected.darkDn2 *= Squared(range / profile.unitDn);
    mistakes.push_back({ "the black level of " + LevelText(profile.levelDn) + " DN is not subtracted", corrected });
  }
}

/** Adds mistakes of the read noise: its unit, and its square. */
void
AddReadNoises(const ProfileVariance & profile, std::vector<ProfileMistake> & mistakes)
{
  if (!profile.hasReadNoise)
  {
    return;
  }
  const bool isSensor = profile.form == ProfileForm::Sensor;
  const auto add = [&](const std::string & words, double dark) {
    ProfileVariance corrected = profile;
    corrected.darkDn2 = dark;
    mistakes.push_back({ words, corrected });
  };
  const double slope2 = Squared(profile.slope);
  add(isSensor ? "the read noise is in DN in place of e-" : "the read noise is in e- in place of DN",
      isSensor ? profile.darkDn2 / slope2 : profile.darkDn2 * slope2);
  const double unit2 = Squared(profile.unitDn);
  add("the dark variance has the value of a standard deviation", Squared(profile.darkDn2) / unit2);
  add("the read noise has the value of a variance", std::sqrt(std::max(0.0, profile.darkDn2)) * profile.unitDn);
}

/** Adds the mistake of scale and offset in the other order. */
void
AddExchangedTerms(const ProfileVariance & profile, std::vector<ProfileMistake> & mistakes)
{
  ProfileVariance corrected = profile;
  if (profile.form == ProfileForm::Normalised)
  {
    corrected.slope = profile.darkDn2 / profile.unitDn;
    corrected.darkDn2 = profile.slope * profile.unitDn;
  }
  else if (profile.form == ProfileForm::Line)
  {
    corrected.slope = profile.darkDn2 - profile.slope * profile.levelDn;
    corrected.darkDn2 = profile.slope + corrected.slope * profile.levelDn;
  }
  else
  {
    return;
  }
  mistakes.push_back({ "scale and offset are exchanged", corrected });
}

/** Calls \a add with the factors of the variance of a difference of two frames, which is halved once, and with words.
 */
template <typename TAdd>
void
ForHalves(TAdd add)
{
  const std::string of = ", as of a difference of two frames that is ";
  add(0.5, "all variances are 2 times too high" + of + "not halved");
  add(2.0, "all variances are 2 times too low" + of + "halved twice");
}

/** Adds the mistakes of ForHalves(). */
void
AddHalves(const ProfileVariance & profile, std::vector<ProfileMistake> & mistakes)
{
  ForHalves([&](double factor, const std::string & words) {
    ProfileVariance corrected = profile;
    corrected.slope *= factor;
    corrected.darkDn2 *= factor;
    mistakes.push_back({ words, corrected });
  });
}

/** Adds the mistake of a preset that darktable's tool measured with another demosaicing than today's. */
void
AddDemosaicing(const ProfileVariance & profile, std::vector<ProfileMistake> & mistakes)
{
  const double    factor = darktableGreen.value / darktableGreenPpg;
  ProfileVariance corrected = profile;
  corrected.slope *= factor;
  corrected.darkDn2 *= factor;
  mistakes.push_back({ "it was measured with the demosaicing PPG, whose presets have " + Rounded(1.0 / factor) +
                         " times the numbers of darktable's RCD",
                       corrected });
}

/** Adds the mistake of a floor that lies above the variance of dark pixels, as CAREamics' default may do. */
void
AddFloor(const ProfileVariance & profile, std::vector<ProfileMistake> & mistakes)
{
  ProfileVariance corrected = profile;
  corrected.floorDn2 = 0.0;
  mistakes.push_back(
    { "min_sigma is the lowest variance, and " + Text(profile.floorDn2) + " DN^2 is too high", corrected });
}

/** Calls \a add with each factor that is a power of two, by which the profile may be too low or too high, and with its
 * words. */
template <typename TAdd>
void
ForPowers(TAdd add)
{
  for (int bits = 1; bits <= mostBits; ++bits)
  {
    for (const double factor : { std::exp2(bits), std::exp2(-bits) })
    {
      add(factor, Text(std::exp2(bits)) + " times too " + (factor > 1.0 ? "low" : "high"));
    }
  }
}

/** Adds factors that are a power of two: of the levels, with or without the black level, and of the gain alone. */
void
AddPowers(const ProfileVariance & profile, std::vector<ProfileMistake> & mistakes)
{
  ForPowers([&](double factor, const std::string & times) {
    const std::string scale = "its levels are " + times + ", as for another white level or bit depth";
    ProfileVariance   corrected = profile;
    corrected.slope *= factor;
    mistakes.push_back({ "its gain is " + times, corrected });
    corrected.darkDn2 *= Squared(factor);
    mistakes.push_back({ scale, corrected });
    corrected.levelDn *= factor;
    mistakes.push_back({ scale, corrected });
  });
}

/** Returns the mistakes of libcamera's tuning: another scale, and the factor of the slope. */
std::vector<ProfileMistake>
LibcameraMistakes(const ProfileVariance & profile)
{
  std::vector<ProfileMistake> mistakes;
  const auto                  add = [&](const std::string & words, double constantFactor, double slopeFactor) {
    ProfileVariance corrected = profile;
    corrected.root.constant *= constantFactor;
    corrected.root.slope *= slopeFactor;
    mistakes.push_back({ words, corrected });
  };
  add("the slope lacks the factor 1.4 of rpi-ctt", 1.0, libcameraSlopeFactor);
  add("the slope has the factor 1.4 of rpi-ctt twice", 1.0, 1.0 / libcameraSlopeFactor);
  ForHalves([&add](double factor, const std::string & words) { add(words, std::sqrt(factor), std::sqrt(factor)); });
  ForPowers([&add](double factor, const std::string & times) {
    add("its levels are " + times + ", as for another bit depth", factor, std::sqrt(factor));
    add("its variance is " + times + ", as for another analogue gain", std::sqrt(factor), std::sqrt(factor));
  });
  return mistakes;
}

/** Returns the known mistakes, likely mistakes first. */
std::vector<ProfileMistake>
KnownMistakes(const ProfileVariance & profile)
{
  std::vector<ProfileMistake> mistakes;
  if (profile.form == ProfileForm::Root)
  {
    return LibcameraMistakes(profile);
  }
  if (profile.floorDn2 > 0.0)
  {
    AddFloor(profile, mistakes);
  }
  if (profile.isOfDarktable)
  {
    AddDemosaicing(profile, mistakes);
  }
  AddInverses(profile, mistakes);
  AddLevels(profile, mistakes);
  AddReadNoises(profile, mistakes);
  AddExchangedTerms(profile, mistakes);
  AddHalves(profile, mistakes);
  AddPowers(profile, mistakes);
  return mistakes;
}

/** Returns the mistakes with which the profile would agree with the frames, as words; empty: there is none. */
std::string
ExplainProfile(const Report & frames, const ProfileVariance & profile)
{
  std::string              text;
  std::vector<std::string> found;
  for (const ProfileMistake & mistake : KnownMistakes(profile))
  {
    const bool isNew = std::find(found.begin(), found.end(), mistake.words) == found.end();
    if (isNew && CheckProfileVariance(frames, mistake.corrected).verdict == NoiseModelCheck::Verdict::Fits)
    {
      text += (text.empty() ? "" : ", or ") + mistake.words;
      found.push_back(mistake.words);
    }
  }
  return text;
}

/** Returns the band that contradicts the profile most, in standard errors. A band in which the profile has no variance
 * takes precedence. */
const Band &
WorstBand(const std::vector<Band> & bands)
{
  const auto excess = [](const Band & band) {
    const double error = std::max(band.standardError, 1e-12);
    return band.fits ? -1.0 : band.ratio ? std::abs(*band.ratio - 1.0) / error : HUGE_VAL;
  };
  return *std::max_element(
    bands.begin(), bands.end(), [&](const Band & a, const Band & b) { return excess(a) < excess(b); });
}

/** Returns how far the profile is off at the middle of a band: "is 2.0 times too low at 500 DN". */
std::string
DescribeExcess(const Band & band)
{
  const std::string level = " at " + LevelText(0.5 * (band.lowDn + band.highDn)) + " DN";
  if (!band.ratio || !(*band.ratio > 0.0))
  {
    return "has no variance" + level;
  }
  const bool           isLow = *band.ratio > 1.0;
  const double         factor = isLow ? *band.ratio : 1.0 / *band.ratio;
  std::array<char, 32> text{};
  std::snprintf(text.data(),
                text.size(),
                factor < 1.2    ? "%.2f"
                : factor < 10.0 ? "%.1f"
                : factor < 1e6  ? "%.0f"
                                : "%.1e",
                factor);
  return "is " + std::string(text.data()) + " times too " + (isLow ? "low" : "high") + level;
}

/** Returns the band that deviates most from a profile of libcamera which fits as well as its formula can; null: no band
 * deviates by more than profiles may. */
const Band *
WorstMisfit(const NoiseModelCheck & check)
{
  constexpr double errors = 4.0; // as bands are tested, in standard errors
  const Band *     worst = nullptr;
  double           largest = 0.0; // largest logarithm of a ratio, as an absolute value
  for (const Band & band : check.bands)
  {
    const bool deviates = band.fits && band.ratio && *band.ratio > 0.0 &&
                          std::abs(*band.ratio - 1.0) > std::max(profileTolerance, errors * band.standardError);
    if (deviates && std::abs(std::log(*band.ratio)) > largest)
    {
      worst = &band;
      largest = std::abs(std::log(*band.ratio));
    }
  }
  return check.verdict == NoiseModelCheck::Verdict::Fits ? worst : nullptr;
}
} // namespace

NoiseModelCheck
CheckNoiseProfile(const NoiseProfile & profile, const Report & frames, const CameraNoise & burst)
{
  const ProfileVariance variance = VarianceOfProfile(profile, burst);
  NoiseModelCheck       check = CheckProfileVariance(frames, variance);
  if (check.verdict == NoiseModelCheck::Verdict::DoesNotFit)
  {
    const std::string cause = ExplainProfile(frames, variance);
    check.sentence = "the profile " + profile.file + " (" + profile.format + ") " +
                     DescribeExcess(WorstBand(check.bands)) + ": " +
                     (cause.empty() ? "no known mistake explains it. Write a profile of these frames with "
                                      "export-noise-model"
                                    : cause);
  }
  const Band * const misfit = variance.form == ProfileForm::Root ? WorstMisfit(check) : nullptr;
  if (misfit)
  {
    check.sentence = "the profile " + profile.file + " (" + profile.format + ") " + DescribeExcess(*misfit) +
                     ", as far as constant + slope sqrt(signal) is from the variance of these frames. No values of "
                     "libcamera's formula agree better: use the profile only where such an error is small enough";
  }
  if (!variance.hasReadNoise)
  {
    check.sentence += variance.isOffsetTested
                        ? ". The file has no read noise: the read noise of these frames is taken"
                        : ". The file has no read noise and these frames have no dark level: the offset is not tested";
  }
  return check;
}

} // namespace sensornoise
