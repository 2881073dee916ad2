/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "input/FrameInput.h"
#include "input/FrameReader.h"
#include "input/InputError.h"
#include "itkImageFileWriter.h"
#include "itkImageRegionIteratorWithIndex.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using sensornoise::tools::InputError;
using sensornoise::tools::MakeReader;
using sensornoise::tools::OpenFrames;
using StackType = itk::Image<unsigned short, 3>;

unsigned short
ValueAt(const itk::Index<3> & index)
{
  return static_cast<unsigned short>(1 + 3 * index[0] + 50 * index[1] + 1000 * index[2]);
}

std::string
Contents(const std::string & file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

void
Overwrite(const std::string & file, const std::string & contents)
{
  std::ofstream(file, std::ios::binary) << contents;
}

std::string
Replaced(std::string text, const std::string & part, const std::string & replacement)
{
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), replacement);
}

std::size_t
WrongPixels(const StackType * stack)
{
  std::size_t                                       wrong = 0;
  itk::ImageRegionConstIteratorWithIndex<StackType> it(stack, stack->GetBufferedRegion());
  for (; !it.IsAtEnd(); ++it)
  {
    wrong += it.Get() != ValueAt(it.GetIndex()) ? 1 : 0;
  }
  return wrong;
}

void
OpeningIsRefusedWith(const std::string & file, const std::vector<std::string> & parts)
{
  std::string message = "no error";
  try
  {
    OpenFrames({ file });
  }
  catch (const InputError & error)
  {
    message = error.what();
  }
  for (const std::string & part : parts)
  {
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
  }
  EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line: " << message;
}

class MetaImageCompletenessTool : public testing::Test
{
protected:
  void
  SetUp() override
  {
    itk::Object::GlobalWarningDisplayOff();
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    // two builds may be tested at the same time
    m_Folder = fs::path(testing::TempDir()) / ("MetaImage" + test + std::to_string(std::random_device{}()));
    fs::create_directories(m_Folder);
  }
  void
  TearDown() override
  {
    fs::remove_all(m_Folder);
  }

  /** Four frames of 7 x 5, or of another size. */
  std::string
  WriteCompressed(const std::string & name, itk::Size<3> size = { { 7, 5, 4 } }) const
  {
    const auto stack = StackType::New();
    stack->SetRegions(size);
    stack->Allocate();
    for (itk::ImageRegionIteratorWithIndex<StackType> it(stack, stack->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      it.Set(ValueAt(it.GetIndex()));
    }
    const auto writer = itk::ImageFileWriter<StackType>::New();
    writer->SetFileName((m_Folder / name).string());
    writer->SetInput(stack);
    writer->SetUseCompression(true);
    writer->Update();
    return (m_Folder / name).string();
  }

  std::string
  Path(const std::string & name) const
  {
    return (m_Folder / name).string();
  }

  fs::path m_Folder;
};

TEST_F(MetaImageCompletenessTool, AChangedByteIsRefusedOrDoesNotMatter)
{
  for (const std::string name : { "s.mha", "s.mhd" })
  {
    const std::string file = WriteCompressed(name);
    const std::string dataFile = name == "s.mha" ? file : Path("s.zraw");
    const std::string good = Contents(dataFile);
    const std::string local = "ElementDataFile = LOCAL\n";
    const std::size_t first = name == "s.mha" ? good.find(local) + local.size() : 0;
    std::size_t       refused = 0;
    for (std::size_t at = first; at < good.size(); ++at)
    {
      std::string damaged = good;
      damaged[at] = static_cast<char>(~damaged[at]);
      Overwrite(dataFile, damaged);
      try
      {
        const auto reader = MakeReader<unsigned short>(OpenFrames({ file }));
        reader->Update();
        EXPECT_EQ(WrongPixels(reader->GetOutput()), 0u) << name << ", byte " << at;
      }
      catch (const InputError & error)
      {
        ++refused;
        const std::string message = error.what();
        EXPECT_EQ(message.rfind(file + ": damaged: its compressed pixels", 0), 0u) << message;
        EXPECT_NE(message.find(", expected 280 bytes and the end of the stream"), std::string::npos) << message;
        EXPECT_NE(message.find(dataFile), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      }
    }
    EXPECT_GE(refused + 2, good.size() - first) << name;
    Overwrite(dataFile, good);
    EXPECT_EQ(OpenFrames({ file }).frames, 4u);
  }
}

TEST_F(MetaImageCompletenessTool, ACutStreamOfTheSizeThatTheHeaderSaysIsRefused)
{
  const std::string file = WriteCompressed("s.mhd");
  const std::size_t size = fs::file_size(Path("s.zraw"));
  const std::string header = Contents(file);
  const std::string field = "CompressedDataSize = ";
  for (const std::size_t cut : { std::size_t{ 1 }, std::size_t{ 4 }, size / 2, size - 1 })
  {
    fs::resize_file(Path("s.zraw"), size - cut);
    Overwrite(file, Replaced(header, field + std::to_string(size), field + std::to_string(size - cut)));
    OpeningIsRefusedWith(file, { file, "damaged", "s.zraw give ", "an error (no end of the stream)", "expected 280" });
    WriteCompressed("s.mhd");
  }
}

TEST_F(MetaImageCompletenessTool, AWholeStreamOfTooFewOrTooManyPixelsIsRefused)
{
  const std::string file = WriteCompressed("s.mha");
  const std::string good = Contents(file);
  Overwrite(file, Replaced(good, "DimSize = 7 5 4", "DimSize = 7 5 5"));
  OpeningIsRefusedWith(file, { "s.mha: damaged: its compressed pixels give 280 bytes, expected 350 bytes" });
  Overwrite(file, Replaced(good, "DimSize = 7 5 4", "DimSize = 7 5 3"));
  OpeningIsRefusedWith(file, { "s.mha: damaged: its compressed pixels give more than 210 bytes, expected 210 bytes" });
}

TEST_F(MetaImageCompletenessTool, AStreamOfManyBlocksIsReadToItsEnd)
{
  const std::size_t width = 400;
  const std::size_t height = 300;
  const std::string file = WriteCompressed("s.mha", { { width, height, 9 } });
  EXPECT_EQ(OpenFrames({ file }).frames, 9u);
  std::string good = Contents(file);
  good.back() = static_cast<char>(~good.back());
  Overwrite(file, good);
  OpeningIsRefusedWith(file, { "give 2160000 bytes and then an error (incorrect data check), expected 2160000 bytes" });
}

TEST_F(MetaImageCompletenessTool, CompressedPixelsAtAnUnknownPlaceAreRefused)
{
  const std::string file = WriteCompressed("s.mhd");
  const std::string header = Contents(file);
  const std::string field = "ElementDataFile = ";
  Overwrite(file, Replaced(header, field, "HeaderSize = -1\n" + field));
  OpeningIsRefusedWith(file, { "s.mhd: compressed with a HeaderSize of -1" });
  Overwrite(file, Replaced(header, field + "s.zraw", field + "LIST\ns.zraw\ns.zraw\ns.zraw\ns.zraw"));
  OpeningIsRefusedWith(file, { "s.mhd: compressed with", "in a list of data files" });
}

} // namespace
