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
#include "itkSensorNoiseFrameListSource.h"

#include "itkSensorNoiseFileErrors.h"
#include "itkSensorNoiseMetaData.h"
#include "base/ParallelWork.h"
#include "files/FrameReader.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace itk
{
template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::SetFileNames(const std::vector<std::string> & names)
{
  if (m_FileNames != names)
  {
    m_FileNames = names;
    m_FrameList = {};
    m_IsOpen = false;
    this->Modified();
  }
}

template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::AddFileName(const std::string & name)
{
  std::vector<std::string> names = m_FileNames;
  names.push_back(name);
  this->SetFileNames(names);
}

template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::SetFileName(const std::string & name)
{
  this->SetFileNames({ name });
}

template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::SetRawLayout(const std::string & layout)
{
  if (m_RawLayout != layout)
  {
    m_RawLayout = layout;
    m_FrameList = {};
    m_IsOpen = false;
    this->Modified();
  }
}

template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::SetFrameList(const sensornoise::FrameList & list)
{
  m_FileNames = list.Names();
  m_FrameList = list;
  m_IsOpen = true;
  this->Modified();
}

template <typename TOutputStack>
const sensornoise::FrameList &
SensorNoiseFrameListSource<TOutputStack>::GetFrameList()
{
  if (!m_IsOpen)
  {
    m_FrameList = WithFileErrors([this] { return sensornoise::OpenFrames(m_FileNames, {}, m_RawLayout); });
    m_IsOpen = true;
  }
  return m_FrameList;
}

template <typename TOutputStack>
std::vector<std::string>
SensorNoiseFrameListSource<TOutputStack>::GetFilesRead()
{
  std::vector<std::string> names;
  for (const sensornoise::FrameFile & file : this->GetFrameList().files)
  {
    for (const sensornoise::FileIdentity & part : file.identities)
    {
      names.push_back(part.name);
    }
  }
  return names;
}

template <typename TOutputStack>
IOComponentEnum
SensorNoiseFrameListSource<TOutputStack>::GetComponentType()
{
  return ComponentTypeOf(this->GetFrameList().pixel);
}

template <typename TOutputStack>
IOComponentEnum
SensorNoiseFrameListSource<TOutputStack>::ReadComponentType(const std::vector<std::string> & names)
{
  return ComponentTypeOf(WithFileErrors([&] { return sensornoise::OpenFrames(names).pixel; }));
}

template <typename TOutputStack>
std::string
SensorNoiseFrameListSource<TOutputStack>::GetWarning()
{
  return sensornoise::WarningOf(this->GetFrameList());
}

template <typename TOutputStack>
bool
SensorNoiseFrameListSource<TOutputStack>::CanStream()
{
  this->GetFrameList(); // throws if the files do not make a stack
  return true;
}

template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::GenerateOutputInformation()
{
  const sensornoise::FrameList & list = this->GetFrameList();
  const IOComponentEnum          expected = ImageIOBase::MapPixelType<OutputPixelType>::CType;
  if (ComponentTypeOf(list.pixel) != expected)
  {
    std::string mine = ImageIOBase::GetComponentTypeAsString(expected);
    std::replace(mine.begin(), mine.end(), '_', ' ');
    const std::string sentence = list.files.front().name + ": component type " + sensornoise::NameOf(list.pixel) +
                                 ", but the source's is " + mine + ", and nothing is converted; expected a source of " +
                                 sensornoise::NameOf(list.pixel);
    throw ExceptionObject(__FILE__, __LINE__, sentence, ITK_LOCATION);
  }
  typename OutputStackType::SpacingType   spacing;
  typename OutputStackType::PointType     origin;
  typename OutputStackType::DirectionType direction;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    spacing[axis] = list.geometry.spacing[axis];
    origin[axis] = list.geometry.origin[axis];
    for (unsigned int row = 0; row < 3; ++row)
    {
      direction[row][axis] = list.geometry.direction[row][axis];
    }
  }
  OutputStackType * const output = this->GetOutput();
  output->SetSpacing(spacing);
  output->SetOrigin(origin);
  output->SetDirection(direction);
  const typename OutputRegionType::SizeType size{ { list.width, list.height, list.frames } };
  output->SetLargestPossibleRegion(OutputRegionType(size));
  sensornoise::SetCameraSettings(output->GetMetaDataDictionary(), list.camera);
}

template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::EnlargeOutputRequestedRegion(DataObject * output)
{
  auto * const     stack = itkDynamicCastInDebugMode<OutputStackType *>(output);
  OutputRegionType region = stack->GetLargestPossibleRegion();
  region.SetIndex(2, stack->GetRequestedRegion().GetIndex(2));
  region.SetSize(2, stack->GetRequestedRegion().GetSize(2));
  stack->SetRequestedRegion(region);
}

template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::GenerateData()
{
  this->AllocateOutputs();
  const OutputRegionType region = this->GetOutput()->GetRequestedRegion();
  const auto             frames = static_cast<std::size_t>(region.GetSize(2));
  const auto             first = static_cast<std::size_t>(region.GetIndex(2));
  const std::size_t      framePixels = m_FrameList.width * m_FrameList.height;
  OutputPixelType *      buffer = this->GetOutput()->GetBufferPointer();
  const bool             isSequential =
    m_FrameList.isStack && std::any_of(m_FrameList.files.begin(), m_FrameList.files.end(), [](const auto & file) {
      return file.reader->IsSequential();
    });
  const std::size_t parts = isSequential ? 1 : this->GetNumberOfWorkUnits();
  // A list is read frame by frame, because an abort may follow each frame.
  const std::size_t partFrames = m_FrameList.isStack ? std::max<std::size_t>(1, (frames + parts - 1) / parts) : 1;
  const std::size_t step = parts * partFrames;
  try
  {
    for (std::size_t done = 0; done < frames; done += step)
    {
      if (this->GetAbortGenerateData())
      {
        throw ProcessAborted(__FILE__, __LINE__);
      }
      const std::size_t end = std::min(frames, done + step);
      WithFileErrors([&] { this->ReadSideBySide(first + done, first + end, partFrames, buffer + done * framePixels); });
      this->UpdateProgress(static_cast<float>(end) / static_cast<float>(frames));
    }
  }
  catch (const ProcessAborted &)
  {
    throw;
  }
  catch (const ExceptionObject &)
  {
    m_IsOpen = false; // the next Update() opens the files again
    this->Modified();
    throw;
  }
}

template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::ReadSideBySide(std::size_t       first,
                                                         std::size_t       end,
                                                         std::size_t       partFrames,
                                                         OutputPixelType * buffer)
{
  const std::size_t parts = (end - first + partFrames - 1) / partFrames;
  const auto        sideBySide = [this](std::size_t count, const std::function<void(std::size_t)> & function) {
    this->GetMultiThreader()->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
    this->GetMultiThreader()->ParallelizeArray(0, count, function, nullptr);
  };
  const sensornoise::ParallelFor spread = parts == 1 ? sensornoise::ParallelFor(sensornoise::SerialFor) : sideBySide;
  sensornoise::ForAll(parts, spread, [&](std::size_t part) {
    const std::size_t begin = part * partFrames;
    sensornoise::ReadFrames(m_FrameList,
                            first + begin,
                            std::min(partFrames, end - first - begin),
                            buffer + begin * m_FrameList.width * m_FrameList.height);
  });
}

template <typename TOutputStack>
void
SensorNoiseFrameListSource<TOutputStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "FileNames: " << m_FileNames.size() << std::endl;
  for (const std::string & name : m_FileNames)
  {
    os << indent.GetNextIndent() << name << std::endl;
  }
  os << indent << "RawLayout: " << (m_RawLayout.empty() ? "(none)" : m_RawLayout) << std::endl;
  os << indent << "FrameList: ";
  if (m_IsOpen)
  {
    os << sensornoise::DescribeFrame(m_FrameList) << ", frames: " << m_FrameList.frames << std::endl;
  }
  else
  {
    os << "not checked yet" << std::endl;
  }
}

#define SensorNoise_INSTANTIATE(TPixel) template class SensorNoiseFrameListSource<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
