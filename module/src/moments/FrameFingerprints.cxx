// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FrameFingerprints.h"

#include "base/BinaryStream.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{

FrameFingerprints::FrameFingerprints(std::size_t frames)
  : m_Frames(frames)
{}

void
FrameFingerprints::SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere)
{
  if (areCountedElsewhere.size() != m_Frames)
  {
    throw std::invalid_argument("of " + std::to_string(areCountedElsewhere.size()) +
                                " frames it is said whether they are counted elsewhere; expected " +
                                std::to_string(m_Frames));
  }
  m_CountedElsewhere = areCountedElsewhere;
}

void
FrameFingerprints::TakeUp(std::size_t t, const BytesFingerprint & fingerprint, bool isCounted)
{
  m_OfFrame[t] = fingerprint;
  Equal & equal = m_Equal.try_emplace(fingerprint, Equal{ t, false }).first->second;
  equal.first = std::min(equal.first, t);
  equal.isCounted = equal.isCounted || isCounted;
}

std::vector<std::uint8_t>
FrameFingerprints::Add(std::size_t first, const std::vector<BytesFingerprint> & fingerprints)
{
  std::vector<std::uint8_t> isNew(fingerprints.size());
  for (std::size_t k = 0; k < fingerprints.size(); ++k)
  {
    const auto equal = m_Equal.find(fingerprints[k]);
    const bool isCounted = equal != m_Equal.end() && equal->second.isCounted;
    const bool isElsewhere = !m_CountedElsewhere.empty() && m_CountedElsewhere[first + k] != 0;
    isNew[k] = isCounted || isElsewhere ? 0 : 1;
    this->TakeUp(first + k, fingerprints[k], isNew[k] != 0);
  }
  return isNew;
}

void
FrameFingerprints::RequireApart(const FrameFingerprints & other) const
{
  for (const auto & [fingerprint, equal] : m_Equal)
  {
    const auto others = other.m_Equal.find(fingerprint);
    if (equal.isCounted && others != other.m_Equal.end() && others->second.isCounted)
    {
      const auto [first, second] = std::minmax(equal.first, others->second.first);
      throw std::runtime_error("sums cannot be merged: frame " + std::to_string(second) + " equals frame " +
                               std::to_string(first) +
                               ", and each was counted by another process; let one process read both, or merge the "
                               "sums of one before the other adds its frames");
    }
  }
}

void
FrameFingerprints::Merge(const FrameFingerprints & other)
{
  for (const auto & [t, fingerprint] : other.m_OfFrame)
  {
    this->TakeUp(t, fingerprint, other.m_Equal.at(fingerprint).isCounted);
  }
}

void
FrameFingerprints::Save(std::ostream & out) const
{
  WriteCount(out, m_OfFrame.size());
  for (const auto & [t, fingerprint] : m_OfFrame)
  {
    WriteCount(out, t);
    WriteNumbers(out, fingerprint.data(), fingerprint.size());
    WriteCount(out, m_Equal.at(fingerprint).isCounted ? 1 : 0);
  }
}

FrameFingerprints
FrameFingerprints::ReadOther(std::istream & in) const
{
  FrameFingerprints other(m_Frames);
  for (std::uint64_t count = ReadCount(in); count > 0; --count)
  {
    const std::uint64_t t = ReadCount(in);
    BytesFingerprint    fingerprint{};
    ReadNumbers(in, fingerprint.data(), fingerprint.size());
    const bool isCounted = ReadCount(in) != 0;
    if (t >= m_Frames)
    {
      throw std::runtime_error("the sums of a stream do not fit: found frame " + std::to_string(t) + " of " +
                               std::to_string(m_Frames));
    }
    other.TakeUp(t, fingerprint, isCounted);
  }
  return other;
}

DistinctFrames
FrameFingerprints::FindDistinct() const
{
  std::vector<std::size_t> originals(m_Frames);
  for (std::size_t t = 0; t < m_Frames; ++t)
  {
    const auto found = m_OfFrame.find(t);
    if (found == m_OfFrame.end())
    {
      originals[t] = t;
      continue;
    }
    const Equal & equal = m_Equal.at(found->second);
    if (!equal.isCounted)
    {
      throw std::logic_error("frame " + std::to_string(t) + " was left to another process, and none counted it");
    }
    originals[t] = equal.first;
  }
  return DistinctFrames(std::move(originals));
}

} // namespace sensornoise
