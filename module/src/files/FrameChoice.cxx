// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameFile.h"

#include "files/FrameReader.h"
#include "files/FrameSizes.h"

#include <memory>
#include <string>
#include <utility>

namespace sensornoise
{
namespace
{
/** Reads every so many-th frame of another reader. */
class EveryFrame : public FrameReader
{
public:
  EveryFrame(std::shared_ptr<const FrameReader> reader, std::size_t first, std::size_t step)
    : m_Reader(std::move(reader))
    , m_First(first)
    , m_Step(step)
  {}

  void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const override
  {
    const std::size_t frameBytes = file.width * file.height * SizeOf(file.pixel);
    for (std::size_t i = 0; i < count; ++i)
    {
      m_Reader->Read(file, m_First + (first + i) * m_Step, 1, static_cast<char *>(buffer) + i * frameBytes);
    }
  }

private:
  std::shared_ptr<const FrameReader> m_Reader;
  std::size_t                        m_First;
  std::size_t                        m_Step;
};

/** "3 channels, 5 planes and 20 times" */
std::string
DescribeAxes(const std::vector<FrameAxis> & axes)
{
  std::string text;
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    const char * const names = axes[i].kind == FrameAxis::Kind::Channel ? " channels"
                               : axes[i].kind == FrameAxis::Kind::Plane ? " planes"
                                                                        : " times";
    text += (i == 0 ? "" : i + 1 == axes.size() ? " and " : ", ") + std::to_string(axes[i].size) + names;
  }
  return text;
}

/** Which of the channels or planes is chosen. */
std::size_t
PlaceOnAxis(const FrameFile & file, const FrameAxis & axis, const std::optional<std::size_t> & chosen)
{
  const std::string option = axis.kind == FrameAxis::Kind::Channel ? "--channel" : "--plane";
  const std::string range = option + " 0 to " + std::to_string(axis.size - 1);
  if (!chosen)
  {
    throw FileError(file.name,
                    "has " + DescribeAxes(file.axes) + "; expected frames that differ in time alone: choose " + range);
  }
  if (*chosen >= axis.size)
  {
    throw FileError(file.name,
                    "has " + DescribeAxes(file.axes) + ", but " + option + " is " + std::to_string(*chosen) +
                      "; expected " + range);
  }
  return *chosen;
}

bool
HasAxis(const FrameFile & file, FrameAxis::Kind kind)
{
  for (const FrameAxis & axis : file.axes)
  {
    if (axis.kind == kind)
    {
      return true;
    }
  }
  return false;
}
} // namespace

void
ChooseFrames(FrameFile & file, const FrameChoice & choice)
{
  if (choice.all)
  {
    return;
  }
  const bool lacksChannels = choice.channel && *choice.channel > 0 && !HasAxis(file, FrameAxis::Kind::Channel);
  const bool lacksPlanes = choice.plane && *choice.plane > 0 && !HasAxis(file, FrameAxis::Kind::Plane);
  if (lacksChannels || lacksPlanes)
  {
    const std::string option =
      lacksChannels ? "--channel " + std::to_string(*choice.channel) : "--plane " + std::to_string(*choice.plane);
    throw FileError(file.name,
                    "says of no axis of its frames that it is of " +
                      std::string(lacksChannels ? "channels" : "planes") + ", but " + option +
                      " was given; leave it out");
  }
  if (file.axes.empty() || file.reader == nullptr)
  {
    return;
  }
  std::size_t first = 0;
  std::size_t stride = 1; // of the axis at hand
  std::size_t step = 1;   // from a time to the next
  std::size_t times = 1;
  for (const FrameAxis & axis : file.axes)
  {
    if (axis.kind == FrameAxis::Kind::Time)
    {
      step = stride;
      times = axis.size;
    }
    else
    {
      const bool isChannel = axis.kind == FrameAxis::Kind::Channel;
      first += stride * PlaceOnAxis(file, axis, isChannel ? choice.channel : choice.plane);
    }
    stride *= axis.size;
  }
  SetFrameSizes(file, { file.width, file.height, times });
  file.reader = std::make_shared<EveryFrame>(file.reader, first, step);
}

} // namespace sensornoise
