// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <cmath>
#include <limits>
#include <type_traits>

/** Runs denoise-with-noise-model on simulated frames of camera B: g = 1 DN/e-, mu = 100 DN, sigma = 8 DN. */
class DenoiseToolTest : public EstimateToolTest
{
protected:
  using FrameType = itk::Image<unsigned short, 2>;

  void
  SetUp() override
  {
    EstimateToolTest::SetUp();
    this->WriteReport("report.json", 1.0, 64.0 - 100.0 + 1.0 / 12.0);
  }

  void
  WriteReport(const std::string & name, const nlohmann::json & slope, const nlohmann::json & intercept) const
  {
    const nlohmann::json report{ { "schema", "itk-sensornoise-report/1" },
                                 { "quantisation_step", 1 },
                                 { "clip_low", 0 },
                                 { "clip_high", 4095 },
                                 { "variance_slope", { { "value", slope }, { "status", "identified" } } },
                                 { "total_intercept", { { "value", intercept }, { "status", "identified" } } },
                                 { "scatter", { { "mean", { 150, 1000, 3500 } } } } };
    WriteText(name, report.dump());
  }

  int
  Denoise(const std::string & arguments)
  {
    return RunCommand("\"" + ToolFolder() + "/denoise-with-noise-model\" " + arguments);
  }

  /** Expects the exit code, one sentence with these parts, nothing on standard output, and no file made or changed. */
  void
  IsRefusedBy(const std::string & arguments, const std::vector<std::string> & parts, int exitCode = 2)
  {
    SCOPED_TRACE(arguments);
    const std::set<std::string> before = FilesLeft();
    const std::string           bytes = ReadText(Path("frame.tif"));
    EXPECT_EQ(Denoise(arguments), exitCode) << m_Message;
    SaysInOneSentence(parts);
    EXPECT_EQ(std::count(m_Message.begin(), m_Message.end(), '\n'), 1) << m_Message;
    EXPECT_EQ(m_Output, "");
    EXPECT_EQ(FilesLeft(), before);
    EXPECT_EQ(ReadText(Path("frame.tif")), bytes);
  }

  /** Frames of 96 x 96 pixels of a scene at rest. */
  StackType::Pointer
  Simulate(const std::string & options, unsigned int frames)
  {
    EXPECT_EQ(RunCommand("\"" + ToolFolder() +
                         "/simulate-sensor-noise\" --output ../frames.mha --seed 7 --flicker-sd 0 --vibration-sd 0,0 "
                         "--size 96x96 --frames " +
                         std::to_string(frames) + " " + options),
              0)
      << m_Message;
    return Read<StackType>(m_Folder / "frames.mha");
  }
  /** One frame, and the same without noise: a hundred thousand times the electrons leave 1 in 316 of it. */
  FrameType::Pointer
  WriteFrame(const std::string & name)
  {
    const auto stack = this->Simulate("", 1);
    m_Truth = this->Simulate("--gain 1e-5 --electrons 3e8 --read-noise 0", 1);
    const auto frame = Make<FrameType>({ { 96, 96 } }, 0);
    std::copy_n(stack->GetBufferPointer(), 96 * 96, frame->GetBufferPointer());
    Write<FrameType>(name, frame);
    return frame;
  }
  template <typename TImage>
  double
  MeanSquaredError(const TImage * image) const
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < 96 * 96; ++i)
    {
      const double difference =
        static_cast<double>(image->GetBufferPointer()[i]) - static_cast<double>(m_Truth->GetBufferPointer()[i]);
      sum += difference * difference;
    }
    return sum / (96 * 96);
  }
  /** Returns the increase of the PSNR of frame.tif [dB]. */
  double
  GainOf(const std::string & arguments)
  {
    EXPECT_EQ(Denoise(arguments + " frame.tif clean.tif"), 0) << m_Message;
    EXPECT_EQ(m_Message, "");
    const auto noisy = Read<FrameType>(Path("frame.tif"));
    const auto clean = Read<FrameType>(Path("clean.tif"));
    return 10.0 * std::log10(MeanSquaredError(noisy.GetPointer()) / MeanSquaredError(clean.GetPointer()));
  }
  bool
  HasOpenCV()
  {
    Denoise("--help");
    std::istringstream words(m_Output); // lines may be wrapped anywhere
    std::string        before;
    for (std::string word; words >> word; before = word)
    {
      if (before == "(default:" && (word == "nlm)" || word == "itk)"))
      {
        return word == "nlm)";
      }
    }
    ADD_FAILURE() << "no default denoiser in " << m_Output;
    return false;
  }

  StackType::Pointer m_Truth;
};

// Measured: 4.7 dB (itk) and 11.5 dB (nlm). On an even place the bilateral filter leaves 1 / (4 pi 1.5^2) = 3.5 % of
// the variance at best, non-local means 1 / 441: the chart's edges cost the rest.
TEST_F(DenoiseToolTest, RaisesThePsnr)
{
  WriteFrame("frame.tif");
  EXPECT_GT(GainOf("--report report.json --denoiser itk"), 3.0);
  if (HasOpenCV())
  {
    EXPECT_GT(GainOf("--report report.json"), 8.0);
    EXPECT_GT(GainOf("--report report.json --denoiser nlm --threads 1"), 8.0);
  }
}

// The model matters: with a slope 16 times too small or too large the noise differs from the strength of the denoiser.
TEST_F(DenoiseToolTest, WrongModelIsWorse)
{
  WriteFrame("frame.tif");
  const double right = GainOf("--report report.json --denoiser itk");
  WriteReport("wrong.json", 1.0 / 16.0, -36.0 / 16.0);
  EXPECT_LT(GainOf("--report wrong.json --denoiser itk"), right - 1.0);
}

TEST_F(DenoiseToolTest, ReportWithoutOffsetServes)
{
  const auto stack = Simulate("", 16);
  Write<StackType>("burst.mha", stack);
  const nlohmann::json report = ReportOf("burst.mha --bit-depth 12");
  ASSERT_TRUE(report["offset"]["value"].is_null());
  ASSERT_FALSE(report["variance_slope"]["value"].is_null());
  WriteText("measured.json", report.dump());
  WriteFrame("frame.tif");
  EXPECT_GT(GainOf("--report measured.json --denoiser itk"), 3.0);
}

TEST_F(DenoiseToolTest, EveryTypeIsKept)
{
  const auto check = [this](auto pixel, const std::string & ending) {
    using PixelType = decltype(pixel);
    using ImageType = itk::Image<PixelType, 2>;
    WriteReport("narrow.json", 0.05, -2.0);
    const auto image = Make<ImageType>({ { 20, 12 } }, PixelType{ 100 });
    for (int i = 0; i < 240; ++i)
    {
      image->GetBufferPointer()[i] = static_cast<PixelType>(100 + i % 17);
    }
    typename ImageType::SpacingType spacing;
    spacing.Fill(0.5);
    image->SetSpacing(spacing);
    Write<ImageType>("in" + ending, image);
    ASSERT_EQ(Denoise("--report narrow.json --denoiser itk in" + ending + " out" + ending), 0) << m_Message;
    const auto found = Read<ImageType>(Path("out" + ending));
    EXPECT_EQ(found->GetLargestPossibleRegion(), image->GetLargestPossibleRegion());
    if (ending == ".mha")
    {
      EXPECT_EQ(found->GetSpacing(), spacing);
    }
    const auto io = itk::ImageIOFactory::CreateImageIO(Path("out" + ending).c_str(), itk::IOFileModeEnum::ReadMode);
    io->SetFileName(Path("out" + ending).string());
    io->ReadImageInformation();
    EXPECT_EQ(io->GetComponentType(), itk::ImageIOBase::MapPixelType<PixelType>::CType);
    ASSERT_EQ(Denoise("--report narrow.json --denoiser itk --pixel-type float in" + ending + " real.mha"), 0)
      << m_Message;
    const auto real = Read<itk::Image<float, 2>>(Path("real.mha"));
    for (int i = 0; i < 240; ++i)
    {
      const double expected =
        std::is_integral_v<PixelType> ? std::floor(real->GetBufferPointer()[i] + 0.5) : real->GetBufferPointer()[i];
      ASSERT_NEAR(found->GetBufferPointer()[i], expected, 1e-4) << i;
    }
  };
  for (const char * ending : { ".mha", ".tif", ".nrrd", ".png" })
  {
    SCOPED_TRACE(ending);
    check(static_cast<unsigned char>(0), ending);
    check(static_cast<unsigned short>(0), ending);
  }
  check(short{ 0 }, ".mha");
  check(short{ 0 }, ".tif");
  check(0.0F, ".tif");
  check(0.0, ".mha");
}

// A stack, streamed or not, is the same as its frames one by one, for any number of threads.
TEST_F(DenoiseToolTest, StackIsItsFrames)
{
  const auto stack = Simulate("", 3);
  Write<StackType>("stack.mha", stack);
  Write<StackType>("stack.tif", stack);
  const std::string names = Joined(WriteList<unsigned short>(stack, ".tif"));
  ASSERT_EQ(Denoise("--report report.json --output-folder clean --threads 1 " + names), 0) << m_Message;
  for (const std::string name : { "stack.mha", "stack.tif" })
  {
    ASSERT_EQ(Denoise("--report report.json " + name + " out_" + name), 0) << m_Message;
    const auto found = Read<StackType>(Path("out_" + name));
    ASSERT_EQ(found->GetLargestPossibleRegion(), stack->GetLargestPossibleRegion());
    for (int t = 0; t < 3; ++t)
    {
      const auto frame = Read<FrameType>(Path("clean/frame_" + std::to_string(100 + t) + ".tif"));
      EXPECT_TRUE(std::equal(
        frame->GetBufferPointer(), frame->GetBufferPointer() + 96 * 96, found->GetBufferPointer() + t * 96 * 96))
        << name << " " << t;
    }
  }
}

TEST_F(DenoiseToolTest, UnfitReportsAreRefused)
{
  WriteFrame("frame.tif");
  const std::string rest = " frame.tif clean.tif";
  WriteText("other.json", R"({"schema": "something/2"})");
  IsRefusedBy("--report other.json" + rest, { "schema", "something/2", "itk-sensornoise-report/1" }, 3);
  WriteText("list.json", "[1, 2]");
  IsRefusedBy("--report list.json" + rest, { "no schema" }, 3);
  WriteText("channels.json", R"({"schema": "itk-sensornoise-report/1", "channels": []})");
  IsRefusedBy("--report channels.json" + rest, { "several channels" }, 3);
  WriteReport("null.json", nullptr, 1.0);
  IsRefusedBy("--report null.json" + rest, { "variance_slope" }, 3);
  WriteReport("null.json", 1.0, nullptr);
  IsRefusedBy("--report null.json" + rest, { "total_intercept" }, 3);
  for (const double slope : { 0.0, -1.0 })
  {
    WriteReport("slope.json", slope, 1.0);
    IsRefusedBy("--report slope.json" + rest, { "slope", "above 0" }, 3);
  }
  WriteReport("text.json", "1.0", 1.0);
  IsRefusedBy("--report text.json" + rest, { "variance_slope" }, 3);
  WriteText("broken.json", "{\"schema\": ");
  IsRefusedBy("--report broken.json" + rest, { "broken.json", "no JSON" });
  IsRefusedBy("--report none.json" + rest, { "none.json", "cannot be read" });
  IsRefusedBy("--report frame.tif" + rest, { "no JSON" });
  IsRefusedBy("--report ." + rest, { "folder" });
}

TEST_F(DenoiseToolTest, OtherScalesAreRefused)
{
  const auto frame = WriteFrame("frame.tif");
  const auto scaled = [&](const std::string & name, double factor) {
    const auto other = Make<FrameType>({ { 96, 96 } }, 0);
    std::transform(frame->GetBufferPointer(),
                   frame->GetBufferPointer() + 96 * 96,
                   other->GetBufferPointer(),
                   [factor](unsigned short greyValue) { return static_cast<unsigned short>(greyValue * factor); });
    return Write<FrameType>(name, other);
  };
  IsRefusedBy("--report report.json " + scaled("by16.tif", 16.0) + " clean.tif", { "by16.tif", "multiples of 16" });
  IsRefusedBy("--report report.json " + scaled("by15.tif", 15.8) + " clean.tif", { "by15.tif", "another scale" });
  IsRefusedBy("--report report.json " + scaled("dark.tif", 0.005) + " clean.tif",
              { "dark.tif", "level of zero signal" });
  // twice the signal of the brightest pixels that were measured
  nlohmann::json report = nlohmann::json::parse(ReadText(Path("report.json")));
  report["scatter"]["mean"] = { 150, 300 };
  WriteText("dim.json", report.dump());
  ASSERT_EQ(Denoise("--report dim.json --denoiser itk frame.tif clean.tif"), 0) << m_Message;
  EXPECT_NE(m_Message.find("far brighter"), std::string::npos) << m_Message;

  const auto real = Make<itk::Image<float, 2>>({ { 16, 16 } }, 1000.0F);
  real->GetBufferPointer()[7] = std::numeric_limits<float>::quiet_NaN();
  Write<itk::Image<float, 2>>("nan.tif", real);
  IsRefusedBy("--report report.json nan.tif real.tif", { "nan.tif", "1 pixels", "NaN" });
}

TEST_F(DenoiseToolTest, WrongUseIsRefused)
{
  WriteFrame("frame.tif");
  const std::string use = "--report report.json ";
  IsRefusedBy(use + "frame.tif frame.tif", { "same file", "the input" });
  IsRefusedBy(use + "frame.tif ./frame.tif", { "same file" });
  IsRefusedBy(use + "--output-folder . frame.tif", { "same file" });
  IsRefusedBy(use + "frame.tif", { "1 files", "INPUT OUTPUT" });
  IsRefusedBy(use + "frame.tif a.tif b.tif", { "3 files" });
  IsRefusedBy(use + "frame.tif clean.jpg", { "clean.jpg", ".tif" });
  IsRefusedBy(use + "frame.tif none/clean.tif", { "none/clean.tif" });
  IsRefusedBy(use + "none.tif clean.tif", { "none.tif" });
  IsRefusedBy(use + "report.json clean.tif", { "report.json" });
  IsRefusedBy(use + "--pixel-type float frame.tif clean.png", { "clean.png", "PNG" });
  IsRefusedBy(use + "--strength 0 frame.tif clean.tif", { "--strength" });
  IsRefusedBy(use + "--strength nan frame.tif clean.tif", { "--strength" });
  IsRefusedBy(use + "--denoiser median frame.tif clean.tif", { "--denoiser" });
  IsRefusedBy("frame.tif clean.tif", { "--report" });
  if (!HasOpenCV())
  {
    IsRefusedBy(use + "--denoiser nlm frame.tif clean.tif", { "without OpenCV" });
    IsRefusedBy(use + "--denoiser bm3d frame.tif clean.tif", { "without OpenCV" });
  }
  const std::string half = ReadText(Path("frame.tif")).substr(0, 5000);
  WriteText("half.tif", half);
  IsRefusedBy(use + "half.tif clean.tif", { "half.tif" });
}

// An output that another output of the same name would overwrite is an error before anything is written.
TEST_F(DenoiseToolTest, NothingIsWrittenTwice)
{
  WriteFrame("frame.tif");
  std::filesystem::create_directories(Path("other"));
  std::filesystem::copy_file(Path("frame.tif"), Path("other/frame.tif"));
  std::filesystem::create_directories(Path("clean"));
  IsRefusedBy("--report report.json --output-folder clean frame.tif other/frame.tif", { "same file" });
  IsRefusedBy("--report report.json --output-folder new/clean frame.tif other/frame.tif", { "same file" });
  EXPECT_FALSE(std::filesystem::exists(Path("new")));
}
