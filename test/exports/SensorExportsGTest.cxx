// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"
#include "helpers/ExportTestHelper.h"

#include <string>

// Each record is read back in the units of its program. The variance at the level x, by the sensor alone, is
// g (x - mu) + sigma^2.

class SensorExports : public ExportTest
{
protected:
  /** Compares the variance that follows from the numbers of a record with the sensor's. */
  static void
  IsTheSensor(double offsetDn, double electronsPerDn, double readNoiseElectrons = readNoise / gain)
  {
    IsTheLine(
      [&](double level) {
        // Electrons have the variance of their number; the read noise joins it.
        const double electrons = (level - offsetDn) * electronsPerDn;
        return (electrons + readNoiseElectrons * readNoiseElectrons) / (electronsPerDn * electronsPerDn);
      },
      gain,
      readNoise * readNoise - gain * offset);
  }
};

TEST_F(SensorExports, PymeIsTheSensor)
{
  m_Report.texts["/camera/name"] = "Maker \"X\" 1";
  const std::string text = TextOf("pyme");
  EXPECT_EQ(text.find("\"Maker \\\"X\\\" 1\":\n    noise_properties:\n      fixed:\n        ADOffset: "), 0U) << text;
  IsTheSensor(
    NumberAfter(text, "ADOffset: "), NumberAfter(text, "ElectronsPerCount: "), NumberAfter(text, "ReadNoise: "));
  EXPECT_EQ(NumberAfter(text, "SaturationThreshold: "), white);
}

TEST_F(SensorExports, PicassoIsTheSensor)
{
  const std::string text = TextOf("picasso");
  EXPECT_EQ(text.find("Cameras:\n  \"camera\":\n    Sensor: sCMOS\n    Baseline: "), 0U) << text;
  IsTheSensor(NumberAfter(text, "Baseline: "), NumberAfter(text, "Sensitivity: "));
}

TEST_F(SensorExports, SmapIsTheSensor)
{
  const std::string text = TextOf("smap");
  // Electrons are (x - offset) conversion / emgain.
  IsTheSensor(NumberAfter(text, "\"offset\": "),
              NumberAfter(text, "\"conversion\": ") / NumberAfter(text, "\"emgain\": "));
}

TEST_F(SensorExports, DecodeIsTheSensor)
{
  const std::string text = TextOf("decode");
  IsTheSensor(NumberAfter(text, "baseline: "), NumberAfter(text, "e_per_adu: "), NumberAfter(text, "read_sigma: "));
  EXPECT_NE(text.find("\n  em_gain:\n"), std::string::npos) << text;
}

TEST_F(SensorExports, ThunderstormIsTheSensor)
{
  const std::string text = TextOf("thunderstorm");
  EXPECT_EQ(text.find("run(\"Camera setup\", \"offset="), 0U) << text;
  IsTheSensor(NumberAfter(text, "offset="), NumberAfter(text, "photons2adu="));
}

TEST_F(SensorExports, FitsCardsAreTheSensor)
{
  const std::string text = TextOf("fits");
  ASSERT_EQ(text.size(), 162U); // two cards and their line ends
  EXPECT_EQ(text.substr(0, 10), "EGAIN   = ");
  EXPECT_EQ(text.substr(81, 10), "RDNOISE = ");
  EXPECT_EQ(text.find("\nGAIN"), std::string::npos);
  EXPECT_EQ(text[30], ' '); // the number ends in column 30
  IsTheSensor(offset, NumberAfter(text, "EGAIN   = "), NumberAfter(text, "RDNOISE = "));
}

TEST_F(SensorExports, CcdprocIsTheSensor)
{
  const std::string text = TextOf("ccdproc");
  const auto        quantity = [&](const std::string & name, const std::string & unit) {
    const std::string rest = text.substr(text.find("\"" + name + "\""));
    EXPECT_EQ(rest.find("\"unit\": \"" + unit + "\""), rest.find("\"unit\": ")) << rest;
    return NumberAfter(rest, "\"value\": ");
  };
  IsTheSensor(quantity("offset", "adu"), quantity("gain", "electron / adu"), quantity("readnoise", "electron"));
}

TEST_F(SensorExports, LsstHasEveryAmplifierWithItsErrors)
{
  this->MakeMosaic();
  const std::string text = TextOf("lsst");
  EXPECT_NE(text.find("\"ampNames\": [\"R\", \"G1\", \"G2\", \"B\"]"), std::string::npos) << text;
  const auto of = [&](const std::string & name) {
    return NumberAfter(text.substr(text.find("\"" + name + "\": {")), "\"G2\": ");
  };
  IsTheSensor(offset, of("gain"), of("noise"));
  EXPECT_NEAR(of("gainErr"), 0.001 / (gain * gain), 1e-12); // of 1 / g
  EXPECT_EQ(of("noiseErr"), 0.02);
  for (const char * error : { "/gain/standard_error", "/read_noise_electrons/standard_error" })
  {
    m_Report.numbers.erase(std::string("/channels/0") + error);
  }
  EXPECT_NE(TextOf("lsst").find("\"gainErr\": {\"R\": null, "), std::string::npos);
}

TEST_F(SensorExports, Emva1288IsTheSensor)
{
  const std::string text = TextOf("emva1288");
  EXPECT_EQ(text.find("<results>\n  <sensitivity>\n    <K>\n"), 0U) << text;
  const auto value = [&](const std::string & name) {
    return NumberAfter(text.substr(text.find("<" + name + ">")), "<Value>");
  };
  IsTheSensor(offset, 1.0 / value("K"), value("sigma_d"));
  IsTheSensor(offset, value("inverse_K"), value("sigma_d"));
}

TEST_F(SensorExports, AQuantityThatIsNotIdentifiedIsRefused)
{
  this->RemoveQuantity("/read_noise", "upper-limit");
  for (const char * format : { "pyme", "decode", "fits", "ccdproc", "lsst", "emva1288" })
  {
    IsRefused(format, { "no value of read_noise", "upper-limit", "--dark" });
  }
  EXPECT_NE(TextOf("picasso"), ""); // asks for no read noise
  this->RemoveQuantity("/offset", "not-identifiable");
  for (const char * format : { "picasso", "smap", "thunderstorm" })
  {
    IsRefused(format, { "no value of offset", "not-identifiable", "--dark" });
  }
  this->SetQuantity("/offset", offset);
  this->RemoveQuantity("/gain", "failed");
  IsRefused("smap", { "no value of gain", "failed", "warnings" });
}

TEST_F(SensorExports, NumbersOfNoSensorAreRefused)
{
  for (const char * format : { "pyme", "fits", "decode", "lsst" })
  {
    this->SetQuantity("/read_noise", -3.0);
    IsRefused(format, { "report.json", "read_noise of -3 DN", "0 or more" });
    this->SetQuantity("/read_noise", 1e308); // 2e308 electrons
    IsRefused(format, { "read_noise of 1e+308 DN", "finite" });
  }
  this->SetQuantity("/gain", 1e-320); // 1 / 1e-320 is infinite
  for (const char * format : { "pyme", "picasso", "smap", "thunderstorm", "emva1288" })
  {
    IsRefused(format, { "report.json", "has a gain of", "reciprocal is finite" });
  }
}

TEST_F(SensorExports, AMosaicIsExportedByChannel)
{
  this->MakeMosaic();
  for (const char * format : { "pyme", "picasso", "smap", "decode", "thunderstorm", "fits", "ccdproc", "emva1288" })
  {
    IsRefused(format, { "4 channels", "R, G1, G2 or B", "--channel" });
  }
}

// No record of a sensor holds the excess noise of multiplied electrons: its program would take it for no noise.
TEST_F(SensorExports, MultipliedElectronsAreRefused)
{
  const std::string line = TextOf("ndsafir"); // the variance of the frames, which contains the excess noise
  for (const char * const at : { "/settings", "/channels/0/settings" })
  {
    m_Report.numbers[std::string(at) + "/excess_noise_factor"] = 2.0;
    for (const sensornoise::ExportFormat & format : sensornoise::ExportFormats())
    {
      if (format.takes == sensornoise::ExportTakes::Sensor)
      {
        IsRefused(format.name, { "report.json", "excess noise factor of 2", format.name, "2 e-/DN", "ndsafir" });
      }
    }
    EXPECT_EQ(TextOf("ndsafir"), line);
    m_Report.numbers.erase(std::string(at) + "/excess_noise_factor");
  }
}
