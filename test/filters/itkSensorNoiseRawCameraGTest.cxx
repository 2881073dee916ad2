/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "itkSensorNoiseFrameFiles.h"
#include "itkSensorNoiseImageIO.h"
#include "itkSensorNoiseImageIOFactory.h"
#include "itkSensorNoiseMetaData.h"
#include "files/FrameFormats.h"
#include "helpers/DngTestHelper.h"
#include "helpers/FrameFileTestHelper.h"
#include "itkImageFileReader.h"
#include "itkImageIOFactory.h"
#include "itkTIFFImageIO.h"
#include "itkTIFFImageIOFactory.h"

#include <list>
#include <string>
#include <vector>

// Raw files of cameras, through the door of frames and through ITK's own reader.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

class RawCameraFrames : public FrameFileTest
{
protected:
  void
  SetUp() override
  {
    FrameFileTest::SetUp();
    m_Factories = itk::ObjectFactoryBase::GetRegisteredFactories();
    for (auto * const factory : m_Factories)
    {
      m_Held.emplace_back(factory);
    }
  }

  /** Restores the object factories. */
  void
  TearDown() override
  {
    itk::ObjectFactoryBase::UnRegisterAllFactories();
    for (const auto & factory : m_Held)
    {
      itk::ObjectFactoryBase::RegisterFactory(factory);
    }
    FrameFileTest::TearDown();
  }

  static std::string
  ReaderOf(const std::string & name)
  {
    const auto io = itk::ImageIOFactory::CreateImageIO(name.c_str(), itk::ImageIOFactory::IOFileModeEnum::ReadMode);
    return io ? io->GetNameOfClass() : "";
  }

private:
  std::list<itk::ObjectFactoryBase *>          m_Factories;
  std::vector<itk::ObjectFactoryBase::Pointer> m_Held;
};

TEST_F(RawCameraFrames, AreNotTakenByTiffInAnyOrderOfRegistration)
{
  DngOf dng = DngOf::Sound();
  dng.isBelow = true; // a preview, which ITK reads
  const std::string file = Write("a.dng", dng.Bytes());
  const std::string renamed = Write("b.tif", dng.Bytes());
  const std::string tiff = Write("c.tif", TiffWith({}).Bytes()); // a TIFF with three pages
  TiffOf            single;
  single.pages.resize(1);
  const std::string page = Write("d.tif", single.Bytes());
  EXPECT_TRUE(itk::TIFFImageIO::New()->CanReadFile(file.c_str()));
  for (const bool isTiffFirst : { true, false })
  {
    itk::ObjectFactoryBase::UnRegisterAllFactories();
    if (isTiffFirst)
    {
      itk::TIFFImageIOFactory::RegisterOneFactory();
    }
    itk::SensorNoiseImageIOFactory::RegisterOneFactory();
    if (!isTiffFirst)
    {
      itk::TIFFImageIOFactory::RegisterOneFactory();
    }
    EXPECT_EQ(ReaderOf(file), "SensorNoiseImageIO") << isTiffFirst;
    EXPECT_EQ(ReaderOf(renamed), "SensorNoiseImageIO") << isTiffFirst;
    EXPECT_EQ(ReaderOf(tiff), "SensorNoiseImageIO") << isTiffFirst;
    EXPECT_EQ(ReaderOf(page), "TIFFImageIO") << isTiffFirst;
  }
}

TEST_F(RawCameraFrames, AreReadByItkWithWhatTheCameraIs)
{
  using ImageType = itk::Image<unsigned short, 2>;
  const DngOf dng = DngOf::Sound(12);
  const auto  reader = itk::ImageFileReader<ImageType>::New();
  itk::SensorNoiseImageIOFactory::RegisterOneFactory();
  reader->SetFileName(Write("a.dng", dng.Bytes()));
  if (!ReadsRawCameraFiles())
  {
    EXPECT_THROW(reader->Update(), itk::ExceptionObject); // not the preview
    return;
  }
  reader->Update();
  const ImageType * const image = reader->GetOutput();
  const auto * const      first = image->GetBufferPointer();
  EXPECT_EQ(image->GetBufferedRegion().GetSize(), (ImageType::SizeType{ { 48, 32 } }));
  EXPECT_EQ(GreyValues(first, first + dng.greyValues.size()), dng.greyValues);
  const CameraSettings camera = CameraSettingsOf(reader->GetMetaDataDictionary());
  EXPECT_EQ(camera.camera, "Maker Model 1");
  EXPECT_EQ(camera.bayerPattern, "RGGB");
  EXPECT_EQ(camera.bitDepth, 12u);
  EXPECT_EQ(camera.blackLevelDn, 64.0);
}

TEST_F(RawCameraFrames, AListOfThemIsFramesInTimeOrder)
{
  if (!ReadsRawCameraFiles())
  {
    GTEST_SKIP() << "built without LibRaw";
  }
  std::vector<std::string> names;
  GreyValues               expected;
  for (unsigned t = 0; t < 3; ++t)
  {
    DngOf dng = DngOf::Sound(14);
    dng.isJpeg = t > 0;
    dng.greyValues[5] = 77 + t;
    names.push_back(Write("f" + std::to_string(t) + ".dng", dng.Bytes()));
    expected.insert(expected.end(), dng.greyValues.begin(), dng.greyValues.end());
  }
  const FrameList list = OpenFrames(names);
  EXPECT_EQ(list.frames, 3u);
  EXPECT_EQ(list.camera.bayerPattern, "RGGB");
  std::vector<unsigned short> greyValues(expected.size());
  ReadFrames(list, 0, 3, greyValues.data());
  EXPECT_EQ(GreyValues(greyValues.begin(), greyValues.end()), expected);
}

// Cut anywhere, none is taken for a whole one.
TEST_F(RawCameraFrames, TruncatedAnywhereAreRefused)
{
  std::vector<DngOf> all{ DngOf::Sound(16), DngOf::Sound(12), DngOf::Sound(14), DngOf::Sound(14), DngOf::Sound(12) };
  all[3].isJpeg = true;
  all[4].isJpeg = true;
  all[4].tile = 32;
  for (const DngOf & dng : all)
  {
    const std::string whole = dng.Bytes();
    for (std::size_t size = 1; size < whole.size(); size += 31)
    {
      EXPECT_NE(SaidOf("a.dng", whole.substr(0, size)), "") << size;
    }
  }
}
} // namespace
