// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_EstimateToolTestHelper_h
#define sensornoise_test_EstimateToolTestHelper_h

#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

/** Runs estimate-sensor-noise in an empty folder of its own, on files that the test has made there. */
class EstimateToolTest : public ::testing::Test
{
protected:
  using StackType = itk::Image<unsigned short, 3>;

  void
  SetUp() override
  {
    const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    // two builds may be tested at the same time
    m_Folder =
      std::filesystem::path(::testing::TempDir()) / ("EstimateTool" + test + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(m_Folder / "work");
  }
  void
  TearDown() override
  {
    std::filesystem::remove_all(m_Folder);
  }

  std::filesystem::path
  Path(const std::string & name) const
  {
    return m_Folder / "work" / name;
  }

  /** Exit code of a command in the folder; what it says goes to m_Output and m_Message. */
  int
  RunCommand(const std::string & command)
  {
    const std::string line =
      "cd \"" + Path("").string() + "\" && { " + command + " ; } > ../stdout.txt 2> ../stderr.txt";
    const int status = std::system(line.c_str());
    m_Output = ReadText(m_Folder / "stdout.txt");
    m_Message = ReadText(m_Folder / "stderr.txt");
#ifdef _WIN32
    return status;
#else
    return status >> 8; // wait status: the exit code is its second byte, and a signal leaves 0 there
#endif
  }
  int
  Run(const std::string & arguments)
  {
    return RunCommand("\"" SENSORNOISE_BIN "/estimate-sensor-noise\" " + arguments);
  }

  /** The JSON text of a run that must end with \a exitCode. */
  std::string
  JsonTextOf(const std::string & arguments, int exitCode = 0)
  {
    SCOPED_TRACE(arguments);
    EXPECT_EQ(Run(arguments + " --quiet --json -"), exitCode) << m_Message;
    return m_Output;
  }
  /** The same without `settings`, which say how it was made. */
  std::string
  MeasuredTextOf(const std::string & arguments)
  {
    std::string       text = JsonTextOf(arguments);
    const std::size_t begin = text.find("\"settings\": {");
    const std::size_t end = text.find('}', begin);
    EXPECT_NE(end, std::string::npos) << text;
    return end == std::string::npos ? text : text.erase(begin, end - begin);
  }
  /** The same, parsed, which fails on NaN and infinity. */
  nlohmann::json
  ReportOf(const std::string & arguments, int exitCode = 0)
  {
    const std::string text = JsonTextOf(arguments, exitCode);
    EXPECT_TRUE(nlohmann::json::accept(text)) << text;
    return nlohmann::json::parse(text, nullptr, false);
  }

  /** A burst with strong flicker, of which everything can be estimated. */
  StackType::Pointer
  MakeBurst(unsigned int frames = 24, const std::string & size = "64x64")
  {
    EXPECT_EQ(RunCommand("\"" SENSORNOISE_BIN
                         "/simulate-sensor-noise\" --output ../burst.mha --seed 3 --flicker-sd 0.1 --size " +
                         size + " --frames " + std::to_string(frames)),
              0)
      << m_Message;
    return Read<StackType>(m_Folder / "burst.mha");
  }

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
  WriteText(const std::string & name, const std::string & text) const
  {
    std::ofstream(Path(name), std::ios::binary) << text;
    return name;
  }

  /** A box of the stack, as a stack of its own. */
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
  Joined(const std::vector<std::string> & names)
  {
    std::string text;
    for (const std::string & name : names)
    {
      text += name + " ";
    }
    return text;
  }

  static std::string
  ReadText(const std::filesystem::path & name)
  {
    std::ifstream file(name, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  }
  std::set<std::string>
  FilesLeft() const
  {
    std::set<std::string> names;
    for (const auto & entry : std::filesystem::recursive_directory_iterator(Path("")))
    {
      if (!entry.is_directory())
      {
        names.insert(entry.path().lexically_relative(Path("")).string());
      }
    }
    return names;
  }

  /** The first line of standard error that is no note and no warning says what is wrong, and holds \a parts. There are
   * more only where more than one thing in the frames keeps the gain from being told. */
  void
  SaysInOneSentence(const std::vector<std::string> & parts) const
  {
    std::istringstream lines(m_Message);
    std::string        sentence;
    for (std::string line; std::getline(lines, line);)
    {
      if (line.rfind("warning: ", 0) != 0 && line.rfind("note: ", 0) != 0)
      {
        EXPECT_EQ(line.rfind("error: ", 0), 0u) << m_Message;
        EXPECT_TRUE(sentence.empty() || line.back() == ']') << m_Message;
        sentence = sentence.empty() ? line : sentence;
      }
    }
    for (const std::string & part : parts)
    {
      EXPECT_NE(sentence.find(part), std::string::npos) << "\"" << part << "\" is not in: " << m_Message;
    }
  }

  /** Exit code 2, one sentence with these parts, nothing on standard output and no file. */
  void
  IsRefused(const std::string & arguments, const std::vector<std::string> & parts)
  {
    SCOPED_TRACE(arguments);
    const std::set<std::string> before = FilesLeft();
    EXPECT_EQ(Run(arguments + " --json refused.json --maps refused"), 2) << m_Message;
    SaysInOneSentence(parts);
    EXPECT_EQ(std::count(m_Message.begin(), m_Message.end(), '\n'), 1) << m_Message;
    EXPECT_EQ(m_Output, "");
    EXPECT_EQ(FilesLeft(), before);
  }

  /** Exit code 3, one sentence with these parts, and a report without a value. */
  void
  GivesNoEstimate(const std::string & arguments, const std::vector<std::string> & parts)
  {
    SCOPED_TRACE(arguments);
    const nlohmann::json report = ReportOf(arguments, 3);
    SaysInOneSentence(parts);
    for (const char * name : { "gain", "offset", "read_noise", "read_noise_electrons", "intercept", "total_intercept" })
    {
      EXPECT_TRUE(report[name]["value"].is_null()) << name;
      EXPECT_NE(report[name]["status"], "identified") << name;
    }
    EXPECT_FALSE(report["warnings"].empty());
  }

  std::filesystem::path m_Folder;
  std::string           m_Output;
  std::string           m_Message;
};

#endif
