// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkBayerPlaneImageFilter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkStreamingImageFilter.h"
#include "helpers/PipelineTestHelper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace
{
template <typename TImage>
class BayerPlaneImageFilterOf : public ::testing::Test
{};
using ImageTypes = ::testing::Types<itk::Image<unsigned char, 2>,
                                    itk::Image<unsigned short, 2>,
                                    itk::Image<short, 3>,
                                    itk::Image<float, 3>,
                                    itk::Image<double, 3>>;
TYPED_TEST_SUITE(BayerPlaneImageFilterOf, ImageTypes, );

/** Returns a mosaic whose pixels have the values x + 7 y + 3 t, by their positions. Its region does not begin at 0. */
template <typename TImage>
typename TImage::Pointer
MakeMosaic()
{
  typename TImage::RegionType  region;
  typename TImage::SpacingType spacing;
  typename TImage::PointType   origin;
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    region.SetIndex(axis, 3 - static_cast<int>(axis));
    region.SetSize(axis, axis == 2 ? 4 : 9 - axis);
    spacing[axis] = 0.5 + axis;
    origin[axis] = 10.0 * axis;
  }
  auto image = TImage::New();
  image->SetRegions(region);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<TImage> it(image, region); !it.IsAtEnd(); ++it)
  {
    double value = 0.0;
    for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
    {
      value += std::array<double, 3>{ { 1.0, 7.0, 3.0 } }.at(axis) * static_cast<double>(it.GetIndex()[axis]);
    }
    it.Set(static_cast<typename TImage::PixelType>(value));
  }
  return image;
}
} // namespace

TYPED_TEST(BayerPlaneImageFilterOf, EveryPixelStandsWhereItWas)
{
  const auto                                 mosaic = MakeMosaic<TypeParam>();
  std::vector<typename TypeParam::IndexType> seen;
  for (const char * pattern : { "RGGB", "GRBG", "GBRG", "BGGR" })
  {
    std::size_t pixels = 0;
    for (const char * plane : { "R", "G1", "G2", "B" })
    {
      const auto filter = itk::BayerPlaneImageFilter<TypeParam>::New();
      filter->SetInput(mosaic);
      filter->SetPattern(pattern);
      filter->SetPlane(plane);
      filter->Update();
      const TypeParam * const output = filter->GetOutput();
      const auto              region = output->GetLargestPossibleRegion();
      EXPECT_EQ(region.GetSize(0), 4U);
      EXPECT_EQ(region.GetSize(1), 4U);
      EXPECT_EQ(region.GetIndex(0), 0);
      for (itk::ImageRegionConstIteratorWithIndex<TypeParam> it(output, region); !it.IsAtEnd(); ++it)
      {
        typename TypeParam::PointType point;
        typename TypeParam::IndexType index;
        output->TransformIndexToPhysicalPoint(it.GetIndex(), point);
        ASSERT_TRUE(mosaic->TransformPhysicalPointToIndex(point, index));
        ASSERT_EQ(it.Get(), mosaic->GetPixel(index));
        // The letter of the pattern at that place is the plane's.
        const auto start = mosaic->GetLargestPossibleRegion().GetIndex();
        const auto column = static_cast<std::size_t>(index[0] - start[0]) % 2;
        const auto row = static_cast<std::size_t>(index[1] - start[1]) % 2;
        ASSERT_EQ(pattern[2 * row + column], plane[0]);
        ++pixels;
      }
    }
    EXPECT_EQ(pixels, 4 * 16 * (TypeParam::ImageDimension == 3 ? 4U : 1U)); // the ninth column is in none
  }
}

TEST(BayerPlaneImageFilter, AsksForWhatItNeedsOnly)
{
  using Stack = itk::Image<short, 3>;
  const auto reader = sensornoisetest::StackReader<Stack>::Of(MakeMosaic<Stack>());
  const auto filter = itk::BayerPlaneImageFilter<Stack>::New();
  filter->SetInput(reader->GetOutput());
  filter->SetPlane("B");
  const auto streamer = itk::StreamingImageFilter<Stack, Stack>::New();
  streamer->SetInput(filter->GetOutput());
  streamer->SetNumberOfStreamDivisions(4);
  streamer->Update();
  EXPECT_EQ(reader->Reads(), 4U);
  EXPECT_EQ(reader->WholeReads(), 0U);
  const auto whole = itk::BayerPlaneImageFilter<Stack>::New();
  whole->SetInput(MakeMosaic<Stack>());
  whole->SetPlane("B");
  whole->Update();
  const std::size_t pixels = whole->GetOutput()->GetLargestPossibleRegion().GetNumberOfPixels();
  EXPECT_TRUE(std::equal(whole->GetOutput()->GetBufferPointer(),
                         whole->GetOutput()->GetBufferPointer() + pixels,
                         streamer->GetOutput()->GetBufferPointer()));
}

TEST(BayerPlaneImageFilter, WrongNamesAndTinyMosaicsAreRefused)
{
  using Frame = itk::Image<unsigned short, 2>;
  const auto filter = itk::BayerPlaneImageFilter<Frame>::New();
  EXPECT_EQ(filter->GetPattern(), "RGGB");
  EXPECT_EQ(filter->GetPlane(), "R");
  EXPECT_THROW(filter->SetPattern("RGBG"), itk::ExceptionObject);
  EXPECT_THROW(filter->SetPlane("G"), itk::ExceptionObject);
  const auto image = Frame::New();
  image->SetRegions(Frame::SizeType{ { 1, 8 } });
  image->Allocate();
  filter->SetInput(image);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
}
