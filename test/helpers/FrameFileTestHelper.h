// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_FrameFileTestHelper_h
#define sensornoise_test_FrameFileTestHelper_h

#include "sensornoise/FrameFile.h"
#include "files/FrameFormats.h"
#include "helpers/FolderTestHelper.h"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <string>
#include <vector>

/** \file
 * Files made byte by byte, and what is said of them. */

namespace sensornoise::test
{

/** Returns the bytes with one bit changed, which is counted from the lowest of the first byte. */
inline std::string
WithChangedBit(std::string bytes, std::size_t bit)
{
  bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
  return bytes;
}

/** Writes into a folder of its own. */
class FrameFileTest : public FolderTest
{
protected:
  std::string
  Write(const std::string & name, const std::string & bytes) const
  {
    // file systems write at once what replaces a file, which takes milliseconds; not what is new
    std::filesystem::remove(Path(name));
    std::ofstream(Path(name), std::ios::binary) << bytes;
    return Path(name);
  }

  /** Returns the error of the inspection of a file of these bytes; "": it is accepted. */
  std::string
  SaidOf(const std::string & name, const std::string & bytes) const
  {
    const std::string file = Write(name, bytes);
    try
    {
      InspectFrameFile(file);
      return "";
    }
    catch (const FileError & error)
    {
      const std::string said = error.what();
      EXPECT_EQ(said.rfind(file, 0), 0u) << said;
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
      return said;
    }
  }

  /** Inspects the file with each of its bits changed, one at a time, and calls check(file, bit) for those that are
   * accepted. These are fewer than one bit of a byte. */
  template <typename TCheck>
  void
  ChangeEachBit(const std::string & name, const std::string & good, TCheck check) const
  {
    std::size_t accepted = 0;
    for (std::size_t bit = 0; bit < 8 * good.size() && !HasFatalFailure(); ++bit)
    {
      const std::string file = Write(name, WithChangedBit(good, bit));
      try
      {
        const FrameFile found = InspectFrameFile(file);
        ++accepted;
        check(found, bit);
      }
      catch (const FileError &)
      {}
    }
    EXPECT_LT(accepted, good.size());
  }

  void
  IsRefused(const std::string & name, const std::string & bytes, const std::vector<std::string> & parts) const
  {
    const std::string said = SaidOf(name, bytes);
    EXPECT_NE(said, "") << name << " was accepted, expected: " << parts.front();
    for (const std::string & part : parts)
    {
      EXPECT_NE(said.find(part), std::string::npos) << "\"" << part << "\" is not in: " << said;
    }
  }

  /** Expects that the file is accepted, and is of this size. */
  FrameFile
  IsFrames(const std::string & name,
           const std::string & bytes,
           FramePixel          pixel,
           std::size_t         width,
           std::size_t         height,
           std::size_t         frames) const
  {
    FrameFile file;
    EXPECT_EQ(SaidOf(name, bytes), "") << name;
    try
    {
      file = InspectFrameFile(Path(name));
    }
    catch (const FileError & error)
    {
      ADD_FAILURE() << error.what();
    }
    EXPECT_EQ(file.name, Path(name));
    EXPECT_EQ(file.width, width) << name;
    EXPECT_EQ(file.height, height) << name;
    EXPECT_EQ(file.frames, frames) << name;
    EXPECT_EQ(NameOf(file.pixel), NameOf(pixel)) << name;
    EXPECT_EQ(file.bytes, SizeOf(pixel) * width * height * frames) << name;
    return file;
  }
};

/** Returns the text with a part of it replaced, once. */
inline std::string
Replaced(std::string text, const std::string & part, const std::string & replacement)
{
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), replacement);
}

/** Bytes without a pattern, the same each time. */
inline std::string
RandomBytes(std::size_t count, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::string  bytes;
  for (std::size_t i = 0; i < count; ++i)
  {
    bytes += static_cast<char>(random() >> 24);
  }
  return bytes;
}

} // namespace sensornoise::test

#endif
