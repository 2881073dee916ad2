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
#include "itkSensorNoiseImageIO.h"

#include "itkSensorNoiseFileErrors.h"
#include "itkSensorNoiseMetaData.h"
#include "files/FileBytes.h"
#include "files/FrameFormats.h"
#include "files/FrameReader.h"
#include "files/RawCameraFile.h"

#include <exception>
#include <vector>

namespace itk
{
namespace
{
/** The file's format by its head and name, unless ITK has a class of its own for it; null: none. */
const sensornoise::FrameFormat *
OurFormatOf(const std::string & name)
{
  sensornoise::FileBytes                 bytes(name);
  const sensornoise::FrameFormat * const format = sensornoise::FindFrameFormat(sensornoise::HeadOf(bytes), name);
  return format != nullptr && !format->hasITKReader ? format : nullptr;
}
} // namespace

SensorNoiseImageIO::SensorNoiseImageIO()
{
  this->SetNumberOfDimensions(3);
  this->SetNumberOfComponents(1);
  this->SetPixelType(IOPixelEnum::SCALAR);
  for (const char * const ending :
       { ".ser", ".fits", ".fit", ".fts", ".npy", ".pgm", ".mraw", ".cihx", ".cih", ".tif", ".tiff", ".dng",
         ".cr2", ".cr3",  ".nef", ".nrw", ".arw", ".raf", ".orf",  ".rw2",  ".pef", ".srw", ".3fr",  ".iiq" })
  {
    this->AddSupportedReadExtension(ending);
  }
}

void
SensorNoiseImageIO::SetRawLayout(const std::string & layout)
{
  if (m_RawLayout != layout)
  {
    m_RawLayout = layout;
    m_File = {};
    this->Modified();
  }
}

void
SensorNoiseImageIO::Inspect(const std::string & name)
{
  if (m_File.name == name)
  {
    try
    {
      sensornoise::RequireUnchanged(m_File);
      return;
    }
    catch (const std::exception &)
    {
      m_File = {}; // the file has changed: it is inspected again
    }
  }
  m_File = m_RawLayout.empty() ? sensornoise::InspectFrameFile(name)
                               : sensornoise::InspectRawFile(name, sensornoise::ReadRawLayout(m_RawLayout));
}

void
SensorNoiseImageIO::RequireWholeRawTiff(const std::string & name, unsigned int width, unsigned int height)
{
  WithFileErrors([&] {
    sensornoise::FileBytes bytes(name);
    sensornoise::RequireWholeRawTiff(name, bytes, width, height);
  });
}

bool
SensorNoiseImageIO::CanReadFile(const char * name)
{
  try
  {
    if (!m_RawLayout.empty())
    {
      this->Inspect(name);
      return true;
    }
    const sensornoise::FrameFormat * const format = OurFormatOf(name);
    if (format == nullptr)
    {
      return false;
    }
    if (format->name == std::string("camera raw"))
    {
      return true; // also if it cannot be read, so that ITK does not read its preview
    }
    this->Inspect(name);
    return m_File.format->name != std::string("TIFF") || m_File.frames > 1;
  }
  catch (const std::exception &)
  {
    return false;
  }
}

void
SensorNoiseImageIO::ReadImageInformation()
{
  WithFileErrors([this] { this->Inspect(this->GetFileName()); });
  const unsigned int dimensions = m_File.frames > 1 ? 3 : 2;
  this->SetNumberOfDimensions(dimensions);
  this->SetNumberOfComponents(1);
  this->SetPixelType(IOPixelEnum::SCALAR);
  this->SetComponentType(ComponentTypeOf(m_File.pixel));
  this->SetDimensions(0, m_File.width);
  this->SetDimensions(1, m_File.height);
  if (dimensions == 3)
  {
    this->SetDimensions(2, m_File.frames);
  }
  for (unsigned int axis = 0; axis < dimensions; ++axis)
  {
    this->SetSpacing(axis, m_File.geometry.spacing[axis]);
    this->SetOrigin(axis, m_File.geometry.origin[axis]);
    std::vector<double> direction;
    for (unsigned int row = 0; row < dimensions; ++row)
    {
      direction.push_back(m_File.geometry.direction[row][axis]);
    }
    this->SetDirection(axis, direction);
  }
  sensornoise::SetCameraSettings(this->GetMetaDataDictionary(), m_File.camera);
}

ImageIORegion
SensorNoiseImageIO::GenerateStreamableReadRegionFromRequestedRegion(const ImageIORegion & requested) const
{
  ImageIORegion region(this->GetNumberOfDimensions());
  for (unsigned int axis = 0; axis < this->GetNumberOfDimensions(); ++axis)
  {
    const bool isPart = axis == 2 && axis < requested.GetImageDimension() && this->GetUseStreamedReading();
    region.SetIndex(axis, isPart ? requested.GetIndex(axis) : 0);
    region.SetSize(axis, isPart ? requested.GetSize(axis) : this->GetDimensions(axis));
  }
  return region;
}

void
SensorNoiseImageIO::Read(void * buffer)
{
  const ImageIORegion region = this->GetIORegion();
  const bool          isPart = m_File.frames > 1 && region.GetImageDimension() > 2 && this->GetUseStreamedReading();
  const auto          first = isPart ? static_cast<std::size_t>(region.GetIndex(2)) : 0;
  const auto          count = isPart ? static_cast<std::size_t>(region.GetSize(2)) : m_File.frames;
  WithFileErrors([&] {
    sensornoise::RequireUnchanged(m_File);
    m_File.reader->Read(m_File, first, count, buffer);
    sensornoise::RequireUnchanged(m_File);
  });
}

void
SensorNoiseImageIO::Write(const void *)
{
  itkExceptionMacro(<< "this class writes no files; expected the class of another format, of .mha for instance");
}

void
SensorNoiseImageIO::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "RawLayout: " << (m_RawLayout.empty() ? "(none)" : m_RawLayout) << std::endl;
  os << indent << "File: " << (m_File.name.empty() ? "(none)" : m_File.name) << ", frames: " << m_File.frames
     << std::endl;
}

} // namespace itk
