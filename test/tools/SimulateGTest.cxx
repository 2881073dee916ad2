// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/CheckoutTestHelper.h"
#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using StackType = itk::Image<unsigned short, 3>;

/** Each test works in an empty folder of its own. */
class SimulateTool : public ::testing::Test
{
protected:
  void
  SetUp() override
  {
    const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    m_Folder = fs::temp_directory_path() / ("sensornoise-simulate-tool-" + test);
    fs::remove_all(m_Folder);
    fs::create_directories(m_Folder / "out");
  }
  void
  TearDown() override
  {
    fs::remove_all(m_Folder);
  }
  /** Runs the program. Returns its exit code, and sets m_Message and m_Output. */
  int
  Run(const std::string & arguments)
  {
    const fs::path    said = m_Folder / "stderr.txt";
    const std::string command = "cd \"" + (m_Folder / "out").string() + "\" && " + m_Prefix + "\"" + ToolFolder() +
                                "/simulate-sensor-noise\" " + arguments + " > ../stdout.txt 2> ../stderr.txt";
    const int status = std::system(command.c_str());
    m_Message = ReadText(said);
    m_Output = ReadText(m_Folder / "stdout.txt");
#ifdef _WIN32
    return status;
#else
    return status >> 8; // wait status: the exit code is its second byte
#endif
  }
  static std::string
  ReadText(const fs::path & name)
  {
    std::ifstream file(name, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  }
  nlohmann::json
  ReadJson(const std::string & name) const
  {
    return nlohmann::json::parse(ReadText(m_Folder / "out" / name));
  }
  StackType::Pointer
  ReadStack(const std::string & name) const
  {
    const auto reader = itk::ImageFileReader<StackType>::New();
    reader->SetFileName((m_Folder / "out" / name).string());
    reader->Update();
    return reader->GetOutput();
  }
  std::set<std::string>
  FilesLeft() const
  {
    std::set<std::string> names;
    for (const auto & entry : fs::directory_iterator(m_Folder / "out"))
    {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
  /** Expects exit code 2, one sentence with these words, and no file. */
  void
  ExpectError(const std::string & arguments, const std::string & words)
  {
    SCOPED_TRACE(arguments);
    const auto before = FilesLeft();
    EXPECT_EQ(Run(arguments), 2);
    EXPECT_NE(m_Message.find(words), std::string::npos) << m_Message;
    EXPECT_EQ(std::count(m_Message.begin(), m_Message.end(), '\n'), 1) << m_Message;
    EXPECT_EQ(m_Output, "");
    EXPECT_EQ(FilesLeft(), before);
  }

  fs::path    m_Folder;
  std::string m_Prefix;
  std::string m_Message;
  std::string m_Output;
};
} // namespace

TEST_F(SimulateTool, IlluminationIsAShapeOrAFile)
{
  const std::string options = "--size 32x32 --flicker-sd 0 --output s.mha --truth t.json --illumination ";
  const std::string common = "--frames 4 " + options;
  std::ofstream(m_Folder / "factors.txt") << "1 0.25,0.5\n0.25\n";
  std::ofstream(m_Folder / "words.txt") << "1 2 half 1";
  for (const char * shape : { "../factors.txt", "steady", "ramp:0.4" })
  {
    ASSERT_EQ(Run(common + shape), 0) << m_Message;
    const nlohmann::json truth = ReadJson("t.json");
    const double         first = truth["gamma"][0];
    EXPECT_EQ(truth["illumination"], shape[0] == '.' ? "factors" : shape);
    EXPECT_NEAR(first, shape[0] == 'r' ? -0.6 : 0.0, 1e-15);
  }
  ExpectError(common + "strobe", "the illumination \"strobe\" is no file that can be read, and no known shape");
  ExpectError(common + "ramp:2", "the lowest illumination factor is 2; expected 0 to 1");
  ExpectError(common + "../words.txt", "has \"half\" as number 3; expected one illumination factor a frame");
  ExpectError("--frames 5 " + options + "../factors.txt", "one for each of the 5 frames");
}

TEST_F(SimulateTool, WritesTheStackAndItsTruth)
{
  ASSERT_EQ(Run("--output stack.mha --truth truth.json --size 64x48 --frames 7"), 0) << m_Message;
  EXPECT_EQ(m_Output + m_Message, "");
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "stack.mha", "truth.json" }));
  const auto stack = ReadStack("stack.mha");
  EXPECT_EQ(stack->GetLargestPossibleRegion().GetSize(), (StackType::SizeType{ { 64, 48, 7 } }));

  const auto truth = ReadJson("truth.json");
  EXPECT_EQ(truth["schema"], "itk-sensornoise-truth/1");
  EXPECT_EQ(truth["camera"], "B");
  EXPECT_EQ(truth["condition"], 3);
  EXPECT_EQ(truth["gain"], 1.0);
  EXPECT_EQ(truth["offset"], 100.0);
  EXPECT_EQ(truth["read_noise"], 8.0);
  EXPECT_EQ(truth["intercept"], 64.0 - 100.0);
  EXPECT_EQ(truth["flicker_sd"], 0.05);
  EXPECT_EQ(truth["vibration_sd"], (std::vector<double>{ 0.01, 0.02 }));
  EXPECT_GT(truth["realised_flicker_sd"], 0.0);
  for (const char * series : { "flicker", "gamma", "alpha", "beta" })
  {
    EXPECT_EQ(truth[series].size(), 7u) << series;
  }
  EXPECT_TRUE(truth["phase"].is_null());
}

TEST_F(SimulateTool, FlatSceneHasOneLevel)
{
  ASSERT_EQ(Run("--output s.mha --truth t.json --size 32x24 --frames 3 --reference flat --camera B --flicker-sd 0"), 0)
    << m_Message;
  const auto            stack = ReadStack("s.mha");
  const auto * const    pixels = stack->GetBufferPointer();
  constexpr std::size_t count = 32 * 24 * 3;
  const double          mean = std::accumulate(pixels, pixels + count, 0.0) / count;
  EXPECT_NEAR(mean, 3100.0, 5.0 * std::sqrt(3064.0 / count)); // 3000 e- at 1 DN/e- above 100 DN, 5 s.e.
}

TEST_F(SimulateTool, ExplicitValuesOverrideCameraAndCondition)
{
  ASSERT_EQ(
    Run("--output s.mha --truth t.json --size 32x32 --frames 3 --reference bars --camera A --gain 2 --offset 50 "
        "--read-noise 4 --electrons 900 --condition 1 --flicker-sd 0.2 --vibration-sd 0.5,0.25 "
        "--rolling-shutter 16 --bit-depth 10 --clip 20,800 --seed 18446744073709551615"),
    0)
    << m_Message;
  const auto truth = ReadJson("t.json");
  EXPECT_TRUE(truth["camera"].is_null());
  EXPECT_TRUE(truth["condition"].is_null());
  EXPECT_EQ(truth["gain"], 2.0);
  EXPECT_EQ(truth["electrons"], 900.0);
  EXPECT_EQ(truth["intercept"], 16.0 - 100.0);
  EXPECT_EQ(truth["vibration_sd"], (std::vector<double>{ 0.5, 0.25 }));
  EXPECT_EQ(truth["rolling_shutter_period"], 16.0);
  EXPECT_EQ(truth["phase"].size(), 3u);
  EXPECT_EQ(truth["bit_depth"], 10);
  EXPECT_EQ(truth["seed"], 18446744073709551615ULL);
  EXPECT_EQ(truth["clip_high"], 800.0);
  const auto   stack = ReadStack("s.mha");
  const auto * pixels = stack->GetBufferPointer();
  const auto   extremes = std::minmax_element(pixels, pixels + 32 * 32 * 3);
  EXPECT_GE(*extremes.first, 20);
  EXPECT_EQ(*extremes.second, 800);
}

TEST_F(SimulateTool, FlawsReachTheTruth)
{
  ASSERT_EQ(
    Run("--output s.mha --truth t.json --size 64x48 --frames 4 --prnu 0.01 --dsnu 2 --hot-pixels 0.02,5 "
        "--gain-pattern 0.011 --column-gain-pattern 0.012 --column-efficiency-pattern 0.013 "
        "--column-offset-pattern 1.4 --brighter-fatter 1.5e-6 --coupling 0.016 --read-noise-spread 0.17 "
        "--read-noise-tail 0.018,1.9 --response wave,-0.02 --row-noise 2.1 --column-noise 2.2 --banding 2.3,24 "
        "--dark --defect-correction 2.5 --temporal-filter 0.26 --median 1 --smoothing 0.27 --binning 3 "
        "--binning-interpolation linear --resampling 0.28,-0.29 --resampling-interpolation cubic --block-quality 91 "
        "--bayer GBRG --transmission 0.4,0.9,0.3 --companding 10 --repeat 2 --repeat-period 1 --optical-blur 0.75"),
    0)
    << m_Message;
  const auto truth = ReadJson("t.json");
  EXPECT_EQ(truth["prnu_sd"], 0.01);
  EXPECT_EQ(truth["dsnu_sd"], 2.0);
  EXPECT_EQ(truth["hot_pixel_fraction"], 0.02);
  EXPECT_EQ(truth["hot_pixel_noise_factor"], 5.0);
  EXPECT_EQ(truth["dark"], true);
  EXPECT_GT(truth["realised_read_noise"], truth["realised_read_noise_median"]);
  const auto expected = nlohmann::json::parse(
    R"({"filters": {"bayer": "GBRG", "transmission": [0.4, 0.9, 0.3]},
        "pattern": {"gain_sd": 0.011, "column_gain_sd": 0.012, "column_efficiency_sd": 0.013, "column_offset_sd": 1.4},
        "brighter_fatter_per_electron": 1.5e-6, "coupling_fraction": 0.016,
        "read_noise": {"spread": 0.17, "tail_fraction": 0.018, "tail_spread": 1.9},
        "response": {"shape": "wave", "size": -0.02, "full_scale_electrons": 0},
        "line_noise": {"row_noise_sd": 2.1, "column_noise_sd": 2.2, "banding_amplitude": 2.3, "banding_period": 24},
        "defect_threshold_sd": 2.5, "temporal_filter_weight": 0.26, "median_radius": 1, "smoothing_sd": 0.27,
        "binning": {"factor": 3, "interpolation": "linear"}, "resampling_shift": [0.28, -0.29],
        "resampling_interpolation": "cubic", "block_quality": 91, "companding_bits": 10, "repeat_count": 2,
        "repeat_period": 1})");
  EXPECT_EQ(truth["optical_blur"], 0.75);
  EXPECT_EQ(truth["flaws"], expected);
  const auto   stack = ReadStack("s.mha");
  const auto * pixels = stack->GetBufferPointer();
  EXPECT_TRUE(std::equal(pixels, pixels + 64 * 48, pixels + 64 * 48)); // each exposure twice
  EXPECT_LT(*std::max_element(pixels, pixels + 64 * 48 * 4), 1000);    // dark
}

TEST_F(SimulateTool, SameSeedSameFileAndAnExistingFileIsReplaced)
{
  ASSERT_EQ(Run("--output a.mha --size 32x32 --frames 3 --seed 5"), 0);
  ASSERT_EQ(Run("--output b.mha --size 32x32 --frames 3 --seed 6"), 0);
  const std::string a = ReadText(m_Folder / "out" / "a.mha");
  EXPECT_NE(a, ReadText(m_Folder / "out" / "b.mha"));
  ASSERT_EQ(Run("--output b.mha --size 32x32 --frames 3 --seed 5"), 0);
  EXPECT_EQ(a, ReadText(m_Folder / "out" / "b.mha"));
}

TEST_F(SimulateTool, EveryFormatHoldsTheSamePixels)
{
  std::vector<std::vector<unsigned short>> pixels;
  for (const std::string name : { "s.mha", "s.nrrd", "s.tif" })
  {
    ASSERT_EQ(Run("--output " + name + " --size 40x33 --frames 4 --reference texture"), 0) << m_Message;
    const auto stack = ReadStack(name);
    pixels.emplace_back(stack->GetBufferPointer(), stack->GetBufferPointer() + 40 * 33 * 4);
  }
  EXPECT_EQ(pixels[0], pixels[1]);
  EXPECT_EQ(pixels[0], pixels[2]);
}

TEST_F(SimulateTool, ReadsAReferenceFileInItsOwnSize)
{
  using ReferenceType = itk::Image<unsigned char, 2>;
  const auto reference = ReferenceType::New();
  reference->SetRegions(ReferenceType::SizeType{ { 30, 20 } });
  reference->Allocate();
  for (int i = 0; i < 600; ++i)
  {
    reference->GetBufferPointer()[i] = static_cast<unsigned char>(i % 30 < 15 ? 10 : 200);
  }
  const auto writer = itk::ImageFileWriter<ReferenceType>::New();
  writer->SetInput(reference);
  writer->SetFileName((m_Folder / "out" / "scene.png").string());
  writer->Update();
  ASSERT_EQ(Run("--output s.mha --reference scene.png --frames 1"), 0) << m_Message;
  const auto stack = ReadStack("s.mha");
  EXPECT_EQ(stack->GetLargestPossibleRegion().GetSize(), (StackType::SizeType{ { 30, 20, 1 } }));
  EXPECT_LT(stack->GetBufferPointer()[0], 200);   // no electrons: offset 100 DN, read noise 8 DN
  EXPECT_GT(stack->GetBufferPointer()[29], 2000); // 3000 electrons, flicker 5 %
  ExpectError("--output t.mha --reference scene.png --size 10x10", "keeps its own size");
}

TEST_F(SimulateTool, OneFrameHasNoDispersion)
{
  ASSERT_EQ(Run("--output s.mha --truth t.json --size 32x32 --frames 1"), 0);
  EXPECT_TRUE(ReadJson("t.json")["realised_flicker_sd"].is_null());
}

TEST_F(SimulateTool, WrongUseIsRefusedInOneSentenceAndLeavesNothing)
{
  ExpectError("", "--output");
  ExpectError("--output s.mha --colour red", "--colour");
  ExpectError("--output s.png", "expected a name that ends in .mha");
  ExpectError("--output nowhere/s.mha", "there is no folder nowhere");
  ExpectError("--output s.mha --truth nowhere/t.json --size 32x32", "there is no folder nowhere");
  ExpectError("--output s.mha --truth s.mha", "the ending of an image");
  ExpectError("--output s.mha --size 512", "expected WIDTHxHEIGHT");
  ExpectError("--output s.mha --size 20x20", "needs at least 32 x 32");
  ExpectError("--output s.mha --camera D", "expected A, B or C");
  ExpectError("--output s.mha --camera BB", "expected A, B or C");
  ExpectError("--output s.mha --condition 4", "expected 1, 2 or 3");
  ExpectError("--output s.mha --reference moon", "neither target, bars, texture or flat nor a file");
  ExpectError("--output s.mha --frames 0", "expected at least 1");
  ExpectError("--output s.mha --frames many", "--frames");
  ExpectError("--output s.mha --seed -1", "--seed: it is \"-1\"; expected a whole number of 0 or more");
  ExpectError("--output s.mha --bit-depth 17", "the pixel type holds at most 16 bits");
  ExpectError("--output s.mha --vibration-sd 0.1", "--vibration-sd");
  ExpectError("--output s.mha --clip 100,50", "expected the low one below the high one");
  ExpectError("--output s.mha --clip 0,99999", "--clip is 0,99999, and the converter reaches 0 to 4095 DN");
  ExpectError("--output s.mha --clip=-1,800", "the converter reaches 0 to 4095 DN");
  ExpectError("--output s.mha --bit-depth 0 --clip 0,65536", "the converter reaches 0 to 65535 DN");
  ExpectError("--output s.mha --transmission 0.6,1,0.5", "expected --bayer with it");
  ExpectError("--output s.mha --response wave", "--response");
  ExpectError("--output s.mha --response bump,0.1", "the response \"bump\" is not known");
  ExpectError("--output s.mha --temporal-filter 1", "expected 0 to 0.99");
  ExpectError("--output s.mha --banding 3", "--banding");
  std::ofstream(m_Folder / "out" / "not-an-image.txt") << "hello";
  ExpectError("--output s.mha --reference not-an-image.txt", "no image in a format");
}

#ifndef _WIN32
TEST_F(SimulateTool, FullDiskLeavesNothing)
{
  // No file may grow beyond a few kilobytes, and the shell's signal for that is ignored: writing fails as on a full
  // disk.
  m_Prefix = "trap '' XFSZ; ulimit -f 16; ";
  for (const std::string name : { "s.mha", "s.nrrd", "s.tif" })
  {
    EXPECT_EQ(Run("--truth t.json --frames 3 --output " + name), 2) << name;
    EXPECT_NE(m_Message, "");
    EXPECT_TRUE(FilesLeft().empty()) << name;
  }
}
#endif

TEST_F(SimulateTool, HelpIsGivenOnStandardOutput)
{
  EXPECT_EQ(Run("--help"), 0);
  EXPECT_NE(m_Output.find("--rolling-shutter"), std::string::npos);
  EXPECT_EQ(m_Message, "");
}
