// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/NoiseProfile.h"

#include "helpers/ProfileTestHelper.h"

#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
/** Profiles read from files that are no JSON, written by the exports. */
class NoiseProfiles : public ProfileTest
{
protected:
  void
  SetUp() override
  {
    ProfileTest::SetUp();
    // The line of the variance is the sensor's: quantization noise is left out.
    this->SetQuantity("/total_intercept", intercept);
    this->SetQuantity("/read_noise", std::sqrt(intercept + gain * offset));
  }
  static void
  IsDamaged(const std::string & bytes, const std::vector<std::string> & parts)
  {
    try
    {
      ReadNoiseProfile("damaged.bin", bytes);
      ADD_FAILURE() << "was read";
    }
    catch (const ExportError & error)
    {
      EXPECT_NE(std::string(error.what()).find("damaged.bin"), std::string::npos) << error.what();
      for (const std::string & part : parts)
      {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << " is not in: " << error.what();
      }
    }
  }
  /** Returns a TIFF file without a tag, of little endian. */
  static std::string
  EmptyTiff()
  {
    return std::string("II*\0\x08\0\0\0\0\0\0\0\0\0", 14);
  }
  static StoredReport
  Values(const std::map<std::string, double> & numbers)
  {
    StoredReport values;
    values.name = "damaged.bin";
    values.numbers = numbers;
    return values;
  }
  static void
  AreRefused(const StoredReport & values, const std::string & part)
  {
    try
    {
      ReadNoiseProfile(values);
      ADD_FAILURE() << part;
    }
    catch (const ExportError & error)
    {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
};
} // namespace

TEST_F(NoiseProfiles, ExportsAreReadBack)
{
  for (const char * format : { "dng", "careamics", "pyme", "picasso", "decode", "thunderstorm", "fits", "emva1288" })
  {
    SCOPED_TRACE(format);
    const NoiseProfile profile = ReadNoiseProfile("profile", TextOf(format));
    EXPECT_EQ(profile.format, format);
    IsTrue(profile);
  }
  IsTrue(ReadNoiseProfile(m_Report));
}

namespace
{
/** Returns a card of a FITS header: 80 characters. */
std::string
Card(std::string text)
{
  text.resize(80, ' ');
  return text;
}
} // namespace

// A header of FITS has no ends of lines, and a comment behind the number may be missing.
TEST_F(NoiseProfiles, HeadersOfFitsAreCards)
{
  const std::string begin = Card("SIMPLE  =                    T / standard") +
                            Card("COMMENT EGAIN   = 7 and RDNOISE = 8 are not here") + Card("NOTE    = 'EGAIN   = 9'");
  const std::string egain = Card("EGAIN   = 2");
  const std::string noise = Card("RDNOISE =              3.0D0");
  for (const std::string & header : { begin + egain + noise + Card("END"), begin + noise + egain + Card("END") })
  {
    const NoiseProfile profile = ReadNoiseProfile("frame.fits", header + std::string(2880, '\0'));
    EXPECT_EQ(profile.format, "fits");
    EXPECT_EQ(profile.channels.front().scale, 2.0);
    EXPECT_EQ(profile.channels.front().constant, 3.0);
  }
  EXPECT_EQ(ReadNoiseProfile("h.txt", "EGAIN   = 2\r\nRDNOISE =3/ e-").channels.front().constant, 3.0);
  IsDamaged(begin + egain + Card("END") + noise, { "no card RDNOISE" });
  IsDamaged(begin + egain + Card("RDNOISE = 'three'"), { "RDNOISE", "'three'" });
}

TEST_F(NoiseProfiles, PicassosModeIsTheOnlyOne)
{
  const std::string  modes = "Cameras:\n  c:\n    Baseline: 1\n    Sensitivity:\n      16-bit:\n        slow: 0.5\n";
  const NoiseProfile profile = ReadNoiseProfile("config.yaml", modes);
  EXPECT_EQ(profile.format, "picasso");
  EXPECT_EQ(profile.channels.front().scale, 0.5);
  IsDamaged(modes + "        fast: 0.7\n", { "2 modes in Sensitivity", "Leave only", "the mode of these frames" });
}

TEST_F(NoiseProfiles, TagOfADngFileIsReadBack)
{
  const auto pairs = NoiseProfileOf(ReadCameraNoise(m_Report));
  IsTrue(ReadNoiseProfile("photo.dng", WithNoiseProfile(EmptyTiff(), pairs)));
  IsDamaged(EmptyTiff(), { "no tag NoiseProfile" });
  IsDamaged(WithNoiseProfile(EmptyTiff(), { pairs[0], pairs[0] }), { "2 pairs", "three" });
  IsDamaged(WithNoiseProfile(EmptyTiff(), { { 0.0, 1e-7 } }), { "scale 0", "above 0" });
  const std::string whole = WithNoiseProfile(EmptyTiff(), pairs);
  for (std::size_t length = 2; length < whole.size(); ++length)
  {
    IsDamaged(whole.substr(0, length), {});
  }
}

TEST_F(NoiseProfiles, AndroidsModelIsThatOfTheIsoSpeed)
{
  const double range = white - black;
  m_Report.numbers["/camera/iso_speed"] = 200.0;
  StoredReport values = Values({ { "/noise_model_A/0", slope / range / 200.0 },
                                 { "/noise_model_B/0", 0.0 },
                                 { "/noise_model_C/0", 0.0 },
                                 { "/noise_model_D/0", (intercept + slope * black) / (range * range) / 4.0 },
                                 { "/max_analog_iso", 100.0 } });
  IsTrue(ReadNoiseProfile(values));
  m_Report.numbers.erase("/camera/iso_speed");
  EXPECT_THROW(Check(ReadNoiseProfile(values)), ExportError);
}

TEST_F(NoiseProfiles, TruncatedArchivesAreRefused)
{
  const std::string whole = TextOf("careamics");
  for (std::size_t length = 2; length < whole.size(); length += 7)
  {
    IsDamaged(whole.substr(0, length), {});
  }
  std::string changed = whole;
  changed[whole.find('\n') + 20] ^= 1; // in the weights
  IsDamaged(changed, { "checksum" });
  std::string       many = whole; // the directory states 20,000 arrays, which may all be the same bytes
  const std::size_t count = many.rfind("PK\x05\x06") + 10;
  many[count] = '\x20';
  many[count + 1] = '\x4e';
  IsDamaged(many, { "20000 arrays" });
}

TEST_F(NoiseProfiles, NumbersThatNoProgramTakesAreRefused)
{
  IsDamaged("", { "no format that is known" });
  IsDamaged("1e-4 2e-7 3", { "3 numbers" });
  IsDamaged("ObjectType = Image\nElementDataFile = LOCAL\n" + std::string(300, '\0'),
            { "byte 43 is 0", "no text has", "expected text, JSON, npz or DNG" });
  IsDamaged("c:\n  " + std::string(300, 'a') + ": 1\n", { "a name of 300 bytes" });
  IsDamaged("EGAIN   = nan / e\nRDNOISE = 3 /", { "EGAIN" });
  IsDamaged("c:\n  ElectronsPerCount: -2\n  ADOffset: 1\n  ReadNoise: 1\n", { "ElectronsPerCount = -2", "above 0" });
  IsDamaged("c:\n  Sensitivity: 2\n  Baseline: 1\nd:\n  Sensitivity: 3\n  Baseline: 1\n", { "several values of " });
  IsDamaged("c:\n  Sensitivity: 2\n  Baseline: 1\n  Gain: 300\n", { "multiplies electrons" });
  IsDamaged("<results><K><Value>0.5</Value></K></results>", { "sigma_d" });
  AreRefused(Values({ { "/gain", 1e-4 }, { "/sigma", -1.0 } }), "sigma = -1");
  AreRefused(Values({ { "/gains/0", 0.5 }, { "/offsets", 0.0 } }), "0 numbers in offsets");
  AreRefused(Values({ { "/a", 0.5 } }), "reference_slope");
}
