// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/BurstFilesTestHelper.h"
#include "helpers/FrameFilesTestHelper.h"
#include "helpers/TiffTestHelper.h"
#include "sensornoise/FrameFile.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

// Integers of 32 bits are read as double, exactly, in every format that has them.

namespace
{
using namespace sensornoisetest::files;

class SensorNoiseStoredNumbers : public FrameFilesTest
{
protected:
  std::vector<double>
  ReadAll(const std::string & name, const std::string & rawLayout = {}) const
  {
    const FrameList list = OpenFrames({ name }, {}, rawLayout);
    EXPECT_EQ(sensornoise::NameOf(list.pixel), "double") << name;
    std::vector<double> pixels(list.width * list.height * list.frames);
    sensornoise::ReadFrames(list, 0, list.frames, pixels.data());
    return pixels;
  }

  template <typename TStored>
  static std::vector<double>
  Expected()
  {
    std::vector<double> pixels;
    for (std::size_t i = 0; i < width * height * frames; ++i)
    {
      pixels.push_back(static_cast<double>(NumberAt<TStored>(i)));
    }
    return pixels;
  }

  /** The extremes of the type, then small numbers of both signs. */
  template <typename TStored>
  static TStored
  NumberAt(std::size_t i)
  {
    return i == 0   ? std::numeric_limits<TStored>::max()
           : i == 1 ? std::numeric_limits<TStored>::min()
                    : static_cast<TStored>(i * 1000003);
  }

  template <typename TStored>
  std::string
  WriteNumbers(const std::string & name, bool compress = false) const
  {
    using ImageType = itk::Image<TStored, 3>;
    const auto image = ImageType::New();
    image->SetRegions(itk::Size<3>{ { width, height, frames } });
    image->Allocate();
    for (std::size_t i = 0; i < width * height * frames; ++i)
    {
      image->GetBufferPointer()[i] = NumberAt<TStored>(i);
    }
    const auto writer = itk::ImageFileWriter<ImageType>::New();
    writer->SetFileName(Path(name));
    writer->SetUseCompression(compress);
    writer->SetInput(image);
    writer->Update();
    return Path(name);
  }

  template <typename TStored>
  static std::string
  Bytes(bool isBigEndian)
  {
    std::string bytes;
    for (std::size_t i = 0; i < width * height * frames; ++i)
    {
      sensornoise::test::AppendNumber(bytes, static_cast<std::uint32_t>(NumberAt<TStored>(i)), 4, isBigEndian);
    }
    return bytes;
  }
};

TEST_F(SensorNoiseStoredNumbers, OfMetaImageAndNrrdAreExact)
{
  for (const std::string extension : { ".mha", ".nrrd" })
  {
    for (const bool compress : { false, true })
    {
      EXPECT_EQ(ReadAll(WriteNumbers<unsigned int>("u" + extension, compress)), Expected<std::uint32_t>()) << extension;
      EXPECT_EQ(ReadAll(WriteNumbers<int>("i" + extension, compress)), Expected<std::int32_t>()) << extension;
    }
  }
}

TEST_F(SensorNoiseStoredNumbers, AreReadAFewFramesAtATime)
{
  const std::string   name = WriteNumbers<int>("i.mha");
  const FrameList     list = OpenFrames({ name });
  std::vector<double> pixels(width * height * 2);
  sensornoise::ReadFrames(list, 1, 2, pixels.data());
  const std::vector<double> all = Expected<std::int32_t>();
  const auto                first = all.begin() + static_cast<std::ptrdiff_t>(width * height);
  EXPECT_EQ(pixels, std::vector<double>(first, first + static_cast<std::ptrdiff_t>(pixels.size())));
}

TEST_F(SensorNoiseStoredNumbers, WithoutAHeaderAreExact)
{
  for (const bool isBigEndian : { false, true })
  {
    const std::string end = isBigEndian ? "be" : "le";
    EXPECT_EQ(ReadAll(WriteText("u.raw", Bytes<std::uint32_t>(isBigEndian)), "7x5:uint32" + end),
              Expected<std::uint32_t>());
    EXPECT_EQ(ReadAll(WriteText("i.raw", "a" + Bytes<std::int32_t>(isBigEndian)), "7x5:int32" + end + ":1"),
              Expected<std::int32_t>());
    EXPECT_EQ(ReadAll(WriteText("i.raw", Bytes<std::int32_t>(isBigEndian)), "7x5:int32" + end + ":0:28"),
              Expected<std::int32_t>());
  }
}

TEST_F(SensorNoiseStoredNumbers, OfTiffAreExact)
{
  for (const bool isBigEndian : { false, true })
  {
    for (const unsigned compression : { 1u, 5u, 8u, 32773u })
    {
      for (const unsigned bits : { 32u, 64u })
      {
        for (const unsigned predictor : { 1u, 2u })
        {
          if (predictor == 2 && (compression == 1 || compression == 32773))
          {
            continue;
          }
          sensornoise::test::TiffOf tiff =
            sensornoise::test::TiffWith({ { 317, { 3, { predictor } } }, { 339, { 3, { bits == 64 ? 3u : 2u } } } });
          tiff.isBigEndian = isBigEndian;
          tiff.compression = compression;
          tiff.predictor = predictor;
          tiff.bits = bits;
          const std::vector<double> pixels = ReadAll(WriteText("a.tif", tiff.Bytes()));
          ASSERT_EQ(pixels.size(), 13u * 9u * 3u);
          if (bits == 32)
          {
            EXPECT_EQ(pixels[0], 100.0);
            EXPECT_EQ(pixels[2 * 117 + 8 * 13 + 12], 100.0 + 12 * 8 + 6);
          }
        }
      }
    }
  }
}

TEST_F(SensorNoiseStoredNumbers, OfSixtyFourBitsAreRefusedByName)
{
  const std::string header = "NRRD0004\ndimension: 3\nsizes: 1 1 2\nendian: little\nencoding: raw\ntype: ";
  OpeningIsRefusedWith({ WriteText("a.nrrd", header + "uint64\n\n" + std::string(16, 'a')) },
                       { "component type unsigned long long is not supported; expected", "unsigned int" });
  sensornoise::test::TiffOf tiff;
  tiff.bits = 64;
  OpeningIsRefusedWith({ WriteText("a.tif", tiff.Bytes()) }, { "64-bit unsigned samples, which are not supported" });
  try
  {
    OpenFrames({ WriteText("a.raw", std::string(16, 'a')) }, {}, "1x1:uint64le");
    ADD_FAILURE();
  }
  catch (const std::exception & error)
  {
    EXPECT_NE(std::string(error.what()).find("integers of 64 bits (uint64le) are not supported"), std::string::npos)
      << error.what();
  }
}

} // namespace
