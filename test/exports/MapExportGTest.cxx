// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"
#include "helpers/ExportTestHelper.h"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <string>

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

TEST_F(MapExport, FilesAreTheMapsInTheirUnits)
{
  const NoiseExport made = ExportNoise("maps", { NoiseWithMaps() });
  ASSERT_EQ(made.files.size(), 3U);
  EXPECT_EQ(made.files[0].name, "offset.tif");
  EXPECT_EQ(made.files[1].name, "variance.tif");
  EXPECT_EQ(made.files[2].name, "variance_electrons.tif");
  const auto offsets = ImageOf(made.files[0]);
  const auto variances = ImageOf(made.files[1]);
  const auto electrons = ImageOf(made.files[2]);
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

TEST_F(MapExport, ElectronsNeedAGain)
{
  this->RemoveQuantity("/gain", "failed");
  EXPECT_EQ(ExportNoise("maps", { NoiseWithMaps() }).files.size(), 2U);
}

TEST_F(MapExport, AReportWithoutMapsIsRefused)
{
  IsRefused("maps", { "no maps", "--dark", "--maps" });
  CameraNoise noise = NoiseWithMaps();
  noise.maps.readNoiseDn.pop_back();
  EXPECT_THROW(ExportNoise("maps", { noise }), ExportError);
}
