// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackFrames.h"

#include "sensornoise/FrameGeometry.h"
#include "base/BinaryStream.h"
#include "base/Text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{

void
RequireStack(const FrameGeometry & geometry, std::size_t frames, std::size_t maskPixels)
{
  if (frames < MinimumFrames)
  {
    throw std::invalid_argument("the stack has " + CountText(frames, "frame") + "; expected at least " +
                                std::to_string(MinimumFrames) +
                                ". Give all frames of the burst, as a list, a folder or a stack, or measure each frame "
                                "by itself with --method single-image");
  }
  if (frames > MaximumFrames)
  {
    throw std::invalid_argument("the stack has " + std::to_string(frames) + " frames; expected at most " +
                                std::to_string(MaximumFrames) + ". Measure a part of them: --frames");
  }
  if (geometry.width < SmallestSide || geometry.height < SmallestSide)
  {
    throw std::invalid_argument("the frames have " + std::to_string(geometry.width) + " x " +
                                std::to_string(geometry.height) + " pixels; expected at least 3 x 3");
  }
  if (maskPixels != 0 && maskPixels != geometry.Pixels())
  {
    throw std::invalid_argument("the mask has " + std::to_string(maskPixels) + " pixels, but the frames have " +
                                std::to_string(geometry.Pixels()) + "; expected one value for each pixel");
  }
}

PassFrames::PassFrames(std::size_t frames)
  : m_Has(frames, 0)
{}

std::size_t
PassFrames::Add(std::size_t count)
{
  const std::size_t first = m_Next;
  if (count > m_Has.size() - first)
  {
    throw std::logic_error("pass " + std::to_string(m_Pass + 1) + " was given " + std::to_string(first + count) +
                           " frames; expected " + std::to_string(m_Has.size()));
  }
  const auto begin = m_Has.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = begin + static_cast<std::ptrdiff_t>(count);
  const auto twice = std::find(begin, end, std::uint8_t{ 1 });
  if (twice != end)
  {
    throw std::logic_error("frame " + std::to_string(twice - m_Has.begin()) + " of pass " + std::to_string(m_Pass + 1) +
                           " was given twice");
  }
  std::fill(begin, end, std::uint8_t{ 1 });
  m_Next += count;
  return first;
}

void
PassFrames::Skip(std::size_t count)
{
  if (count > m_Has.size() - m_Next)
  {
    throw std::logic_error("pass " + std::to_string(m_Pass + 1) + " was to skip " + std::to_string(count) +
                           " frames; " + std::to_string(m_Has.size() - m_Next) + " are left");
  }
  m_Next += count;
}

void
PassFrames::GoTo(std::size_t t)
{
  if (t >= m_Has.size())
  {
    throw std::logic_error("frame " + std::to_string(t) + " was given; expected one below " +
                           std::to_string(m_Has.size()));
  }
  m_Next = t;
}

void
PassFrames::Forget()
{
  std::fill(m_Has.begin(), m_Has.end(), std::uint8_t{ 0 });
  m_Next = 0;
}

void
PassFrames::RequireApart(const PassFrames & other) const
{
  for (std::size_t t = 0; t < m_Has.size(); ++t)
  {
    if (m_Has[t] != 0 && other.m_Has[t] != 0)
    {
      throw std::runtime_error("sums cannot be merged: both hold frame " + std::to_string(t));
    }
  }
}

void
PassFrames::Merge(const PassFrames & other)
{
  this->RequireApart(other);
  for (std::size_t t = 0; t < m_Has.size(); ++t)
  {
    m_Has[t] = m_Has[t] != 0 || other.m_Has[t] != 0 ? 1 : 0;
  }
}

void
PassFrames::EndPass()
{
  const auto count = static_cast<std::size_t>(std::count(m_Has.begin(), m_Has.end(), std::uint8_t{ 1 }));
  if (count != m_Has.size())
  {
    const auto missing = std::find(m_Has.begin(), m_Has.end(), std::uint8_t{ 0 });
    throw std::logic_error("pass " + std::to_string(m_Pass + 1) + " held " + std::to_string(count) +
                           " frames; expected " + std::to_string(m_Has.size()) + ": frame " +
                           std::to_string(missing - m_Has.begin()) + " is missing");
  }
  this->Forget();
  ++m_Pass;
}

void
PassFrames::Save(std::ostream & out) const
{
  WriteCount(out, m_Pass + 1);
  WriteNumbers(out, m_Has);
}

PassFrames
PassFrames::ReadOther(std::istream & in) const
{
  PassFrames other(m_Has.size());
  other.m_Pass = m_Pass;
  RequireCount("as the pass", ReadCount(in), m_Pass + 1);
  ReadNumbers(in, other.m_Has);
  return other;
}

DistinctFrames::DistinctFrames(std::vector<std::size_t> originals)
  : m_Originals(std::move(originals))
  , m_Places(m_Originals.size())
{
  for (std::size_t t = 0; t < m_Originals.size(); ++t)
  {
    m_Places[t] = m_Originals[t] == t ? m_Count++ : m_Places[m_Originals[t]];
  }
  m_Repeated = m_Originals.size() - m_Count;
}

DistinctFrames
DistinctFrames::Without(const std::vector<std::size_t> & leftOut) const
{
  DistinctFrames others = *this;
  for (const std::size_t t : leftOut)
  {
    others.m_Places[m_Originals[t]] = None;
  }
  others.m_Count = 0;
  for (std::size_t t = 0; t < m_Originals.size(); ++t)
  {
    std::size_t & place = others.m_Places[t];
    place = m_Originals[t] != t ? others.m_Places[m_Originals[t]] : place != None ? others.m_Count++ : None;
  }
  return others;
}

} // namespace sensornoise
