// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/StoredReportFile.h"

#include "tools/ReportFile.h"
#include "itkImage.h"
#include "itkImageFileReader.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

namespace sensornoise::tools
{
namespace
{
using MapType = itk::Image<double, 2>;

MapType::Pointer
ReadMap(const std::string & folder, const char * map)
{
  const std::string name = (std::filesystem::path(folder) / map).string();
  if (!std::filesystem::is_regular_file(name))
  {
    throw std::runtime_error("there is no map " + name +
                             " (--maps); expected the folder that estimate-sensor-noise --dark ... --maps wrote");
  }
  const auto reader = itk::ImageFileReader<MapType>::New();
  reader->SetFileName(name);
  reader->Update();
  return reader->GetOutput();
}

std::vector<double>
ValuesOf(const MapType * map)
{
  const double * const values = map->GetBufferPointer();
  return { values, values + map->GetBufferedRegion().GetNumberOfPixels() };
}
} // namespace

StoredReport
ReadStoredReport(const std::string & file)
{
  return ValuesOfJson(file, ReadReportRecord(file));
}

StoredReport
ValuesOfJson(const std::string & name, const nlohmann::json & record)
{
  StoredReport stored;
  stored.name = name;
  const nlohmann::json flat = record.flatten();
  for (const auto & [pointer, value] : flat.items())
  {
    if (value.is_number())
    {
      stored.numbers[pointer] = value.get<double>();
    }
    else if (value.is_string())
    {
      stored.texts[pointer] = value.get<std::string>();
    }
  }
  return stored;
}

NoiseMaps
ReadNoiseMaps(const std::string & folder)
{
  const auto offset = ReadMap(folder, "pixel_offset.mha");
  const auto readNoise = ReadMap(folder, "pixel_read_noise.mha");
  const auto size = offset->GetBufferedRegion().GetSize();
  if (size != readNoise->GetBufferedRegion().GetSize())
  {
    throw std::runtime_error("the maps in " + folder +
                             " differ in their size; expected the maps of one estimate (--maps)");
  }
  return { size[0], size[1], ValuesOf(offset), ValuesOf(readNoise) };
}

} // namespace sensornoise::tools
