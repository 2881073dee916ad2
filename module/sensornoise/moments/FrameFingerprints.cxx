// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/moments/FrameFingerprints.h"

#include "sensornoise/base/BinaryStream.h"

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
FrameFingerprints::TakeUp(std::size_t t, const BytesFingerprint & fingerprint)
{
  m_OfFrame[t] = fingerprint;
  std::size_t & first = m_First.try_emplace(fingerprint, t).first->second;
  first = std::min(first, t);
}

std::vector<std::uint8_t>
FrameFingerprints::Add(std::size_t first, const std::vector<BytesFingerprint> & fingerprints)
{
  std::vector<std::uint8_t> isNew(fingerprints.size());
  for (std::size_t k = 0; k < fingerprints.size(); ++k)
  {
    isNew[k] = m_First.count(fingerprints[k]) == 0 ? 1 : 0;
    this->TakeUp(first + k, fingerprints[k]);
  }
  return isNew;
}

void
FrameFingerprints::RequireApart(const FrameFingerprints & other) const
{
  for (const auto & [fingerprint, first] : m_First)
  {
    const auto equal = other.m_First.find(fingerprint);
    if (equal != other.m_First.end())
    {
      throw std::runtime_error("sums cannot be merged: frame " + std::to_string(std::max(first, equal->second)) +
                               " equals frame " + std::to_string(std::min(first, equal->second)) +
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
    this->TakeUp(t, fingerprint);
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
    if (t >= m_Frames)
    {
      throw std::runtime_error("the sums of a stream do not fit: found frame " + std::to_string(t) + " of " +
                               std::to_string(m_Frames));
    }
    other.TakeUp(t, fingerprint);
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
    originals[t] = found == m_OfFrame.end() ? t : m_First.at(found->second);
  }
  return DistinctFrames(std::move(originals));
}

} // namespace sensornoise
