// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkSensorNoiseImageIO.h"
#include "itkSensorNoiseImageIOFactory.h"
#include "itkSensorNoiseMetaData.h"
#include "helpers/BurstFilesTestHelper.h"
#include "helpers/FrameFilesTestHelper.h"
#include "helpers/TiffTestHelper.h"
#include "itkImageFileReader.h"
#include "itkImageIOFactory.h"
#include "itkTIFFImageIO.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

// Bursts of cameras: through the source, and through ITK's own reader.

namespace
{
using namespace sensornoisetest::files;
using namespace sensornoise::test;
using StackType = itk::Image<unsigned short, 3>;

/** Returns the grey values that FrameFilesTest writes, without the bytes behind a frame. */
GreyValues
GreyValuesOfStack(std::size_t columns)
{
  GreyValues greyValues;
  for (std::size_t t = 0; t < frames; ++t)
  {
    for (std::size_t y = 0; y < height; ++y)
    {
      for (std::size_t x = 0; x < columns; ++x)
      {
        greyValues.push_back(static_cast<unsigned int>(1 + x + columns * (y + height * t)));
      }
    }
  }
  return greyValues;
}

GreyValues
GreyValuesOf(const StackType * image)
{
  const unsigned short * const first = image->GetBufferPointer();
  return { first, first + image->GetBufferedRegion().GetNumberOfPixels() };
}

class SensorNoiseImageIO : public FrameFilesTest
{
protected:
  std::string
  WriteSer(const std::string & name) const
  {
    SerOf ser;
    ser.width = width;
    ser.height = height;
    ser.frames = frames;
    ser.color = 9;
    ser.pixels = BytesOfGreyValues(GreyValuesOfStack(width), 2);
    return WriteText(name, ser.Bytes());
  }

  /** Writes frames of 8 columns, because pairs of pixels are packed. */
  std::string
  WriteMraw(const std::string & name) const
  {
    WriteText(name + ".mraw", BitStream(GreyValuesOfStack(8), 12, true));
    return WriteText(name + ".cihx", CihxOf{}.Bytes());
  }

  /** Returns the stack as ITK's TIFFImageIO reads it: whole. */
  static StackType::Pointer
  ReadByItk(const std::string & file)
  {
    const auto reader = itk::ImageFileReader<StackType>::New();
    reader->SetFileName(file);
    reader->SetImageIO(itk::TIFFImageIO::New());
    reader->Update();
    return reader->GetOutput();
  }
};

TEST_F(SensorNoiseImageIO, EachFormatStreamsThroughTheSource)
{
  ReadsWhatWasWritten<unsigned short>({ WriteSer("a.ser") }, true);
  for (const std::string & file : { WriteMraw("a"), Path("a.mraw") })
  {
    for (std::size_t first = 0; first < frames; ++first)
    {
      const auto source = MakeSource<unsigned short>({ file });
      const auto image = ReadPart<unsigned short>(source, first, 1);
      const auto all = GreyValuesOfStack(8);
      const auto size = static_cast<std::ptrdiff_t>(8 * height);
      EXPECT_EQ(GreyValuesOf(image),
                GreyValues(all.begin() + static_cast<std::ptrdiff_t>(first) * size,
                           all.begin() + static_cast<std::ptrdiff_t>(first + 1) * size));
    }
  }
}

TEST_F(SensorNoiseImageIO, RawFramesAreReadAsAStackAndAsAList)
{
  const std::string stack = WriteText("s.raw", "head" + BytesOfGreyValues(GreyValuesOfStack(width), 2));
  const auto        source = MakeSource<unsigned short>({ stack });
  ExpectParts(MessageOf([&] { source->Update(); }), { "s.raw", "no image in a format that can be checked" });
  source->SetRawLayout("7x5:uint16le:4");
  source->Update();
  EXPECT_EQ(GreyValuesOf(source->GetOutput()), GreyValuesOfStack(width));
  EXPECT_TRUE(source->CanStream());
  source->SetRawLayout("7x5:uint16:4");
  ExpectParts(MessageOf([&] { source->Update(); }), { "does not say which byte comes first" });
  std::vector<std::string> files;
  const GreyValues         greyValues = GreyValuesOfStack(width);
  for (std::size_t t = 0; t < frames; ++t)
  {
    const auto first = greyValues.begin() + static_cast<std::ptrdiff_t>(t * width * height);
    files.push_back(
      WriteText("f" + std::to_string(t),
                BytesOfGreyValues(GreyValues(first, first + static_cast<std::ptrdiff_t>(width * height)), 2)));
  }
  const auto list = MakeSource<unsigned short>(files);
  list->SetRawLayout("7x5:uint16le");
  list->Update();
  EXPECT_EQ(GreyValuesOf(list->GetOutput()), greyValues);
  WriteText("f2", "short");
  const auto changed = MakeSource<unsigned short>(files);
  changed->SetRawLayout("7x5:uint16le");
  ExpectParts(MessageOf([&] { changed->Update(); }), { "f2", "5 bytes of pixels, at 70 bytes a frame" });
}

TEST_F(SensorNoiseImageIO, WhatTheFileSaysOfTheCameraIsInTheDictionary)
{
  const auto ser = MakeSource<unsigned short>({ WriteSer("a.ser") });
  ser->UpdateOutputInformation();
  const auto & said = ser->GetOutput()->GetMetaDataDictionary();
  const auto   camera = sensornoise::CameraSettingsOf(said);
  EXPECT_EQ(camera.bayerPattern, "GRBG");
  EXPECT_EQ(camera.bitDepth, 12u);
  EXPECT_EQ(camera.camera, "A camera");
  EXPECT_TRUE(std::isnan(camera.exposureSeconds));
  EXPECT_FALSE(said.HasKey("SensorNoise.IsoSpeed"));
  EXPECT_TRUE(said.HasKey("SensorNoise.BayerPattern"));
  ser->SetFileNames({ WriteMraw("a") });
  ser->UpdateOutputInformation();
  const auto other = sensornoise::CameraSettingsOf(ser->GetOutput()->GetMetaDataDictionary());
  EXPECT_EQ(other.bayerPattern, "");
  EXPECT_FALSE(ser->GetOutput()->GetMetaDataDictionary().HasKey("SensorNoise.BayerPattern"));
  EXPECT_DOUBLE_EQ(other.exposureSeconds, 1.0 / 5000.0);
}

TEST_F(SensorNoiseImageIO, APixelOfATiffIsAsStored)
{
  for (const unsigned compression : { 1U, 5U, 8U, 32773U })
  {
    for (const bool isBigEndian : { false, true })
    {
      const auto write = [&](const std::string & name, unsigned photometric) {
        TiffOf tiff = TiffWith({ { 274, { 3, { 1 } } },
                                 { 282, { 5, { 300 + (std::uint64_t{ 7 } << 32) } } },
                                 { 283, { 5, { 100 + (std::uint64_t{ 3 } << 32) } } },
                                 { 296, { 3, { 3 } } },
                                 { 262, { 3, { photometric } } } });
        tiff.compression = compression;
        tiff.isBigEndian = isBigEndian;
        return WriteText(name, tiff.Bytes());
      };
      // Whether 0 is black or white is for a display. Where 0 is white, ITK 6 inverts the values.
      const StackType::Pointer expected = ReadByItk(write("black.tif", 1));
      for (const unsigned photometric : { 0U, 1U })
      {
        const std::string file = write("a.tif", photometric);
        const auto        source = MakeSource<unsigned short>({ file });
        source->Update();
        EXPECT_EQ(GreyValuesOf(source->GetOutput()), GreyValuesOf(expected))
          << compression << isBigEndian << photometric;
        EXPECT_EQ(source->GetOutput()->GetSpacing(), expected->GetSpacing());
        const GreyValues all = GreyValuesOf(expected);
        for (std::size_t first = 0; first < 3; ++first)
        {
          const auto part = MakeSource<unsigned short>({ file });
          const auto size = static_cast<std::ptrdiff_t>(all.size() / 3);
          const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first) * size;
          EXPECT_EQ(GreyValuesOf(ReadPart<unsigned short>(part, first, 1)), GreyValues(begin, begin + size));
        }
      }
    }
  }
}

/** Expects the same bytes of a stack from this source and from ITK's TIFFImageIO. */
template <typename TPixel>
void
IsReadAsByItk(const std::string & file)
{
  using ImageType = itk::Image<TPixel, 3>;
  const auto reader = itk::ImageFileReader<ImageType>::New();
  reader->SetFileName(file);
  reader->SetImageIO(itk::TIFFImageIO::New());
  reader->Update();
  const auto source = MakeSource<TPixel>({ file });
  source->Update();
  const std::size_t pixels = reader->GetOutput()->GetBufferedRegion().GetNumberOfPixels();
  ASSERT_EQ(source->GetOutput()->GetBufferedRegion().GetNumberOfPixels(), pixels);
  EXPECT_EQ(std::memcmp(source->GetOutput()->GetBufferPointer(),
                        reader->GetOutput()->GetBufferPointer(),
                        pixels * sizeof(TPixel)),
            0);
}

TEST_F(SensorNoiseImageIO, PredictorsOfATiffAreUndoneAsItksReaderDoes)
{
  for (const unsigned predictor : { 2U, 3U })
  {
    for (const unsigned bits : { 8U, 16U, 32U })
    {
      for (const unsigned compression : { 5U, 8U })
      {
        for (const bool isBigEndian : { false, true })
        {
          if (predictor == 3 && bits != 32)
          {
            continue;
          }
          SCOPED_TRACE(std::to_string(predictor) + " " + std::to_string(bits) + " " + std::to_string(compression) +
                       (isBigEndian ? " big" : " little"));
          TiffOf tiff = TiffWith({ { 317, { 3, { predictor } } }, { 339, { 3, { bits == 32 ? 3U : 1U } } } });
          tiff.bits = bits;
          tiff.predictor = predictor;
          tiff.compression = compression;
          tiff.isBigEndian = isBigEndian;
          tiff.width = 300; // enough for codes of more than nine bits
          tiff.fillUp = 3;
          const std::string file = WriteText("a.tif", tiff.Bytes());
          if (bits == 8)
          {
            IsReadAsByItk<unsigned char>(file);
          }
          else if (bits == 16)
          {
            IsReadAsByItk<unsigned short>(file);
          }
          else
          {
            IsReadAsByItk<float>(file);
          }
        }
      }
    }
  }
}

// ITK's reader, which a user constructs, gives the same pixels for the same files.
TEST_F(SensorNoiseImageIO, IsFoundByItksReaderAndStreams)
{
  itk::SensorNoiseImageIOFactory::RegisterOneFactory();
  itk::SensorNoiseImageIOFactory::RegisterOneFactory();
  const std::string tiff = WriteStack<unsigned short>("s.tif");
  for (const std::string & file : { WriteSer("a.ser"), tiff, WriteMraw("a") })
  {
    const auto io = itk::ImageIOFactory::CreateImageIO(file.c_str(), itk::ImageIOFactory::IOFileModeEnum::ReadMode);
    ASSERT_NE(io, nullptr) << file;
    EXPECT_STREQ(io->GetNameOfClass(), "SensorNoiseImageIO") << file;
    const auto reader = itk::ImageFileReader<StackType>::New();
    reader->SetFileName(file);
    reader->UpdateOutputInformation();
    itk::ImageRegion<3> region = reader->GetOutput()->GetLargestPossibleRegion();
    const std::size_t   columns = region.GetSize(0);
    EXPECT_EQ(region.GetSize(2), frames);
    region.SetIndex({ { 2, 1, 1 } });
    region.SetSize({ { 3, 2, 2 } });
    reader->GetOutput()->SetRequestedRegion(region);
    reader->GetOutput()->Update();
    EXPECT_EQ(reader->GetOutput()->GetBufferedRegion().GetSize(2), 2u) << file;
    EXPECT_EQ(reader->GetOutput()->GetPixel({ { 3, 2, 2 } }), 1 + 3 + columns * (2 + height * 2)) << file;
  }
  const auto ofOne = itk::ImageIOFactory::CreateImageIO(WriteFrame<unsigned short>("f.tif").c_str(),
                                                        itk::ImageIOFactory::IOFileModeEnum::ReadMode);
  EXPECT_STREQ(ofOne->GetNameOfClass(), "TIFFImageIO");
  CutOff(tiff, 1);
  const auto ofDamaged =
    itk::ImageIOFactory::CreateImageIO(tiff.c_str(), itk::ImageIOFactory::IOFileModeEnum::ReadMode);
  EXPECT_TRUE(!ofDamaged || ofDamaged->GetNameOfClass() != std::string("SensorNoiseImageIO"));
  for (itk::ObjectFactoryBase * const factory : itk::ObjectFactoryBase::GetRegisteredFactories())
  {
    if (dynamic_cast<itk::SensorNoiseImageIOFactory *>(factory) != nullptr)
    {
      itk::ObjectFactoryBase::UnRegisterFactory(factory);
      break;
    }
  }
}

TEST_F(SensorNoiseImageIO, ReadsRawFramesWithALayout)
{
  const auto io = itk::SensorNoiseImageIO::New();
  const auto file = WriteText("a.bin", BytesOfGreyValues(GreyValuesOfStack(width), 2));
  EXPECT_FALSE(io->CanReadFile(file.c_str()));
  io->SetRawLayout("7x5:uint16le");
  EXPECT_TRUE(io->CanReadFile(file.c_str()));
  EXPECT_FALSE(io->CanWriteFile(file.c_str()));
  const auto reader = itk::ImageFileReader<StackType>::New();
  reader->SetFileName(file);
  reader->SetImageIO(io);
  reader->Update();
  EXPECT_EQ(GreyValuesOf(reader->GetOutput()), GreyValuesOfStack(width));
  EXPECT_NE(MessageOf([&] { io->Write(nullptr); }).find("this class writes no files"), std::string::npos);
  std::ostringstream text;
  io->Print(text);
  EXPECT_NE(text.str().find("RawLayout: 7x5:uint16le"), std::string::npos);
}

TEST_F(SensorNoiseImageIO, AFileThatHasChangedIsAnError)
{
  const std::string file = WriteSer("a.ser");
  const FrameList   list = OpenFrames({ file });
  CutOff(file, 1);
  ExpectParts(ErrorOfReading<unsigned short>(list), { "a.ser", "has changed since it was opened" });
  const FrameList mraw = OpenFrames({ WriteMraw("a") });
  CutOff(Path("a.mraw"), 1);
  ExpectParts(ErrorOfReading<unsigned short>(mraw), { "a.cihx", "its data file", "has changed" });
}
} // namespace
