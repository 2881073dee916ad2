// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/published/PublishedMethod.h"

#include "sensornoise/base/BinaryStream.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/moments/StackMaps.h"
#include "sensornoise/moments/StackRequirements.h"
#include "sensornoise/report/RepeatedFrames.h"
#include "sensornoise/report/SceneChangeReport.h"
#include "sensornoise/report/StackReport.h"
#include "sensornoise/report/StackSettings.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
template <typename TPixel>
std::string
NameOfSums()
{
  return "PublishedMethod " + PixelName<TPixel>();
}
} // namespace

template <typename TPixel>
PublishedMethod<TPixel>::PublishedMethod(const PublishedSettings &         settings,
                                         const FrameGeometry &             geometry,
                                         std::size_t                       frames,
                                         const std::vector<std::uint8_t> & mask,
                                         ParallelFor                       parallelFor)
  : m_Settings(settings)
  , m_Geometry(geometry)
  , m_Frames(frames)
  , m_UserMask(mask)
  , m_ParallelFor(std::move(parallelFor))
  , m_InPass(frames)
  , m_Moments(geometry.Pixels(), frames)
  , m_Thumbnails(geometry, frames, mask)
{
  RequireStack(geometry, frames, mask.size());
  settings.Validate();
}

template <typename TPixel>
void
PublishedMethod<TPixel>::AddFrames(const TPixel * chunk, std::size_t frames)
{
  const std::size_t  pixels = m_Geometry.Pixels();
  const std::size_t  first = m_InPass.Add(frames);
  const unsigned int pass = m_InPass.GetPass();
  if (pass == 0)
  {
    m_Moments.AddFrames(chunk, first, frames, m_ParallelFor);
    m_Thumbnails.AddFrames(chunk, first, frames, m_ParallelFor);
  }
  else if (m_Sums || m_Correction)
  {
    m_Distinct.ForDistinct(
      chunk, pixels, first, frames, m_ParallelFor, [&](const TPixel * distinct, std::size_t place, std::size_t count) {
        if (pass == 1)
        {
          m_ParallelFor(count, [&](std::size_t k) { m_Sums->AddFrame(distinct + k * pixels, place + k); });
        }
        else
        {
          m_ParallelFor(m_Geometry.height,
                        [&](std::size_t y) { m_Correction->AddRow(distinct, pixels, count, place, y); });
        }
      });
  }
}

template <typename TPixel>
void
PublishedMethod<TPixel>::SkipFrames(std::size_t frames)
{
  m_InPass.Skip(frames);
}

template <typename TPixel>
void
PublishedMethod<TPixel>::GoTo(std::size_t t)
{
  m_InPass.GoTo(t);
}

template <typename TPixel>
void
PublishedMethod<TPixel>::ForgetSums()
{
  m_InPass.Forget();
  if (m_InPass.GetPass() == 0)
  {
    m_Moments = StackMoments<TPixel>(m_Geometry.Pixels(), m_Frames);
    m_Thumbnails = FrameThumbnails(m_Geometry, m_Frames, m_UserMask);
  }
  else if (m_Sums)
  {
    m_Sums->Forget();
  }
  else if (m_Correction)
  {
    m_Correction->Forget();
  }
}

template <typename TPixel>
void
PublishedMethod<TPixel>::SaveSums(std::ostream & out) const
{
  WriteSumsHeader(out, NameOfSums<TPixel>(), m_Geometry.Pixels(), m_Frames);
  m_InPass.Save(out);
  WriteCount(out, this->FingerprintOfPass());
  if (m_InPass.GetPass() == 0)
  {
    m_Thumbnails.Save(out);
    m_Moments.Save(out);
  }
  else if (m_Sums)
  {
    m_Sums->Save(out);
  }
  else if (m_Correction)
  {
    m_Correction->Save(out);
  }
}

template <typename TPixel>
void
PublishedMethod<TPixel>::MergeSums(std::istream & in)
{
  RequireCount("frames", ReadSumsHeader(in, NameOfSums<TPixel>(), m_Geometry.Pixels()), m_Frames);
  const PassFrames frames = m_InPass.ReadOther(in);
  m_InPass.RequireApart(frames);
  RequireSameStart(ReadCount(in), this->FingerprintOfPass());
  if (m_InPass.GetPass() == 0)
  {
    const FrameThumbnails thumbnails = m_Thumbnails.ReadOther(in);
    m_Moments.Merge(in);
    m_Thumbnails.Merge(thumbnails);
  }
  else if (m_Sums)
  {
    m_Sums->Merge(in);
  }
  else if (m_Correction)
  {
    m_Correction->Merge(in);
  }
  m_InPass.Merge(frames);
}

template <typename TPixel>
std::uint64_t
PublishedMethod<TPixel>::FingerprintOfPass() const
{
  Fingerprint       fingerprint;
  const std::size_t sizes[3] = { m_Geometry.width, m_Sums ? 1U : 0U, m_Correction ? 1U : 0U };
  fingerprint.Add(sizes, 3);
  fingerprint.Add(m_UserMask.data(), m_UserMask.size());
  fingerprint.Add(m_Distinct.Places().data(), m_Distinct.Given());
  fingerprint.Add(m_Scene.mean.data(), m_Scene.mean.size());
  fingerprint.Add(m_Scene.variance.data(), m_Scene.variance.size());
  fingerprint.Add(m_Scene.pixelUse.data(), m_Scene.pixelUse.size());
  fingerprint.Add(m_Flicker.gamma.data(), m_Flicker.gamma.size());
  fingerprint.Add(m_Flicker.gammaRows.data(), m_Flicker.gammaRows.size());
  return fingerprint.GetValue();
}

template <typename TPixel>
void
PublishedMethod<TPixel>::EndPass()
{
  const unsigned int pass = m_InPass.GetPass();
  m_InPass.EndPass();
  if (pass == 0)
  {
    m_Scene = this->EndMoments();
    if (!m_Scene.obstacle)
    {
      m_Sums.emplace(m_Scene.bright, m_Scene.dark, m_Scene.mean.data(), m_Geometry, m_Distinct.Count(), m_Scene.rowSet);
    }
  }
  else if (pass == 1 && m_Sums)
  {
    m_Flicker = EstimateFlicker(*m_Sums, m_Scene.bright, m_Scene.dark, m_Settings.rollingShutter, m_Settings.sigmaRows);
    m_Sums.reset(); // their memory
    m_Correction.emplace(m_Flicker, m_Geometry, m_Distinct.Count());
  }
  else if (pass + 1 == NumberOfPasses)
  {
    m_Corrected = this->EndCorrection();
    m_Correction.reset(); // their memory
    m_Report = MakePublishedReport({ m_Settings, m_Geometry, m_Distinct.Count(), m_Scene, m_Flicker, m_Corrected });
    WarnOfMosaic(m_Report, m_Scene.mean, m_Geometry, m_ParallelFor);
    NoteMask(m_Report, m_Geometry, m_UserMask);
    ReportSceneChange(m_Report, m_Thumbnails.FindChange());
    ReportAllFrames(m_Report, m_Distinct);
  }
}

template <typename TPixel>
PublishedScene
PublishedMethod<TPixel>::EndMoments()
{
  const std::size_t pixels = m_Geometry.Pixels();
  PublishedScene    scene;
  scene.mean.resize(pixels);
  scene.variance.resize(pixels);
  scene.valid.resize(pixels);
  m_Distinct = m_Moments.FindDistinct();
  scene.summary = MakeStackMaps<TPixel>(
    m_Moments.Take(), m_Settings.codes, m_ParallelFor, scene.mean.data(), scene.variance.data(), scene.valid.data());
  SortPixels(scene, m_Settings, m_Geometry, m_Distinct.Count(), m_UserMask);
  FindSets(scene, m_Settings, m_Distinct.Count());
  return scene;
}

template <typename TPixel>
CorrectedMaps
PublishedMethod<TPixel>::EndCorrection() const
{
  CorrectedMaps maps{ {}, m_Scene.pixelUse };
  if (!m_Correction)
  {
    return maps;
  }
  const double dof = static_cast<double>(m_Distinct.Count() - 1);
  maps.variance.resize(m_Geometry.Pixels());
  m_ParallelFor(m_Geometry.height, [&](std::size_t y) {
    for (std::size_t p = y * m_Geometry.width; p < (y + 1) * m_Geometry.width; ++p)
    {
      maps.variance[p] = m_Correction->GetVariance(p, m_Scene.mean[p], m_Scene.variance[p] * dof);
      if (m_Scene.kept[p] != 0 && !std::isfinite(maps.variance[p]))
      {
        maps.pixelUse[p] = static_cast<std::uint8_t>(PixelUse::FlickerUnknown);
      }
    }
  });
  return maps;
}

template class PublishedMethod<unsigned char>;
template class PublishedMethod<unsigned short>;
template class PublishedMethod<short>;
template class PublishedMethod<float>;
template class PublishedMethod<double>;

} // namespace sensornoise
