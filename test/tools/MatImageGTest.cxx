// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifdef SENSORNOISE_OPENCV
#  include "opencv/MatImage.h"
#  include "opencv/MatStackSource.h"

#  include <cstdint>
#  include <gtest/gtest.h>
#  include <stdexcept>
#  include <vector>

namespace
{
using namespace sensornoise::opencv;

template <typename TPixel>
void
SharesMemory()
{
  cv::Mat mat(3, 5, cv::DataType<TPixel>::type, cv::Scalar(7));
  mat.at<TPixel>(2, 4) = TPixel{ 9 };
  const auto image = ViewAsImage<TPixel>(mat);
  EXPECT_EQ(image->GetBufferPointer(), mat.ptr<TPixel>());
  EXPECT_EQ(image->GetPixel({ { 4, 2 } }), TPixel{ 9 });
  image->SetPixel({ { 0, 1 } }, TPixel{ 11 });
  EXPECT_EQ(mat.at<TPixel>(1, 0), TPixel{ 11 });
  const cv::Mat back = ViewAsMat(*image);
  EXPECT_EQ(back.data, mat.data);
  EXPECT_EQ(back.size(), mat.size());
}

/** Fills the frames with the values 100 t + 10 y + x. */
void
Fill(std::vector<cv::Mat> & frames)
{
  for (std::size_t t = 0; t < frames.size(); ++t)
  {
    for (int y = 0; y < frames[t].rows; ++y)
    {
      for (int x = 0; x < frames[t].cols; ++x)
      {
        frames[t].at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(100 * t + 10 * y + x);
      }
    }
  }
}

itk::Image<unsigned short, 3>::Pointer
StackOf(const std::vector<cv::Mat> & frames, std::size_t first, std::size_t count)
{
  const auto source = MatStackSource<unsigned short>::New();
  source->SetFrames(frames);
  source->UpdateOutputInformation();
  auto region = source->GetOutput()->GetLargestPossibleRegion();
  region.SetIndex(2, static_cast<itk::IndexValueType>(first));
  region.SetSize(2, count);
  source->GetOutput()->SetRequestedRegion(region);
  source->Update();
  const itk::Image<unsigned short, 3>::Pointer stack = source->GetOutput();
  stack->DisconnectPipeline();
  for (std::size_t t = first; t < first + count; ++t)
  {
    EXPECT_EQ(stack->GetPixel({ { 4, 2, static_cast<itk::IndexValueType>(t) } }), 100 * t + 24);
    EXPECT_EQ(stack->GetPixel({ { 1, 1, static_cast<itk::IndexValueType>(t) } }), 100 * t + 11);
  }
  return stack;
}
} // namespace

TEST(MatImage, SharesMemoryOfEveryType)
{
  SharesMemory<unsigned char>();
  SharesMemory<unsigned short>();
  SharesMemory<short>();
  SharesMemory<float>();
  SharesMemory<double>();
}

TEST(MatImage, RefusesWhatItCannotView)
{
  cv::Mat colour(3, 5, CV_8UC3);
  EXPECT_THROW(ViewAsImage<unsigned char>(colour), std::invalid_argument);
  cv::Mat mat(3, 5, CV_16UC1);
  EXPECT_THROW(ViewAsImage<short>(mat), std::invalid_argument);
  cv::Mat part = mat.colRange(1, 3);
  EXPECT_THROW(ViewAsImage<unsigned short>(part), std::invalid_argument);
  cv::Mat integers(3, 5, CV_32SC1);
  EXPECT_THROW(RequireRaw(integers, "frame"), std::invalid_argument);
  cv::Mat empty;
  EXPECT_THROW(RequireRaw(empty, "frame"), std::invalid_argument);
}

TEST(MatStackSource, PlanesOfOneMatAreNotCopied)
{
  cv::Mat              whole(4 * 3, 5, CV_16UC1);
  std::vector<cv::Mat> frames;
  for (int t = 0; t < 4; ++t)
  {
    frames.push_back(whole.rowRange(3 * t, 3 * t + 3));
  }
  Fill(frames);
  EXPECT_EQ(StackOf(frames, 0, 4)->GetBufferPointer(), whole.ptr<unsigned short>());
  EXPECT_EQ(StackOf(frames, 2, 2)->GetBufferPointer(), whole.ptr<unsigned short>(6));
}

TEST(MatStackSource, OtherFramesAreCopied)
{
  cv::Mat              whole(3, 10, CV_16UC1);
  std::vector<cv::Mat> frames{ whole.colRange(0, 5), whole.colRange(5, 10), cv::Mat(3, 5, CV_16UC1) };
  Fill(frames);
  EXPECT_NE(StackOf(frames, 0, 3)->GetBufferPointer(), whole.ptr<unsigned short>());
  StackOf(frames, 1, 1);
  frames.emplace_back(3, 6, CV_16UC1);
  EXPECT_THROW(StackOf(frames, 0, 1), std::invalid_argument);
  EXPECT_THROW(StackOf({}, 0, 1), itk::ExceptionObject);
}
#endif
