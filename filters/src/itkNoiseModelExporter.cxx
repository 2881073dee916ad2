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
#include "itkNoiseModelExporter.h"

#include "itkSensorNoiseErrors.h"

#include <fstream>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace itk
{
namespace
{
std::string
BytesOfDng(const std::string & name)
{
  std::ifstream file(name, std::ios::binary);
  std::string   bytes{ std::istreambuf_iterator<char>(file), {} };
  if (!file || bytes.empty())
  {
    throw std::runtime_error("the DNG file " + name + " cannot be read, or is empty; expected a DNG file");
  }
  return bytes;
}
} // namespace

void
NoiseModelExporter::AddReport(const std::string & name)
{
  m_Reports.push_back(this->EndReport(name));
  this->Modified();
}

void
NoiseModelExporter::SetMaps(const Image<double, 2> * offset, const Image<double, 2> * readNoise)
{
  WithItkErrors(this, [&] {
    RequirePixels(offset, "the map of the offset");
    RequirePixels(readNoise, "the map of the read noise");
  });
  const auto values = [](const Image<double, 2> * map) {
    const double * const first = map->GetBufferPointer();
    return std::vector<double>(first, first + map->GetBufferedRegion().GetNumberOfPixels());
  };
  const auto size = offset->GetBufferedRegion().GetSize();
  m_Maps = { size[0], size[1], values(offset), values(readNoise) };
  this->Modified();
}

sensornoise::NoiseExport
NoiseModelExporter::MakeExport(const std::string & format) const
{
  sensornoise::ExportSettings settings = this->MakeExportSettings();
  settings.maxAnalogueIso = IfKnown(m_MaxAnalogueIso);
  std::string dng;
  if (!m_DngFile.empty())
  {
    if (format != "dng")
    {
      throw std::invalid_argument("a DNG file was given for the format " + format + "; expected the format dng");
    }
    dng = BytesOfDng(m_DngFile);
    sensornoise::SetLevelsOfDng(dng, settings);
  }
  std::vector<sensornoise::CameraNoise> noise;
  for (const sensornoise::StoredReport & report : m_Reports)
  {
    noise.push_back(sensornoise::ReadCameraNoise(report, settings));
  }
  if (!noise.empty())
  {
    noise.front().maps = m_Maps;
  }
  sensornoise::NoiseExport made = sensornoise::ExportNoise(format, noise);
  if (!m_DngFile.empty())
  {
    const std::string copy = sensornoise::WithNoiseProfile(dng, sensornoise::NoiseProfileOf(noise.front()));
    made.files = { { "noise_profile.dng", copy } };
  }
  return made;
}

void
NoiseModelExporter::Export(const std::string & format)
{
  m_Export = {};
  m_Export = WithItkErrors(this, [&] { return this->MakeExport(format); });
}

void
NoiseModelExporter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Reports: " << m_Reports.size() << '\n';
  os << indent << "MaxAnalogueIso: " << m_MaxAnalogueIso << '\n';
  os << indent << "DngFile: " << m_DngFile << '\n';
  os << indent << "Maps: " << m_Maps.width << " x " << m_Maps.height << '\n';
  os << indent << "Files: " << m_Export.files.size() << '\n';
}

} // namespace itk
