// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"
#include "helpers/ExportTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <map>
#include <string>
#include <vector>

using namespace sensornoise;

class MapExport : public ExportTest
{
protected:
  using ImageType = itk::Image<float, 2>;

  /** The offset of a pixel is 100 x + y, its read noise 1 + x / 10 + y / 100. */
  CameraNoise
  NoiseWithMaps() const
  {
    CameraNoise noise = ReadCameraNoise(m_Report);
    noise.maps.width = 3;
    noise.maps.height = 2;
    for (int y = 0; y < 2; ++y)
    {
      for (int x = 0; x < 3; ++x)
      {
        noise.maps.offsetDn.push_back(100.0 * x + y);
        noise.maps.readNoiseDn.push_back(1.0 + 0.1 * x + 0.01 * y);
      }
    }
    return noise;
  }
  /** ITK reads the file, a row for a row of the sensor. */
  static ImageType::Pointer
  ImageOf(const ExportedFile & file)
  {
    const auto name = (std::filesystem::temp_directory_path() / ("MapExportGTest_" + file.name)).string();
    std::ofstream(name, std::ios::binary) << file.bytes;
    const auto reader = itk::ImageFileReader<ImageType>::New();
    reader->SetFileName(name);
    reader->Update();
    std::filesystem::remove(name);
    const auto size = reader->GetOutput()->GetLargestPossibleRegion().GetSize();
    EXPECT_EQ(size[0], 3U);
    EXPECT_EQ(size[1], 2U);
    return reader->GetOutput();
  }
};

// navigate reads <serial>_off.tiff and <serial>_var.tiff [DN, DN^2], PYME dark_<ms>ms.tif [DN] and variance_<ms>ms.tif
// [e-^2], with the exposure rounded to milliseconds.
TEST_F(MapExport, FilesAreTheMapsOfTheirProgramsInTheirUnits)
{
  m_Report.numbers["/camera/exposure_seconds"] = 0.0104;
  const NoiseExport        made = ExportNoise("maps", { NoiseWithMaps() });
  std::vector<std::string> names;
  for (const ExportedFile & file : made.files)
  {
    names.push_back(file.name);
  }
  ASSERT_EQ(names,
            (std::vector<std::string>{
              "SERIAL_off.tiff", "SERIAL_var.tiff", "dark_10ms.tif", "variance_10ms.tif", "smap_camera.mat" }));
  const auto offsets = ImageOf(made.files[0]);
  const auto variances = ImageOf(made.files[1]);
  const auto electrons = ImageOf(made.files[3]);
  EXPECT_EQ(made.files[2].bytes, made.files[0].bytes);
  for (int y = 0; y < 2; ++y)
  {
    for (int x = 0; x < 3; ++x)
    {
      const ImageType::IndexType at{ { x, y } };
      const double               readNoiseDn = 1.0 + 0.1 * x + 0.01 * y;
      EXPECT_FLOAT_EQ(offsets->GetPixel(at), 100.0F * static_cast<float>(x) + static_cast<float>(y));
      EXPECT_FLOAT_EQ(variances->GetPixel(at), static_cast<float>(readNoiseDn * readNoiseDn));
      EXPECT_FLOAT_EQ(electrons->GetPixel(at), static_cast<float>(std::pow(readNoiseDn / gain, 2.0)));
    }
  }
}

// SMAP's makegainoffsetCMOS loads offsetmap, varmap and gainmap from a MAT file. Photoelectrons are (x - offsetmap)
// gainmap, and their variance is varmap gainmap^2.
TEST_F(MapExport, SmapHasMatricesOfItsNames)
{
  const std::string bytes = ExportNoise("maps", { NoiseWithMaps() }).files[4].bytes;
  const auto        number = [&bytes](std::size_t at) {
    std::uint32_t found = 0;
    std::memcpy(&found, bytes.data() + at, sizeof found);
    return found;
  };
  std::map<std::string, std::vector<float>> matrices;
  for (std::size_t at = 0; at < bytes.size();)
  {
    EXPECT_EQ(number(at), 10U);     // single precision, little endian
    EXPECT_EQ(number(at + 4), 2U);  // rows
    EXPECT_EQ(number(at + 8), 3U);  // columns
    EXPECT_EQ(number(at + 12), 0U); // real
    const std::string  name = bytes.substr(at + 20, number(at + 16) - 1);
    std::vector<float> values(6);
    std::memcpy(values.data(), bytes.data() + at + 20 + name.size() + 1, 24);
    matrices[name] = values;
    at += 20 + name.size() + 1 + 24;
  }
  ASSERT_EQ(matrices.size(), 3U);
  EXPECT_EQ(matrices["offsetmap"], (std::vector<float>{ 0, 1, 100, 101, 200, 201 })); // column by column
  const float electronsPerDn = matrices["gainmap"].front();
  EXPECT_FLOAT_EQ(electronsPerDn, 2.0F);
  EXPECT_EQ(matrices["gainmap"], std::vector<float>(6, electronsPerDn));
  EXPECT_FLOAT_EQ(matrices["varmap"][5] * electronsPerDn * electronsPerDn, std::pow(1.21F * 2.0F, 2.0F));
}

TEST_F(MapExport, TheNameLacksAnExposureThatIsNotKnown)
{
  const NoiseExport made = ExportNoise("maps", { NoiseWithMaps() });
  EXPECT_EQ(made.files[2].name, "dark_ms.tif");
  EXPECT_NE(made.note.find("the exposure is not known"), std::string::npos) << made.note;
}

TEST_F(MapExport, ElectronsNeedAGain)
{
  this->RemoveQuantity("/gain", "failed");
  const NoiseExport made = ExportNoise("maps", { NoiseWithMaps() });
  EXPECT_EQ(made.files.size(), 2U);
  EXPECT_NE(made.note.find("no files for PYME and SMAP"), std::string::npos) << made.note;
}

TEST_F(MapExport, AReportWithoutMapsIsRefused)
{
  IsRefused("maps", { "no maps", "--dark", "--maps" });
  CameraNoise noise = NoiseWithMaps();
  noise.maps.readNoiseDn.pop_back();
  EXPECT_THROW(ExportNoise("maps", { noise }), ExportError);
}

// The maps have 3 x 2 pixels, and offsets from 0 to 201 DN.
TEST_F(MapExport, MapsOfOtherFramesAreRefused)
{
  const auto isRefused = [](const CameraNoise & noise, const std::vector<std::string> & parts) {
    try
    {
      ExportNoise("maps", { noise });
      ADD_FAILURE() << "was exported";
    }
    catch (const ExportError & error)
    {
      for (const std::string & part : parts)
      {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << " is not in: " << error.what();
      }
    }
  };
  m_Report.numbers["/width"] = 3;
  m_Report.numbers["/height"] = 2;
  EXPECT_EQ(ExportNoise("maps", { NoiseWithMaps() }).files.size(), 5U);
  m_Report.numbers["/height"] = 3;
  isRefused(NoiseWithMaps(), { "3 x 2 pixels", "report.json have 3 x 3 pixels", "--dark", "--maps" });
  m_Report.numbers["/height"] = 2;
  SetQuantity("/offset", 250.0);
  isRefused(NoiseWithMaps(), { "0 to 201 DN", "offset of 250 DN" });
  m_Report.numbers["/offset/standard_error"] = 20.0;
  EXPECT_NO_THROW(ExportNoise("maps", { NoiseWithMaps() }));
}

// The planes of 3 x 2 pixels have 1 x 1 pixel each: the last column belongs to none.
TEST_F(MapExport, MapsOfAMosaicHaveTwiceTheSizeOfItsPlanes)
{
  MakeMosaic();
  m_Report.numbers["/channels/0/width"] = 1;
  m_Report.numbers["/channels/0/height"] = 1;
  EXPECT_EQ(ExportNoise("maps", { NoiseWithMaps() }).files.size(), 2U);
  m_Report.numbers["/channels/0/width"] = 3;
  m_Report.numbers["/channels/0/height"] = 2;
  EXPECT_THROW(ExportNoise("maps", { NoiseWithMaps() }), ExportError);
}

// The maps are of the pixels of all planes, and the gain of the channel is the gain of one plane.
TEST_F(MapExport, AChannelOfAMosaicHasNoFilesInElectrons)
{
  MakeMosaic();
  ExportSettings settings;
  settings.channel = "G1";
  CameraNoise noise = ReadCameraNoise(m_Report, settings);
  noise.maps = NoiseWithMaps().maps;
  const NoiseExport made = ExportNoise("maps", { noise });
  EXPECT_EQ(made.files.size(), 2U);
  EXPECT_NE(made.note.find("no files for PYME and SMAP"), std::string::npos) << made.note;
}
