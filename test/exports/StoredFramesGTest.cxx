// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/NoiseProfile.h"

#include "helpers/ProfileTestHelper.h"

#include <cstddef>
#include <string>
#include <vector>

namespace
{
/** Stored reports with the noise curve of ProfileTest::Frames(). */
class StoredFrames : public ProfileTest
{
protected:
  void
  AddCurve(const std::string & at, const sensornoise::Report & frames)
  {
    m_Report.numbers[at + "/frames_distinct"] = static_cast<double>(frames.framesDistinct);
    for (std::size_t i = 0; i < frames.scatter.mean.size(); ++i)
    {
      const std::string bin = "/" + std::to_string(i);
      m_Report.numbers[at + "/scatter/mean" + bin] = frames.scatter.mean[i];
      m_Report.numbers[at + "/scatter/variance" + bin] = frames.scatter.variance[i];
      m_Report.numbers[at + "/scatter/corrected_variance" + bin] = frames.scatter.correctedVariance[i];
      m_Report.numbers[at + "/scatter/count" + bin] = static_cast<double>(frames.scatter.count[i]);
    }
  }
  std::vector<sensornoise::ChannelProfileCheck>
  CheckStored(const sensornoise::NoiseProfile & profile) const
  {
    return sensornoise::CheckStoredFrames(profile, m_Report, sensornoise::ReadCameraNoise(m_Report));
  }
};
} // namespace

TEST_F(StoredFrames, GiveTheCheckOfTheirReport)
{
  this->AddCurve("", Frames());
  for (const double scale : { slope, 2.0 * slope })
  {
    const auto profile = LineProfile(scale, intercept);
    const auto checks = this->CheckStored(profile);
    ASSERT_EQ(checks.size(), 1U);
    ASSERT_TRUE(checks[0].check) << checks[0].reason;
    EXPECT_EQ(checks[0].channel, "mono");
    EXPECT_EQ(sensornoise::ToJson(*checks[0].check), sensornoise::ToJson(this->Check(profile)));
  }
}

TEST_F(StoredFrames, CompareEachChannelOfAMosaic)
{
  this->MakeMosaic();
  for (std::size_t i = 0; i < 4; ++i)
  {
    this->AddCurve("/channels/" + std::to_string(i), Frames(MosaicSlope(i), MosaicIntercept(i)));
  }
  auto profile = LineProfile(MosaicSlope(0), MosaicIntercept(0));
  profile.channels.front().channel = "R";
  profile.channels.push_back({ "G", MosaicSlope(1), MosaicIntercept(1), std::nullopt });
  const auto checks = this->CheckStored(profile);
  ASSERT_EQ(checks.size(), 4U);
  EXPECT_EQ(checks[0].check->verdict, sensornoise::NoiseModelCheck::Verdict::Fits) << checks[0].check->sentence;
  EXPECT_EQ(checks[1].check->verdict, sensornoise::NoiseModelCheck::Verdict::Fits) << checks[1].check->sentence;
  EXPECT_EQ(checks[2].check->verdict, sensornoise::NoiseModelCheck::Verdict::DoesNotFit) << "G2 has another gain";
  EXPECT_FALSE(checks[3].check);
  EXPECT_NE(checks[3].reason.find("the frames have the channel B"), std::string::npos) << checks[3].reason;
}

TEST_F(StoredFrames, AreRefusedWithoutTheirNoiseCurve)
{
  const auto profile = LineProfile(slope, intercept);
  EXPECT_THROW(this->CheckStored(profile), sensornoise::ExportError) << "levels without numbers of pixels";
  this->AddCurve("", Frames());
  EXPECT_NO_THROW(this->CheckStored(profile));
  m_Report.numbers["/scatter/mean/5"] = 0.0;
  EXPECT_THROW(this->CheckStored(profile), sensornoise::ExportError) << "levels that do not rise";
  this->AddCurve("", Frames());
  m_Report.texts["/method"] = "published";
  EXPECT_THROW(this->CheckStored(profile), sensornoise::ExportError);
}

TEST_F(StoredFrames, SayWhyTheirVarianceIsNotMeasured)
{
  this->AddCurve("", Frames());
  m_Report.numbers.erase("/scatter/corrected_variance/3"); // it is null
  m_Report.texts["/warnings/0/message"] = "the frames are all alike";
  const auto checks = this->CheckStored(LineProfile(slope, intercept));
  EXPECT_EQ(checks[0].check->verdict, sensornoise::NoiseModelCheck::Verdict::NotDetermined);
  EXPECT_NE(checks[0].check->sentence.find("the frames are all alike"), std::string::npos);
}
