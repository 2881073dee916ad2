// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MatImage_h
#define MatImage_h

#include "itkImage.h"

#include <cstddef>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>

namespace sensornoise::opencv
{

/** Throws std::invalid_argument, which names the frame, unless \a mat has two dimensions and one channel of a pixel
 * type of the filters. */
inline void
RequireRaw(const cv::Mat & mat, const std::string & name)
{
  if (mat.empty() || mat.dims != 2)
  {
    throw std::invalid_argument(name + " holds no image; expected a cv::Mat of two dimensions");
  }
  if (mat.channels() != 1)
  {
    throw std::invalid_argument(name + " has " + std::to_string(mat.channels()) +
                                " channels, so it is not raw; expected one (imread: IMREAD_UNCHANGED, VideoCapture: "
                                "CAP_PROP_CONVERT_RGB off)");
  }
  const int depth = mat.depth();
  if (depth != CV_8U && depth != CV_16U && depth != CV_16S && depth != CV_32F && depth != CV_64F)
  {
    throw std::invalid_argument(name + " is of type " + cv::typeToString(mat.type()) +
                                "; expected 8U, 16U, 16S, 32F or 64F");
  }
}

/** Returns a cv::Mat as an itk::Image of \a TPixel with the same memory, without a copy. The Mat must outlive the
 * image. Throws std::invalid_argument if the types differ, or if there are gaps between the rows. A region of a
 * larger Mat has gaps: use its clone(). */
template <typename TPixel>
typename itk::Image<TPixel, 2>::Pointer
ViewAsImage(cv::Mat & mat)
{
  RequireRaw(mat, "the Mat");
  if (mat.depth() != cv::DataType<TPixel>::depth || !mat.isContinuous())
  {
    throw std::invalid_argument("the Mat is of type " + cv::typeToString(mat.type()) +
                                (mat.isContinuous() ? "" : " and not continuous") + "; expected " +
                                cv::typeToString(cv::DataType<TPixel>::type) + ", continuous");
  }
  using ImageType = itk::Image<TPixel, 2>;
  const auto image = ImageType::New();
  image->SetRegions(typename ImageType::SizeType{
    { static_cast<itk::SizeValueType>(mat.cols), static_cast<itk::SizeValueType>(mat.rows) } });
  image->GetPixelContainer()->SetImportPointer(mat.ptr<TPixel>(), mat.total(), false);
  return image;
}

/** Returns an itk::Image as a cv::Mat with the same memory, without a copy. The image must be up to date and must
 * outlive the Mat. */
template <typename TPixel>
cv::Mat
ViewAsMat(itk::Image<TPixel, 2> & image)
{
  const auto size = image.GetBufferedRegion().GetSize();
  return { static_cast<int>(size[1]), static_cast<int>(size[0]), cv::DataType<TPixel>::type, image.GetBufferPointer() };
}

} // namespace sensornoise::opencv

#endif
