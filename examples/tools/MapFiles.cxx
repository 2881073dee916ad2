// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/MapFiles.h"

#include "tools/WriterErrors.h"
#include "itkImageFileWriter.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

template <typename TImage>
void
WriteMap(const TImage * image, const PendingFile & file)
{
  auto writer = itk::ImageFileWriter<TImage>::New();
  writer->SetInput(image);
  writer->SetFileName(file.Temporary().string());
  WriteNamed(file, [&] { writer->Update(); });
  file.RequireBytes(image->GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(typename TImage::PixelType));
}
} // namespace

std::vector<std::string>
MapFiles::NamesIn(const fs::path & folder, bool hasDark)
{
  std::vector<std::string> names;
  for (const char * map : { "mean", "variance", "corrected_variance", "pixel_use" })
  {
    names.push_back((folder / map).string() + ".mha");
  }
  for (const char * map : { "pixel_offset", "pixel_read_noise" })
  {
    for (const char * end : { "", "_low", "_high" })
    {
      if (hasDark)
      {
        names.push_back((folder / map).string() + end + ".mha");
      }
    }
  }
  return names;
}

MapFiles::MapFiles(const fs::path & folder, bool hasDark)
  : m_Folder(folder)
{
  std::error_code error;
  fs::path        path = folder;
  for (; !path.empty() && !fs::exists(path, error); path = path.parent_path())
  {
    m_Made.insert(m_Made.begin(), path);
  }
  if (fs::is_regular_file(path, error))
  {
    throw std::runtime_error("cannot write maps to " + folder.string() + " (--maps): " + path.string() +
                             " is a file; expected a folder");
  }
  for (const fs::path & made : m_Made)
  {
    m_AtSignal.emplace_back(fs::absolute(made, error).string());
    if (!fs::create_directory(made, error) && error)
    {
      throw std::runtime_error("cannot make the folder " + made.string() + " (--maps): " + error.message());
    }
  }
  for (const std::string & name : NamesIn(folder, hasDark))
  {
    m_Files.emplace_back(name);
  }
}

MapFiles::~MapFiles()
{
  m_Files.clear();
  for (auto path = m_Made.rbegin(); path != m_Made.rend(); ++path)
  {
    std::error_code stays; // a folder with files stays
    fs::remove(*path, stays);
  }
}

void
MapFiles::RemoveOldCalibration() const
{
  const std::vector<std::string> names = NamesIn(m_Folder, true);
  for (std::size_t i = m_Written; i < names.size(); ++i)
  {
    std::error_code error;
    fs::remove(names[i], error);
    if (error)
    {
      throw std::runtime_error("cannot remove " + names[i] +
                               " (--maps), which an earlier estimate wrote: " + error.message() +
                               "; expected a folder without it. Remove it, or write to another folder");
    }
  }
}

void
MapFiles::WriteCalibration(const IntervalMap & offset, const IntervalMap & readNoise)
{
  m_Written = 4;
  for (const MapType * map : { offset.value, offset.low, offset.high, readNoise.value, readNoise.low, readNoise.high })
  {
    WriteMap(map, m_Files.at(m_Written++));
  }
}

void
MapFiles::Write(const MapType *      mean,
                const MapType *      variance,
                const MapType *      correctedVariance,
                const PixelUseType * pixelUse)
{
  WriteMap(mean, m_Files[0]);
  WriteMap(variance, m_Files[1]);
  WriteMap(correctedVariance, m_Files[2]);
  WriteMap(pixelUse, m_Files[3]);
  m_Written = std::max<std::size_t>(m_Written, 4);
  RemoveOldCalibration();
  for (std::size_t i = 0; i < m_Written; ++i)
  {
    m_Files[i].Commit();
  }
}

} // namespace sensornoise::tools
