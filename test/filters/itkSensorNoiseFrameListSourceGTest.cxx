// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkSensorNoiseFrameListSource.h"
#include "helpers/FrameFilesTestHelper.h"
#include "helpers/PngTestHelper.h"
#include "helpers/TiffTestHelper.h"
#include "itkPipelineMonitorImageFilter.h"
#include "itkTemporalStatisticsImageFilter.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using namespace sensornoisetest::files;
using StackType = itk::Image<unsigned short, 3>;
using SourceType = itk::SensorNoiseFrameListSource<StackType>;

/** Tests that the frames of lists are read as they were written. */
class SensorNoiseFrameListSource : public FrameFilesTest
{};

TEST_F(SensorNoiseFrameListSource, AListReadsWhatWasWritten)
{
  for (const std::string extension : { ".tif", ".png", ".mha", ".nrrd" })
  {
    ReadsWhatWasWritten<unsigned short>(WriteList<unsigned short>(extension), false);
    ReadsWhatWasWritten<unsigned char>(WriteList<unsigned char>(extension), false);
  }
  ReadsWhatWasWritten<short>(WriteList<short>(".tif"), false);
  ReadsWhatWasWritten<float>(WriteList<float>(".tif"), false);
  ReadsWhatWasWritten<double>(WriteList<double>(".mha"), false);
}

TEST_F(SensorNoiseFrameListSource, AStackReadsWhatWasWritten)
{
  for (const bool compress : { false, true })
  {
    ReadsWhatWasWritten<unsigned short>({ WriteStack<unsigned short>("s.mha", compress) }, true);
    ReadsWhatWasWritten<short>({ WriteStack<short>("s.mhd", compress) }, true);
    ReadsWhatWasWritten<float>({ WriteStack<float>("s.nrrd", compress) }, true);
    ReadsWhatWasWritten<double>({ WriteStack<double>("s.nhdr", compress) }, true);
    ReadsWhatWasWritten<unsigned char>({ WriteStack<unsigned char>("s.tif", compress) }, true);
    ReadsWhatWasWritten<float>({ WriteStack<float>("s.tif", compress) }, true);
  }
}

// A camera's program begins a new file when one is full.
TEST_F(SensorNoiseFrameListSource, SeveralStacksAreOneBurst)
{
  for (const std::string extension : { ".mha", ".nrrd", ".tif" })
  {
    const std::vector<std::string> files{ Write<short, 3>("a" + extension, { { width, height, 2 } }, 0),
                                          Write<short, 3>("b" + extension, { { width, height, 1 } }, 2),
                                          Write<short, 3>("c" + extension, { { width, height, 1 } }, 3) };
    ReadsWhatWasWritten<short>(files, true);
  }
  const std::string mixed = Write<short, 3>("b.nrrd", { { width, height, 2 } }, 2);
  ReadsWhatWasWritten<short>({ Path("a.mha"), mixed }, true);
}

TEST_F(SensorNoiseFrameListSource, AListOfSlicesOfThreeDimensionsReadsWhatWasWritten)
{
  std::vector<std::string> files;
  for (std::size_t t = 0; t < frames; ++t)
  {
    files.push_back(Write<short, 3>("slice_" + std::to_string(t) + ".mha", { { width, height, 1 } }, t));
  }
  ReadsWhatWasWritten<short>(files, false);
}

// ImageSeriesReader would put images of height 1 below each other and images of one pixel beside each other.
TEST_F(SensorNoiseFrameListSource, TimeIsTheLastAxisHoweverSmallTheFramesAre)
{
  for (const itk::Size<2> size :
       { itk::Size<2>{ { 1, 1 } }, itk::Size<2>{ { width, 1 } }, itk::Size<2>{ { 1, height } } })
  {
    for (const std::string extension : { ".tif", ".png", ".mha" })
    {
      std::vector<std::string> files;
      for (std::size_t t = 0; t < frames; ++t)
      {
        files.push_back(WriteFrame<unsigned short>("small_" + std::to_string(t) + extension, t, size));
      }
      const auto source = MakeSource<unsigned short>(files);
      source->Update();
      EXPECT_EQ(source->GetOutput()->GetBufferedRegion().GetSize(), (itk::Size<3>{ { size[0], size[1], frames } }));
      EXPECT_EQ(WrongPixels<unsigned short>(source->GetOutput()), 0u);
    }
  }
  const FrameList one = OpenFrames({ WriteFrame<unsigned char>("one.png") });
  EXPECT_EQ(one.frames, 1u);
  EXPECT_FALSE(one.isStack);
}

TEST_F(SensorNoiseFrameListSource, AListOfDataFilesReadsWhatWasWrittenAndIsChecked)
{
  const std::string stack = WriteStack<unsigned short>("s.mhd");
  std::ifstream     raw(Path("s.raw"), std::ios::binary);
  std::string       header = "NDims = 3\nDimSize = 7 5 4\nElementType = MET_USHORT\nElementDataFile = LIST\n";
  for (std::size_t t = 0; t < frames; ++t)
  {
    std::string pixels(width * height * 2, ' ');
    raw.read(pixels.data(), pixels.size());
    WriteText("part" + std::to_string(t), pixels);
    header += "part" + std::to_string(t) + "\n";
  }
  const std::string list = WriteText("list.mhd", header);
  ReadsWhatWasWritten<unsigned short>({ list }, true);
  CutOff(Path("part2"), 1);
  OpeningIsRefusedWith({ list }, { "list.mhd", "part2", "69 bytes", "expected 70" });
  fs::remove(Path("part2"));
  OpeningIsRefusedWith({ list }, { "list.mhd", "part2", "does not exist" });
  OpeningIsRefusedWith({ WriteText("short.mhd", header.substr(0, header.size() - 1)) },
                       { "short.mhd", "3 whole lines", "expected 4" });
}

TEST_F(SensorNoiseFrameListSource, NothingIsConverted)
{
  const std::string file = WriteFrame<unsigned short>("frame.tif");
  const auto        source = MakeSource<float>(std::vector<std::string>{ file });
  ExpectParts(
    MessageOf([&] { source->UpdateOutputInformation(); }),
    { file + ": component type unsigned short", "the source's is float", "expected a source of unsigned short" });
  // the type is known all the same, and can be handed on
  EXPECT_EQ(source->GetComponentType(), itk::IOComponentEnum::USHORT);
  const auto right = MakeSource<unsigned short>(source->GetFrameList());
  right->Update();
  EXPECT_EQ(WrongPixels<unsigned short>(right->GetOutput()), 0u);
}

TEST_F(SensorNoiseFrameListSource, AListIsReadInTheChunksAskedForAndGivesTheSameBits)
{
  const auto list = WriteList<unsigned short>(".png");
  const auto stack = WriteStack<unsigned short>("s.mha");
  const auto whole = WriteStack<unsigned short>("s.tif");
  using FilterType = itk::TemporalStatisticsImageFilter<StackType>;
  std::vector<double> expected;
  for (const auto & files : { list, { stack }, { whole } })
  {
    for (const unsigned int chunks : { 1u, 3u, 4u })
    {
      const auto source = MakeSource<unsigned short>(files);
      const auto monitor = itk::PipelineMonitorImageFilter<StackType>::New();
      monitor->SetInput(source->GetOutput());
      const auto filter = FilterType::New();
      filter->SetInput(monitor->GetOutput());
      filter->SetNumberOfStreamDivisions(chunks);
      filter->Update();
      EXPECT_TRUE(files.front() == whole || monitor->VerifyAllInputCanStream(static_cast<int>(chunks))) << chunks;
      const double * const      variance = filter->GetVariance()->GetBufferPointer();
      const std::vector<double> found(variance, variance + width * height);
      expected = expected.empty() ? found : expected;
      EXPECT_EQ(found, expected) << files.front() << " in " << chunks;
    }
  }
}

TEST_F(SensorNoiseFrameListSource, NoMoreIsReadThanTheFramesAskedFor)
{
  const auto files = WriteList<unsigned short>(".tif");
  const auto source = MakeSource<unsigned short>(files);
  source->UpdateOutputInformation();
  fs::remove(files[0]);
  fs::remove(files[3]);
  const auto * const part = ReadPart<unsigned short>(source, 1, 2);
  EXPECT_EQ(part->GetBufferedRegion().GetIndex(2), 1);
  EXPECT_EQ(part->GetBufferedRegion().GetSize(2), 2u);
  EXPECT_EQ(WrongPixels<unsigned short>(part), 0u);
  EXPECT_FALSE(source->GetFrameList().isStack);
  EXPECT_TRUE(source->CanStream());
}

// Two passes over the frames, and one of them is another frame at the second: that gave a wrong gain once.
TEST_F(SensorNoiseFrameListSource, AFrameThatIsReplacedBetweenTwoPassesIsAnErrorAndTheNextUpdateIsRight)
{
  for (const std::string extension : { ".tif", ".mha" })
  {
    const auto files = WriteList<unsigned short>(extension);
    const auto source = MakeSource<unsigned short>(files);
    for (std::size_t t = 0; t < frames; ++t)
    {
      EXPECT_EQ(WrongPixels<unsigned short>(ReadPart<unsigned short>(source, t, 1)), 0u);
    }
    const auto size = fs::file_size(files[2]);
    WriteFrame<unsigned short>("frame_2" + extension, 7);
    ASSERT_EQ(fs::file_size(files[2]), size);
    MakeLater(files[2]);
    EXPECT_EQ(WrongPixels<unsigned short>(ReadPart<unsigned short>(source, 1, 1)), 0u);
    ExpectParts(MessageOf([&] { ReadPart<unsigned short>(source, 2, 1); }), { files[2], "changed" });
    // the next one starts from what is there now
    const auto * const again = ReadPart<unsigned short>(source, 2, 1);
    EXPECT_EQ(again->GetPixel({ { 0, 0, 2 } }), ValueAt<unsigned short>(0, 0, 7));
  }
}

TEST_F(SensorNoiseFrameListSource, AnyNumberOfThreadsReadsWhatWasWritten)
{
  const std::vector<std::vector<std::string>> sources{ WriteList<unsigned short>(".tif"),
                                                       WriteList<unsigned short>(".png"),
                                                       { WriteStack<unsigned short>("s.tif") },
                                                       { WriteStack<unsigned short>("s.mha") } };
  for (const std::vector<std::string> & files : sources)
  {
    for (const unsigned int threads : { 1u, 2u, 3u, 9u })
    {
      const auto source = MakeSource<unsigned short>(files);
      source->SetNumberOfWorkUnits(threads);
      ReadPart<unsigned short>(source, 0, 3); // what is not read would be of these frames
      EXPECT_EQ(WrongPixels<unsigned short>(ReadPart<unsigned short>(source, 1, 3)), 0u) << files.front() << threads;
    }
  }
}

TEST_F(SensorNoiseFrameListSource, OfSeveralErrorsThatOfTheEarliestFrameIsSaid)
{
  const auto files = WriteList<unsigned short>(".tif");
  const auto list = OpenFrames(files);
  for (const std::size_t t : { 1, 2, 3 })
  {
    CutOff(files[t], 1);
  }
  for (const unsigned int threads : { 1u, 2u, 4u })
  {
    const auto source = MakeSource<unsigned short>(list);
    source->SetNumberOfWorkUnits(threads);
    ExpectParts(MessageOf([&] { source->Update(); }), { files[1] });
  }
}

TEST_F(SensorNoiseFrameListSource, FailsUntilTheFilesAreMended)
{
  const auto files = WriteList<unsigned short>(".tif");
  WriteFrame<unsigned short>("frame_1.tif", 1, { { width, height - 1 } });
  const auto source = MakeSource<unsigned short>(files);
  ExpectParts(MessageOf([&] { source->Update(); }), { files[1], "7 x 4 pixels" });
  ExpectParts(MessageOf([&] { source->Update(); }), { files[1], "7 x 4 pixels" });
  WriteFrame<unsigned short>("frame_1.tif", 1);
  EXPECT_EQ(MessageOf([&] { source->Update(); }), "no error");
  EXPECT_EQ(WrongPixels<unsigned short>(source->GetOutput()), 0u);
}

TEST_F(SensorNoiseFrameListSource, ASecondUpdateDoesNoWork)
{
  const auto   files = WriteList<unsigned short>(".mha");
  const auto   source = MakeSource<unsigned short>(files);
  unsigned int starts = 0;
  source->AddObserver(itk::StartEvent(), [&](const itk::EventObject &) { ++starts; });
  source->Update();
  source->Update();
  source->SetFileNames(files);
  source->Update();
  EXPECT_EQ(starts, 1u);
  source->SetFileName(files[2]);
  source->UpdateLargestPossibleRegion();
  EXPECT_EQ(starts, 2u);
  EXPECT_EQ(source->GetOutput()->GetBufferedRegion().GetSize(2), 1u);
  source->AddFileName(files[3]);
  source->UpdateLargestPossibleRegion();
  EXPECT_EQ(starts, 3u);
  EXPECT_EQ(source->GetFileNames(), (std::vector<std::string>{ files[2], files[3] }));
  EXPECT_EQ(source->GetOutput()->GetPixel({ { 0, 0, 1 } }), ValueAt<unsigned short>(0, 0, 3));
}

TEST_F(SensorNoiseFrameListSource, AnAbortEndsTheReadingAndTheNextUpdateIsRight)
{
  const auto source = MakeSource<unsigned short>(WriteList<unsigned short>(".tif"));
  source->SetNumberOfWorkUnits(2); // frames that are read at a time
  const auto tag = source->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    if (source->GetProgress() > 0.3F)
    {
      source->AbortGenerateDataOn();
    }
  });
  EXPECT_THROW(source->Update(), itk::ProcessAborted);
  EXPECT_LT(source->GetProgress(), 1.0F);
  source->RemoveObserver(tag);
  source->Update();
  EXPECT_EQ(WrongPixels<unsigned short>(source->GetOutput()), 0u);
}

TEST_F(SensorNoiseFrameListSource, GeometryIsThatOfTheFiles)
{
  const std::string header = "NDims = 3\nDimSize = 1 1 2\nElementType = MET_UCHAR\nOffset = 5 6 7\n";
  const auto        stack = MakeSource<unsigned char>(
    { WriteText("s.mha", header + "ElementSpacing = 0.5 0.25 2\nElementDataFile = LOCAL\nab") });
  stack->Update();
  EXPECT_EQ(stack->GetOutput()->GetSpacing()[1], 0.25);
  EXPECT_EQ(stack->GetOutput()->GetSpacing()[2], 2.0);
  EXPECT_EQ(stack->GetOutput()->GetOrigin()[2], 7.0);

  const std::string frame =
    "NDims = 2\nDimSize = 1 1\nElementType = MET_UCHAR\nOffset = 5 6\nTransformMatrix = 0 1 1 0\n";
  const std::vector<std::string> files{ WriteText("a.mha", frame + "ElementDataFile = LOCAL\na"),
                                        WriteText("b.mha", frame + "ElementDataFile = LOCAL\nb") };
  const auto                     list = MakeSource<unsigned char>(files);
  list->Update();
  EXPECT_EQ(list->GetOutput()->GetOrigin()[1], 6.0);
  EXPECT_EQ(list->GetOutput()->GetOrigin()[2], 0.0);
  EXPECT_EQ(list->GetOutput()->GetSpacing()[2], 1.0);
  EXPECT_EQ(list->GetOutput()->GetDirection()[0][1], 1.0);
  EXPECT_EQ(list->GetOutput()->GetDirection()[2][2], 1.0);
  EXPECT_EQ(list->GetOutput()->GetPixel({ { 0, 0, 1 } }), 'b');
}

// Some readers shift the digital numbers of such a file down by 4 bits: a gain of 1.1 becomes 0.069.
TEST_F(SensorNoiseFrameListSource, GreyValuesOfAPngAreReadUnchangedHoweverFewBitsAreSignificant)
{
  sensornoise::test::PngOf png;
  png.shift = 4;
  const std::string plain = WriteText("plain.png", png.Bytes());
  png.before = sensornoise::test::PngChunkOf("sBIT", "\x0C");
  const std::string marked = WriteText("marked.png", png.Bytes());
  const auto        source = MakeSource<unsigned short>({ plain, marked });
  source->Update();
  for (itk::IndexValueType x = 0; x < 13; ++x)
  {
    EXPECT_EQ(source->GetOutput()->GetPixel({ { x, 5, 0 } }), (7 * x + 100) << 4);
    EXPECT_EQ(source->GetOutput()->GetPixel({ { x, 5, 1 } }), (7 * x + 100) << 4);
  }
}

#ifdef __unix__
// The reader of ITK 5.2 does.
TEST_F(SensorNoiseFrameListSource, NothingIsPrintedAboutTagsThatAreNotKnown)
{
  sensornoise::test::TiffOf tiff;
  tiff.pages[1][65520] = { 4, { 7 } };
  const std::string file = WriteText("tag.tif", tiff.Bytes());
  ::testing::internal::CaptureStderr();
  MakeSource<unsigned short>({ file })->Update();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}
#endif

TEST_F(SensorNoiseFrameListSource, AFileThatIsNotAsTheFirstIsRefusedBeforeItIsInflated)
{
  sensornoise::test::PngOf png;
  const std::string        first = WriteText("first.png", png.Bytes());
  png.height = 5000;
  png.rows = std::string(27 * 5000, 'x'); // no filter is 'x': that would be the error, were it looked at
  const std::string other = WriteText("other.png", png.Bytes());
  OpeningIsRefusedWith({ first, other }, { other + ": 13 x 5000 pixels, but ", "first.png has 13 x 9" });
  std::vector<std::string> asked;
  OpenFrames({ first, first }, [&](const sensornoise::FrameFile & file) { asked.push_back(file.name); });
  EXPECT_EQ(asked, (std::vector<std::string>{ first, first }));
}

TEST_F(SensorNoiseFrameListSource, AFrameThatCannotBeHeldIsRefusedBeforeItIsInflated)
{
  const std::string header = "NDims = 3\nDimSize = 1000000 1000000 1000000\nElementType = MET_USHORT\n"
                             "CompressedData = True\nCompressedDataSize = 8\nElementDataFile = LOCAL\n";
  OpeningIsRefusedWith({ WriteText("huge.mha", header + "xxxxxxxx") },
                       { "huge.mha: a frame of 1000000 x 1000000 pixels needs 2", " of memory, but ", "are free" });
}

TEST_F(SensorNoiseFrameListSource, AFileThatIsThereTwiceIsSaid)
{
  std::vector<std::string> files = WriteList<unsigned short>(".tif");
  const auto               source = SourceType::New();
  source->SetFileNames(files);
  EXPECT_EQ(source->GetWarning(), "");
  const std::string link = files.front() + ".link.tif";
  fs::create_symlink(fs::absolute(files.front()), link);
  files.push_back(link);
  source->SetFileNames(files);
  EXPECT_EQ(source->GetWarning(),
            files.front() + ": is given twice, the second time as " + link + "; expected each frame once");
}

TEST_F(SensorNoiseFrameListSource, WithoutFilesItSaysWhatIsExpected)
{
  const auto source = SourceType::New();
  ExpectParts(MessageOf([&] { source->Update(); }), { "no file was given", "expected image files in time order" });
  ExpectParts(MessageOf([] { SourceType::ReadComponentType({}); }), { "no file was given" });
}

TEST_F(SensorNoiseFrameListSource, PrintsItsFiles)
{
  const auto         source = MakeSource<unsigned short>(WriteList<unsigned short>(".mha"));
  std::ostringstream before;
  source->Print(before);
  EXPECT_NE(before.str().find("FrameList: not checked yet"), std::string::npos);
  source->Update();
  std::ostringstream after;
  source->Print(after);
  for (const std::string text : { "FileNames: 4", "frame_3.mha", "7 x 5 pixels of type unsigned short, frames: 4" })
  {
    EXPECT_NE(after.str().find(text), std::string::npos) << text;
  }
}

} // namespace
