// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/PassFrames.h"

#include "base/BinaryStream.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>

namespace sensornoise
{

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
    throw std::logic_error("pass " + std::to_string(m_Pass + 1) + " was told to skip " + std::to_string(count) +
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

} // namespace sensornoise
