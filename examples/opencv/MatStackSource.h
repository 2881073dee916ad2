// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MatStackSource_h
#define MatStackSource_h

#include "opencv/MatImage.h"

#include "itkImage.h"
#include "itkImageSource.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise::opencv
{

/** \class MatStackSource
 * Source of a stack, an itk::Image whose last axis is time, from a vector of cv::Mat. Frames that are contiguous in
 * memory, such as planes of one Mat, are not copied. Other frames are copied one chunk at a time, when a filter
 * requests them.
 */
template <typename TPixel>
class MatStackSource : public itk::ImageSource<itk::Image<TPixel, 3>>
{
public:
  using Self = MatStackSource;
  using Superclass = itk::ImageSource<itk::Image<TPixel, 3>>;
  using Pointer = itk::SmartPointer<Self>;
  using StackType = itk::Image<TPixel, 3>;

  itkNewMacro(Self);

  /** Sets the frames. Mats share memory, so nothing is copied here. Throws std::invalid_argument unless all frames
   * have one channel of \a TPixel and the same size. */
  void
  SetFrames(std::vector<cv::Mat> frames)
  {
    for (std::size_t t = 0; t < frames.size(); ++t)
    {
      const std::string name = "frame " + std::to_string(t);
      RequireRaw(frames[t], name);
      if (frames[t].type() != cv::DataType<TPixel>::type || frames[t].size() != frames[0].size())
      {
        throw std::invalid_argument(name + " is " + Describe(frames[t]) + "; expected " + Describe(frames[0]) +
                                    " as the first");
      }
    }
    m_Frames = std::move(frames);
    this->Modified();
  }

protected:
  void
  GenerateOutputInformation() override
  {
    if (m_Frames.empty())
    {
      itkExceptionMacro("there is no frame; expected at least one cv::Mat");
    }
    const auto number = [](auto value) { return static_cast<itk::SizeValueType>(value); };
    this->GetOutput()->SetLargestPossibleRegion(
      typename StackType::SizeType{ { number(m_Frames[0].cols), number(m_Frames[0].rows), number(m_Frames.size()) } });
  }

  /** Enlarges the requested region to whole frames. */
  void
  EnlargeOutputRequestedRegion(itk::DataObject * data) override
  {
    auto * const stack = static_cast<StackType *>(data);
    auto         region = stack->GetLargestPossibleRegion();
    region.SetIndex(2, stack->GetRequestedRegion().GetIndex(2));
    region.SetSize(2, stack->GetRequestedRegion().GetSize(2));
    stack->SetRequestedRegion(region);
  }

  void
  GenerateData() override
  {
    StackType * const stack = this->GetOutput();
    const auto        region = stack->GetRequestedRegion();
    const auto        first = static_cast<std::size_t>(region.GetIndex(2));
    const auto        count = static_cast<std::size_t>(region.GetSize(2));
    stack->SetBufferedRegion(region);
    const auto container = StackType::PixelContainer::New();
    stack->SetPixelContainer(container);
    if (LieTogether(first, count))
    {
      container->SetImportPointer(m_Frames[first].ptr<TPixel>(), count * m_Frames[0].total(), false);
      return;
    }
    container->Reserve(count * m_Frames[0].total());
    TPixel * pixel = container->GetBufferPointer();
    for (std::size_t t = first; t < first + count; ++t)
    {
      for (int y = 0; y < m_Frames[t].rows; ++y)
      {
        pixel = std::copy_n(m_Frames[t].ptr<TPixel>(y), m_Frames[t].cols, pixel);
      }
    }
  }

private:
  static std::string
  Describe(const cv::Mat & mat)
  {
    return std::to_string(mat.cols) + " x " + std::to_string(mat.rows) + " pixels of " + cv::typeToString(mat.type());
  }

  bool
  LieTogether(std::size_t first, std::size_t count)
  {
    for (std::size_t t = first; t < first + count; ++t)
    {
      if (!m_Frames[t].isContinuous() ||
          m_Frames[t].ptr<TPixel>() != m_Frames[first].ptr<TPixel>() + (t - first) * m_Frames[t].total())
      {
        return false;
      }
    }
    return true;
  }

  std::vector<cv::Mat> m_Frames;
};

} // namespace sensornoise::opencv

#endif
