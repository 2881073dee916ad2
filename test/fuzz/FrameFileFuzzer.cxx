// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
//
// Target of libFuzzer for one format of module/src/files/FrameFile.cxx: frame-file-fuzzer --format=NAME.
// test/fuzz/coverage_guided.sh builds and runs it.
//
// An input is one or several files. "%%FILE%%", a name and a line feed begin a file; the bytes in front of the first
// mark are a file with the name of the format. Every file that the format takes is inspected, and all of its pixels are
// read. FileError is the only error that an inspection may end with. After an inspection without an error the pixels
// must be readable, and must not depend on the order in which frames are read.
#include "sensornoise/FrameFile.h"
#include "files/FileBytes.h"
#include "files/FrameFormats.h"
#include "files/FrameReader.h"
#include "files/RawCameraFile.h"
#include "FuzzedPng.h"

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

extern "C" std::size_t
LLVMFuzzerMutate(std::uint8_t * data, std::size_t size, std::size_t maximumSize);

namespace
{
using sensornoise::FileError;
using sensornoise::FrameFile;

const std::string Mark = "%%FILE%%";

/** Files of an input; a MetaImage with a file for each of the eight frames has nine. */
constexpr std::size_t MostFiles = 16;

/** Pixels of a file that are read [bytes]. Compressed files of more are refused, as the tools refuse what exceeds their
 * memory limit. */
constexpr std::uint64_t MostPixelBytes = std::uint64_t{ 1 } << 24;

/** Size of the frames that coverage_seeds.py makes [pixels]. LibRaw, which is not part of this program, would report it
 * for a raw file of a camera. */
constexpr std::uint64_t SeedWidth = 8;
constexpr std::uint64_t SeedHeight = 4;

const sensornoise::FrameFormat * format = nullptr;
std::string                      folder;

/** Ends the program: libFuzzer keeps the input. */
[[noreturn]] void
Report(const std::string & finding)
{
  std::fprintf(stderr, "FINDING: %s\n", finding.c_str());
  std::abort();
}

/** Returns the name of the file in front of the first mark. Formats without a mark of their own are found by this name.
 */
std::string
DefaultName()
{
  static const std::map<std::string, std::string> names{ { "MetaImage", "s.mha" },
                                                         { "MRAW", "s.cihx" },
                                                         { "camera raw", "s.dng" } };
  const auto                                      found = names.find(format->name);
  return found == names.end() ? "s" : found->second;
}

/** Returns a name inside of the folder. */
std::string
SafeName(std::string name)
{
  std::replace_if(name.begin(), name.end(), [](char c) { return c == '/' || c == '\0'; }, '_');
  constexpr std::size_t longest = 64;
  name.resize(std::min(name.size(), longest));
  return name.empty() || name == "." || name == ".." ? "empty" : name;
}

/** Writes the files of an input. Returns their paths, each once. */
std::vector<std::string>
WriteFiles(const std::string & input)
{
  std::map<std::string, std::string> files;
  std::string                        name = DefaultName();
  std::size_t                        at = 0;
  while (at <= input.size() && files.size() < MostFiles)
  {
    const std::size_t mark = std::min(input.find(Mark, at), input.size());
    if (mark > 0)
    {
      files.emplace(name, input.substr(at, mark - at));
    }
    const std::size_t end = input.find('\n', mark);
    if (end == std::string::npos)
    {
      break;
    }
    name = SafeName(input.substr(mark + Mark.size(), end - std::min(end, mark + Mark.size())));
    at = end + 1;
  }
  std::vector<std::string> paths;
  for (const auto & [file, contents] : files)
  {
    paths.push_back(folder + "/" + file);
    std::ofstream(paths.back(), std::ios::binary) << contents;
  }
  return paths;
}

/** Reads all frames twice into different bytes: all at once, and one by one from the last to the first. */
void
ReadAllFrames(const FrameFile & file)
{
  const std::size_t frameBytes = file.width * file.height * SizeOf(file.pixel);
  if (file.reader == nullptr || file.format != format || file.bytes != frameBytes * file.frames || file.bytes == 0)
  {
    Report("the description contradicts itself");
  }
  std::vector<char> together(static_cast<std::size_t>(file.bytes), '\x00');
  file.reader->Read(file, 0, file.frames, together.data());
  for (std::size_t frame = file.frames; frame-- > 0;)
  {
    std::vector<char> single(frameBytes, '\xFF');
    file.reader->Read(file, frame, 1, single.data());
    if (std::memcmp(single.data(), together.data() + frame * frameBytes, frameBytes) != 0)
    {
      Report("frame " + std::to_string(frame) + " has other pixels when it is read alone");
    }
  }
}

void
RequireReadable(FrameFile file)
{
  try
  {
    ReadAllFrames(file);
    if (!file.axes.empty())
    {
      ChooseFrames(file, { 0, 0, false });
      ReadAllFrames(file);
    }
  }
  catch (const FileError & error)
  {
    Report(std::string("inspected without an error, but not readable: ") + error.what());
  }
}

void
TryFile(const std::string & path)
{
  try
  {
    sensornoise::FileBytes bytes(path);
    if (sensornoise::FindFrameFormat(HeadOf(bytes), path) != format)
    {
      return; // the target of another format
    }
    sensornoise::DataFilesOf(path);
    if (format->inspect == sensornoise::InspectRawCamera)
    {
      RequireWholeRawTiff(path, bytes, SeedWidth, SeedHeight);
    }
    const FrameFile file = sensornoise::InspectFrameFile(path, [](const FrameFile & found) {
      if (found.bytes > MostPixelBytes)
      {
        throw FileError(found.name, "more pixels than the target reads");
      }
    });
    if (file.bytes <= MostPixelBytes)
    {
      RequireReadable(file);
    }
  }
  catch (const FileError & error)
  {
    if (std::strchr(error.what(), '\n') != nullptr)
    {
      Report(std::string("a message of several lines: ") + error.what());
    }
  }
}
} // namespace

extern "C" int
LLVMFuzzerInitialize(int * count, char *** arguments)
{
  const std::string option = "--format=";
  for (int i = 1; i < *count; ++i)
  {
    const std::string argument = (*arguments)[i];
    if (argument.rfind(option, 0) == 0)
    {
      for (const sensornoise::FrameFormat & known : sensornoise::FrameFormats())
      {
        format = argument.substr(option.size()) == known.name ? &known : format;
      }
    }
  }
  if (format == nullptr)
  {
    std::fprintf(stderr, "expected %sNAME, one of: %s\n", option.c_str(), sensornoise::NamesOfFrameFormats().c_str());
    std::exit(2);
  }
  std::string pattern = (std::filesystem::temp_directory_path() / "fuzz-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr)
  {
    std::perror(pattern.c_str());
    std::exit(2);
  }
  folder = pattern;
  std::atexit([] { std::filesystem::remove_all(folder); });
  return 0;
}

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  const std::vector<std::string> paths = WriteFiles(std::string(reinterpret_cast<const char *>(data), size));
  for (const std::string & path : paths)
  {
    TryFile(path);
  }
  for (const std::string & path : paths)
  {
    unlink(path.c_str());
  }
  return 0;
}

extern "C" std::size_t
LLVMFuzzerCustomMutator(std::uint8_t * data, std::size_t size, std::size_t maximumSize, unsigned seed)
{
  return format->inspect == sensornoise::InspectPng ? MutatePng(data, size, maximumSize, seed)
                                                    : LLVMFuzzerMutate(data, size, maximumSize);
}
