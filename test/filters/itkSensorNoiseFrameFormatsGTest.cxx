// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "itkImageIOBase.h"
#include "itkObjectFactoryBase.h"
#include "gtest/gtest.h"

#include <set>
#include <string>

// The table of formats.

namespace
{
using namespace sensornoise;

TEST(FrameFormats, HaveReadersOfITK)
{
  std::set<std::string> readers;
  for (const itk::LightObject::Pointer & object : itk::ObjectFactoryBase::CreateAllInstance("itkImageIOBase"))
  {
    readers.insert(object->GetNameOfClass());
  }
  for (const FrameFormat & format : FrameFormats())
  {
    EXPECT_TRUE(format.imageIO == nullptr || readers.count(format.imageIO) == 1) << format.name;
  }
  EXPECT_EQ(NamesOfFrameFormats(), "camera raw, TIFF, PNG, MetaImage, NRRD, SER, MRAW, FITS, NPY or PGM");
}

TEST(FrameFormats, AreToldByContentsFirst)
{
  EXPECT_STREQ(FindFrameFormat("\x89PNG\r\n\x1A\nIHDR:", "a.mha")->name, "PNG");
  EXPECT_STREQ(FindFrameFormat(std::string("II*\0=", 5), "a.mha")->name, "TIFF");
  EXPECT_STREQ(FindFrameFormat("NRRD0004\ntype: short\n", "a.mha")->name, "NRRD");
  EXPECT_STREQ(FindFrameFormat("ObjectType = Image\n", "a.mha")->name, "MetaImage");
  EXPECT_EQ(FindFrameFormat("ObjectType = Image\n", "a.txt"), nullptr);
  EXPECT_EQ(FindFrameFormat("", "a.mha"), nullptr);
}
} // namespace
