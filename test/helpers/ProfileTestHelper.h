// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ProfileTestHelper_h
#define ProfileTestHelper_h

#include "exports/NoiseProfile.h"
#include "helpers/ExportTestHelper.h"
#include "sensornoise/Report.h"

#include <optional>
#include <string>

/** Frames with the noise of the report of ExportTest, and the checks of profiles against them. */
class ProfileTest : public ExportTest
{
protected:
  /** 100 frames with 4000 pixels in each of 64 bins of levels 70 to 3,850: a bin's relative error is 0.0022. */
  static sensornoise::Report
  Frames(double slopeDn = slope, double interceptDn2 = intercept)
  {
    sensornoise::Report frames;
    frames.framesDistinct = 100;
    for (int i = 0; i < 64; ++i)
    {
      const double level = 70.0 + 60.0 * i;
      frames.scatter.mean.push_back(level);
      frames.scatter.variance.push_back(slopeDn * level + interceptDn2);
      frames.scatter.correctedVariance.push_back(slopeDn * level + interceptDn2);
      frames.scatter.count.push_back(4000);
    }
    return frames;
  }
  sensornoise::NoiseModelCheck
  Check(const sensornoise::NoiseProfile & profile, const sensornoise::ExportSettings & settings = {}) const
  {
    return sensornoise::CheckNoiseProfile(profile, Frames(), sensornoise::ReadCameraNoise(m_Report, settings));
  }
  /** Expects that every ratio is 1 to 1e-6. */
  void
  IsTrue(const sensornoise::NoiseProfile & profile) const
  {
    SCOPED_TRACE(profile.format);
    const auto check = Check(profile);
    EXPECT_EQ(check.verdict, sensornoise::NoiseModelCheck::Verdict::Fits) << check.sentence;
    for (const auto & band : check.bands)
    {
      EXPECT_NEAR(band.ratio.value_or(0.0), 1.0, 1e-6) << "from " << band.lowDn << " DN";
    }
  }
  static sensornoise::NoiseProfile
  ProfileOf(sensornoise::ProfileForm form, double scale, std::optional<double> constant)
  {
    sensornoise::NoiseProfile profile;
    profile.file = "profile";
    profile.format = "test";
    profile.form = form;
    profile.channels.push_back({ "mono", scale, constant, std::nullopt });
    return profile;
  }
  static sensornoise::NoiseProfile
  LineProfile(double slopeDn, double interceptDn2)
  {
    return ProfileOf(sensornoise::ProfileForm::Line, slopeDn, interceptDn2);
  }
  static sensornoise::NoiseProfile
  NormalisedProfile(double scale, double constant)
  {
    return ProfileOf(sensornoise::ProfileForm::Normalised, scale, constant);
  }
  static sensornoise::NoiseProfile
  SensorProfile(double electronsPerDn, std::optional<double> readNoiseElectrons, double offsetDn)
  {
    auto profile = ProfileOf(sensornoise::ProfileForm::Sensor, electronsPerDn, readNoiseElectrons);
    profile.channels.front().offsetDn = offsetDn;
    return profile;
  }
};

#endif
