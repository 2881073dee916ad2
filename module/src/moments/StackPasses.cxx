// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackPasses.h"

#include "base/BinaryStream.h"
#include "sensornoise/FrameGeometry.h"
#include "moments/StackFrames.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace sensornoise
{

template <typename TPixel>
StackPasses<TPixel>::StackPasses(const std::string &               method,
                                 const FrameGeometry &             geometry,
                                 std::size_t                       frames,
                                 const std::vector<std::uint8_t> & mask,
                                 ParallelFor                       parallelFor)
  : m_Geometry(geometry)
  , m_Layout(PixelLayout::OfFrames(geometry))
  , m_UserMask(mask)
  , m_ParallelFor(std::move(parallelFor))
  , m_Moments(geometry.Pixels(), frames, m_ParallelFor)
  , m_Thumbnails(geometry, frames, mask)
  , m_Name(method + " " + PixelName<TPixel>())
  , m_Frames(frames)
  , m_InPass(frames)
{
  RequireStack(geometry, frames, mask.size());
}

template <typename TPixel>
void
StackPasses<TPixel>::AddFrames(const TPixel * chunk, std::size_t frames)
{
  AddFrames({ this }, chunk, frames, m_ParallelFor);
}

template <typename TPixel>
void
StackPasses<TPixel>::AddFrames(const std::vector<StackPasses *> & planes,
                               const TPixel *                     mosaics,
                               std::size_t                        count,
                               const ParallelFor &                parallelFor)
{
  if (planes.front()->m_IsOfMoments)
  {
    AddToMoments(planes, mosaics, count, parallelFor);
    return;
  }
  if (count == 0)
  {
    return; // there may be no next frame, so that PlaceOf() would fail
  }
  std::vector<Plane> together;
  for (StackPasses * const plane : planes)
  {
    const DistinctFrames & distinct = plane->m_Distinct;
    const std::size_t      first = plane->m_InPass.Add(count);
    if (plane->HasSums() && distinct.AreDistinct(first, count))
    {
      together.push_back({ plane, distinct.PlaceOf(first) });
    }
    else if (plane->HasSums())
    {
      const auto add = [&](const TPixel * chosen, std::size_t place, std::size_t number) {
        plane->AddDistinct({ { plane, place } }, chosen, number, plane->m_ParallelFor);
      };
      distinct.ForDistinct(mosaics, plane->m_Layout.frame, first, count, plane->m_ParallelFor, add);
    }
  }
  if (!together.empty())
  {
    together.front().passes->AddDistinct(together, mosaics, count, parallelFor);
  }
}

template <typename TPixel>
void
StackPasses<TPixel>::AddToMoments(const std::vector<StackPasses *> & planes,
                                  const TPixel *                     frames,
                                  std::size_t                        count,
                                  const ParallelFor &                parallelFor)
{
  std::vector<typename StackMoments<TPixel>::Plane> moments;
  moments.reserve(planes.size());
  std::size_t first = 0; // the same for all planes
  for (StackPasses * const plane : planes)
  {
    const bool isFirst = plane->IsFirstPass();
    first = plane->m_InPass.Add(count);
    if (isFirst)
    {
      moments.push_back({ &plane->m_Moments, plane->m_Layout, plane->MaskOrNull() });
      plane->m_Thumbnails.AddFrames(frames, plane->m_Layout, first, count, parallelFor);
      continue;
    }
    plane->m_Distinct.ForRuns(first, count, [&, at = first](std::size_t begin, std::size_t number) {
      StackMoments<TPixel>::AddFrames({ { &plane->m_Moments, plane->m_Layout, plane->MaskOrNull() } },
                                      frames + (begin - at) * plane->m_Layout.frame,
                                      begin,
                                      number,
                                      parallelFor);
    });
  }
  if (!moments.empty())
  {
    StackMoments<TPixel>::AddFrames(moments, frames, first, count, parallelFor);
  }
}

template <typename TPixel>
void
StackPasses<TPixel>::RestartMoments()
{
  m_Moments = StackMoments<TPixel>(m_Geometry.Pixels(), m_Frames, m_ParallelFor);
}

template <typename TPixel>
void
StackPasses<TPixel>::ForgetSums()
{
  m_InPass.Forget();
  if (m_IsOfMoments)
  {
    this->RestartMoments();
    m_Thumbnails = this->IsFirstPass() ? FrameThumbnails(m_Geometry, m_Frames, m_UserMask) : m_Thumbnails;
  }
  else if (this->HasSums())
  {
    this->ForgetOwnSums();
  }
}

template <typename TPixel>
void
StackPasses<TPixel>::SaveSums(std::ostream & out) const
{
  WriteSumsHeader(out, m_Name, m_Geometry.Pixels(), m_Frames);
  m_InPass.Save(out);
  WriteCount(out, this->FingerprintOfPass());
  if (m_IsOfMoments)
  {
    m_Thumbnails.Save(out);
    m_Moments.Save(out);
  }
  else if (this->HasSums())
  {
    this->SaveOwnSums(out);
  }
}

template <typename TPixel>
void
StackPasses<TPixel>::MergeSums(std::istream & in)
{
  RequireCount("frames", ReadSumsHeader(in, m_Name, m_Geometry.Pixels()), m_Frames);
  const PassFrames frames = m_InPass.ReadOther(in);
  m_InPass.RequireApart(frames);
  RequireSameStart(ReadCount(in), this->FingerprintOfPass());
  if (m_IsOfMoments)
  {
    const FrameThumbnails thumbnails = m_Thumbnails.ReadOther(in);
    m_Moments.Merge(in);
    if (this->IsFirstPass()) // in later passes both have all thumbnails
    {
      m_Thumbnails.Merge(thumbnails);
    }
  }
  else if (this->HasSums())
  {
    this->MergeOwnSums(in);
  }
  m_InPass.Merge(frames);
}

namespace
{
/** Returns the frames \a originals and all frames that equal them, ascending. */
std::vector<LeftOutFrame>
WithRepeated(const std::vector<LeftOutFrame> & originals, const DistinctFrames & distinct)
{
  std::vector<LeftOutFrame> all;
  for (std::size_t t = 0; t < distinct.Given(); ++t)
  {
    const auto found = std::find_if(originals.begin(), originals.end(), [&](const LeftOutFrame & each) {
      return each.frame == distinct.OriginalOf(t);
    });
    if (found != originals.end())
    {
      all.push_back({ t, found->fault });
    }
  }
  return all;
}
} // namespace

template <typename TPixel>
std::vector<LeftOutFrame>
StackPasses<TPixel>::FindUnlike() const
{
  // Equal frames count as one, so that a frame is no less unlike because it is repeated.
  const DistinctFrames           distinct = m_Moments.FindDistinct();
  const std::vector<std::size_t> counted = distinct.Counted();
  std::vector<LeftOutFrame>      unlike = FindUnlikeFrames(m_Thumbnails.Of(counted));
  for (LeftOutFrame & each : unlike)
  {
    each.frame = counted[each.frame];
  }
  return WithRepeated(unlike, distinct);
}

template <typename TPixel>
void
StackPasses<TPixel>::EndPass()
{
  const bool isFirst = this->IsFirstPass();
  m_InPass.EndPass();
  m_Fingerprint.reset();
  if (!m_IsOfMoments)
  {
    this->FinishSums();
    return;
  }
  if (isFirst)
  {
    m_Distinct = m_Moments.FindDistinct();
    if (!m_LeftOut)
    {
      m_LeftOut = this->FindUnlike();
    }
    if (!m_LeftOut->empty())
    {
      m_Distinct = m_Distinct.Without(NumbersOf(*m_LeftOut));
      this->RestartMoments();
      return;
    }
  }
  m_IsOfMoments = false;
  this->FinishMoments();
}

template <typename TPixel>
bool
StackPasses<TPixel>::RestartWithoutFrames(const std::vector<std::size_t> & places,
                                          FrameFault                       fault,
                                          double                           largestFraction)
{
  const std::vector<std::size_t> counted = m_Distinct.Counted();
  std::vector<LeftOutFrame>      found;
  std::transform(places.begin(), places.end(), std::back_inserter(found), [&](std::size_t place) {
    return LeftOutFrame{ counted[place], fault };
  });
  // Equal frames count as one, here as in FindUnlike().
  std::vector<LeftOutFrame> before = this->GetLeftOut();
  before.erase(
    std::remove_if(before.begin(),
                   before.end(),
                   [this](const LeftOutFrame & each) { return m_Distinct.OriginalOf(each.frame) != each.frame; }),
    before.end());
  const std::size_t               originals = m_Distinct.Given() - m_Distinct.Repeated();
  const std::vector<LeftOutFrame> all = JoinUnlikeFrames({ before, found }, originals, largestFraction);
  if (found.empty() || all.empty())
  {
    return false;
  }
  m_LeftOut = WithRepeated(all, m_Distinct);
  m_Distinct = m_Distinct.Without(NumbersOf(found));
  m_IsOfMoments = true;
  this->RestartMoments();
  return true;
}

template <typename TPixel>
std::uint64_t
StackPasses<TPixel>::FingerprintOfPass() const
{
  if (!m_Fingerprint)
  {
    Fingerprint       fingerprint;
    const std::size_t sizes[2] = { m_Geometry.width, this->HasSums() ? 1U : 0U };
    fingerprint.Add(sizes, 2);
    fingerprint.Add(m_UserMask.data(), m_UserMask.size());
    fingerprint.Add(m_Distinct.Places().data(), m_Distinct.Given());
    this->AddFindings(fingerprint);
    m_Fingerprint = fingerprint.GetValue();
  }
  return *m_Fingerprint;
}

#define SensorNoise_INSTANTIATE(TPixel) template class StackPasses<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
