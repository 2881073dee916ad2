// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_EstimateToolTestHelper_h
#define sensornoise_test_EstimateToolTestHelper_h

#include "helpers/CheckoutTestHelper.h"
#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

/** Runs estimate-sensor-noise in an empty folder of its own, on files that the test has made there. */
class EstimateToolTest : public ::testing::Test
{
protected:
  using StackType = itk::Image<unsigned short, 3>;

  void
  SetUp() override;
  void
  TearDown() override;

  std::filesystem::path
  Path(const std::string & name) const
  {
    return m_Folder / "work" / name;
  }

  /** Runs a command in the folder. Returns its exit code, and sets m_Output and m_Message. */
  int
  RunCommand(const std::string & command);
  int
  Run(const std::string & arguments);
  /** Runs export-noise-model, as RunCommand(). */
  int
  Export(const std::string & arguments)
  {
    return RunCommand("\"" + ToolFolder() + "/export-noise-model\" " + arguments);
  }
  /** Returns whether the last command said this on standard output or standard error. */
  bool
  Says(const std::string & part) const
  {
    return (m_Output + m_Message).find(part) != std::string::npos;
  }

  /** Returns the JSON text of a run that must end with \a exitCode. */
  std::string
  JsonTextOf(const std::string & arguments, int exitCode = 0);
  /** Returns the record without `settings`, which say how it was made. */
  std::string
  MeasuredTextOf(const std::string & arguments);
  /** Returns the record, parsed. Parsing fails on NaN and infinity. */
  nlohmann::json
  ReportOf(const std::string & arguments, int exitCode = 0);

  /** Makes a burst with strong flicker, from which every quantity can be estimated. */
  StackType::Pointer
  MakeBurst(unsigned int frames = 24, const std::string & size = "64x64");

  template <typename TImage>
  static typename TImage::Pointer
  Make(const typename TImage::SizeType & size, typename TImage::PixelType value)
  {
    auto image = TImage::New();
    image->SetRegions(size);
    image->Allocate();
    image->FillBuffer(value);
    return image;
  }
  template <typename TImage>
  static typename TImage::Pointer
  Read(const std::filesystem::path & file)
  {
    const auto reader = itk::ImageFileReader<TImage>::New();
    reader->SetFileName(file.string());
    reader->Update();
    return reader->GetOutput();
  }
  template <typename TImage>
  std::string
  Write(const std::string & name, const TImage * image) const
  {
    const auto writer = itk::ImageFileWriter<TImage>::New();
    writer->SetFileName(Path(name).string());
    writer->SetInput(image);
    writer->Update();
    return name;
  }
  std::string
  WriteText(const std::string & name, const std::string & text) const;

  /** Returns a box of the stack, as a stack of its own. */
  template <typename TPixel>
  static typename itk::Image<TPixel, 3>::Pointer
  Cut(const itk::Image<TPixel, 3> * stack, const itk::Index<3> & first, const itk::Size<3> & size)
  {
    const auto part = Make<itk::Image<TPixel, 3>>(size, TPixel{});
    auto *     pixel = part->GetBufferPointer();
    for (std::size_t t = 0; t < size[2]; ++t)
    {
      for (std::size_t y = 0; y < size[1]; ++y)
      {
        for (std::size_t x = 0; x < size[0]; ++x)
        {
          const auto at = [&first](unsigned int axis, std::size_t i) {
            return first[axis] + static_cast<itk::IndexValueType>(i);
          };
          *pixel++ = stack->GetPixel({ { at(0, x), at(1, y), at(2, t) } });
        }
      }
    }
    return part;
  }

  /** Writes each frame as a file; the names, as they stand on the command line. */
  template <typename TPixel>
  std::vector<std::string>
  WriteList(const itk::Image<TPixel, 3> * stack, const std::string & extension) const
  {
    using FrameType = itk::Image<TPixel, 2>;
    const itk::Size<3>       size = stack->GetLargestPossibleRegion().GetSize();
    std::vector<std::string> names;
    for (std::size_t t = 0; t < size[2]; ++t)
    {
      const auto   frame = Make<FrameType>({ { size[0], size[1] } }, TPixel{});
      const auto * first = stack->GetBufferPointer() + t * size[0] * size[1];
      std::copy(first, first + size[0] * size[1], frame->GetBufferPointer());
      names.push_back(Write<FrameType>("frame_" + std::to_string(100 + t) + extension, frame));
    }
    return names;
  }
  static std::string
  Joined(const std::vector<std::string> & names);

  static std::string
  ReadText(const std::filesystem::path & name);
  std::set<std::string>
  FilesLeft() const;

  /** Expects that the first line of standard error that is no note and no warning names the mistake, and holds
   * \a parts. There are more lines only if the frames have more than one reason for which the gain is not identifiable.
   */
  void
  SaysInOneSentence(const std::vector<std::string> & parts) const;

  /** Expects exit code 2, one sentence with these parts, nothing on standard output and no file. */
  void
  IsRefused(const std::string & arguments, const std::vector<std::string> & parts);

  /** Expects exit code 3, one sentence with these parts, and a report without a value. */
  void
  GivesNoEstimate(const std::string & arguments, const std::vector<std::string> & parts);

  std::filesystem::path m_Folder;
  std::string           m_Output;
  std::string           m_Message;
};

#endif
