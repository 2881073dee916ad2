// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedPasses.h"

#include "base/BinaryStream.h"
#include "base/ParallelWork.h"
#include "base/Text.h"
#include "moments/StackMaps.h"
#include "published/PublishedScene.h"
#include "report/Quantities.h"
#include "report/StackReport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

template <typename TPixel>
PublishedPasses<TPixel>::PublishedPasses(const PublishedSettings &         settings,
                                         const FrameGeometry &             geometry,
                                         std::size_t                       frames,
                                         const std::vector<std::uint8_t> & mask,
                                         ParallelFor                       parallelFor)
  : Passes("PublishedMethod", geometry, frames, mask, std::move(parallelFor))
  , m_Settings(settings)
{
  settings.Validate();
}

template <typename TPixel>
void
PublishedPasses<TPixel>::AddDistinct(const std::vector<Plane> & planes,
                                     const TPixel *             frames,
                                     std::size_t                count,
                                     const ParallelFor &        parallelFor) const
{
  const bool areSummed = m_Sums.has_value();
  parallelFor(areSummed ? count : m_Geometry.height, [&](std::size_t part) {
    for (const auto & [passes, place] : planes)
    {
      auto & method = static_cast<PublishedPasses &>(*passes);
      if (areSummed)
      {
        method.m_Sums->AddFrame(frames + part * m_Layout.frame, place + part);
      }
      else
      {
        method.m_Correction->AddRow(frames, method.m_Layout, count, place, part);
      }
    }
  });
}

template <typename TPixel>
void
PublishedPasses<TPixel>::ForgetOwnSums()
{
  m_Sums ? m_Sums->Forget() : m_Correction->Forget();
}

template <typename TPixel>
void
PublishedPasses<TPixel>::SaveOwnSums(std::ostream & out) const
{
  m_Sums ? m_Sums->Save(out) : m_Correction->Save(out);
}

template <typename TPixel>
void
PublishedPasses<TPixel>::MergeOwnSums(std::istream & in)
{
  m_Sums ? m_Sums->Merge(in) : m_Correction->Merge(in);
}

template <typename TPixel>
void
PublishedPasses<TPixel>::AddFindings(Fingerprint & fingerprint) const
{
  fingerprint.Add(m_Scene.mean.data(), m_Scene.mean.size());
  fingerprint.Add(m_Scene.variance.data(), m_Scene.variance.size());
  fingerprint.Add(m_Scene.pixelUse.data(), m_Scene.pixelUse.size());
  fingerprint.Add(m_Flicker.gamma.data(), m_Flicker.gamma.size());
  fingerprint.Add(m_Flicker.gammaRows.data(), m_Flicker.gammaRows.size());
}

template <typename TPixel>
void
PublishedPasses<TPixel>::FinishMoments()
{
  m_Scene = this->EndMoments();
  if (!m_Scene.failureReason)
  {
    m_Sums.emplace(m_Scene.bright, m_Scene.dark, m_Scene.mean.data(), m_Geometry, m_Distinct.Count(), m_Scene.rowSet);
    m_Sums->SetLayout(m_Layout);
  }
}

template <typename TPixel>
void
PublishedPasses<TPixel>::FinishSums()
{
  if (m_Sums)
  {
    m_Flicker = EstimateFlicker(*m_Sums, m_Scene.bright, m_Scene.dark, m_Settings.rollingShutter, m_Settings.sigmaRows);
    m_Sums.reset(); // gives the memory back
    m_Correction.emplace(m_Flicker, m_Geometry, m_Distinct.Count(), m_ParallelFor);
    return;
  }
  m_IsDone = m_Correction || this->GetPass() >= Passes::NumberOfPasses;
  if (m_IsDone)
  {
    m_Corrected = this->EndCorrection();
    m_Correction.reset(); // gives the memory back
    m_Report = MakePublishedReport({ m_Settings, m_Geometry, m_Distinct.Count(), m_Scene, m_Flicker, m_Corrected },
                                   m_ParallelFor);
    FileStatuses(m_Report);
    DivideExcessNoise(m_Report, m_Settings.excessNoiseFactor);
    WarnOfMosaic(m_Report, m_Scene.mean, m_Geometry, m_ParallelFor);
    NoteMask(m_Report, m_Geometry, m_UserMask);
    ReportSceneChange(m_Report, m_Thumbnails.FindChange(m_Distinct.Counted()));
    ReportAllFrames(m_Report, m_Distinct, this->GetLeftOut());
  }
}

template <typename TPixel>
PublishedScene
PublishedPasses<TPixel>::EndMoments()
{
  StackMaps      maps = MakeStackMaps<TPixel>(m_Moments.Take(), m_Settings.dnSettings, m_ParallelFor, m_UserMask);
  PublishedScene scene;
  scene.summary = maps.summary;
  scene.mean = std::move(maps.mean);
  scene.variance = std::move(maps.variance);
  scene.valid = std::move(maps.valid);
  SortPixels(scene, m_Settings, m_Geometry, m_Distinct.Count(), m_UserMask, m_ParallelFor);
  FindSets(scene, m_Settings, m_Distinct.Count(), m_ParallelFor);
  return scene;
}

template <typename TPixel>
CorrectedMaps
PublishedPasses<TPixel>::EndCorrection() const
{
  CorrectedMaps maps{ {}, m_Scene.pixelUse };
  if (!m_Correction)
  {
    return maps;
  }
  const double dof = static_cast<double>(m_Distinct.Count() - 1);
  maps.variance = MakeMap<double>(m_Geometry.Pixels(), m_ParallelFor);
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

#define SensorNoise_INSTANTIATE(TPixel) template class PublishedPasses<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

void
PublishedSettings::Validate() const
{
  ChiSquare2Quantile(level);
  if (!(darkQuantile >= 0.0 && darkQuantile < brightQuantile && brightQuantile <= 1.0))
  {
    throw std::invalid_argument("the dark and bright quantiles are " + Text(darkQuantile) + " and " +
                                Text(brightQuantile) + "; expected 0 <= dark < bright <= 1");
  }
  if (rollingShutter == RollingShutter::Fixed)
  {
    ValidateShutterRows(sigmaRows);
  }
  if (shutterAxis > 1)
  {
    throw std::invalid_argument("the shutter axis is " + std::to_string(shutterAxis) + "; expected 0 (x) or 1 (y)");
  }
  ValidateDnSettings(dnSettings);
  ValidateExcessNoiseFactor(excessNoiseFactor);
}

template <typename TPixel>
PublishedMethod<TPixel>::PublishedMethod(const PublishedSettings &         settings,
                                         const FrameGeometry &             geometry,
                                         std::size_t                       frames,
                                         const std::vector<std::uint8_t> & mask,
                                         ParallelFor                       parallelFor)
  : StackMethod<TPixel>(
      std::make_unique<PublishedPasses<TPixel>>(settings, geometry, frames, mask, std::move(parallelFor)))
{}

#define SensorNoise_INSTANTIATE(TPixel) template class PublishedMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
