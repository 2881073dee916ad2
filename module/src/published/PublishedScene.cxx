// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedScene.h"

#include "base/NothingToMeasure.h"
#include "base/Text.h"
#include "base/Quantiles.h"
#include "base/ParallelWork.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "moments/StackFrames.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace sensornoise
{

double
IsoIntensitySet::EffectivePixels() const
{
  double squares = 0.0;
  for (const double weight : weights)
  {
    squares += weight * weight;
  }
  return squares > 0.0 ? 1.0 / squares : 0.0;
}

IsoIntensitySetFinder::IsoIntensitySetFinder(const double *       mean,
                                             const double *       variance,
                                             const std::uint8_t * mask,
                                             std::size_t          pixels,
                                             std::size_t          frames,
                                             const ParallelFor &  parallelFor)
  : m_Mean(mean)
  , m_Variance(variance)
  , m_Mask(mask)
  , m_Pixels(pixels)
  , m_Frames(frames)
  , m_Index(mean, mask, pixels, parallelFor)
{
  if (m_Index.Count() < IsoIntensitySet::MinimumPixels)
  {
    throw NothingToMeasure("only " + std::to_string(m_Index.Count()) +
                           " pixels are neither clipped nor moved by vibrations; expected at least " +
                           std::to_string(IsoIntensitySet::MinimumPixels) +
                           ". Record a scene between the clip levels with larger even areas");
  }
}

IsoIntensitySet
IsoIntensitySetFinder::Find(double quantile) const
{
  constexpr unsigned int quantileSteps = 4;
  constexpr unsigned int bandSteps = 12;
  const double           inwards = quantile < 0.5 ? 0.01 : -0.01;
  IsoIntensitySet        set;
  double                 band = 1.0;
  for (unsigned int step = 0; step <= quantileSteps + bandSteps; ++step)
  {
    if (step <= quantileSteps)
    {
      set.quantile = quantile + inwards * static_cast<double>(step);
      this->SetLevel(set);
    }
    else
    {
      band *= 2.0;
    }
    set.wideningSteps = step;
    set.bandSdDn = band * set.levelSdDn;
    this->Fill(set);
    if (set.pixels.size() >= IsoIntensitySet::MinimumPixels)
    {
      return set;
    }
  }
  throw NothingToMeasure("found " + std::to_string(set.pixels.size()) + " pixels of nearly the intensity " +
                         Rounded(set.levelDn) + " DN; expected at least " +
                         std::to_string(IsoIntensitySet::MinimumPixels) +
                         ". Record a scene with larger even areas, or use --method refined");
}

IsoIntensitySet
IsoIntensitySetFinder::FindRowSet(const IsoIntensitySet & bright) const
{
  IsoIntensitySet set = bright;
  set.bandSdDn = 2.0 * bright.bandSdDn;
  this->Fill(set);
  set.weights.assign(set.pixels.size(), 1.0 / static_cast<double>(set.pixels.size()));
  return set;
}

void
IsoIntensitySetFinder::SetLevel(IsoIntensitySet & set) const
{
  set.levelDn = m_Index.QuantileDn(set.quantile);
  const double        reach = m_Index.ReachDn(set.levelDn, std::max<std::size_t>(25, m_Index.Count() / 2000));
  std::vector<double> variances;
  for (std::size_t p = 0; p < m_Pixels; ++p)
  {
    if (m_Mask[p] != 0 && std::abs(m_Mean[p] - set.levelDn) <= reach)
    {
      variances.push_back(m_Variance[p]);
    }
  }
  set.temporalVarianceDn2 = Quantile(variances, 0.5);
  set.levelSdDn = std::sqrt(set.temporalVarianceDn2 / static_cast<double>(m_Frames));
}

void
IsoIntensitySetFinder::Fill(IsoIntensitySet & set) const
{
  const double sdDn = set.bandSdDn;
  set.pixels.clear();
  set.weights.clear();
  double total = 0.0;
  for (std::size_t p = 0; p < m_Pixels; ++p)
  {
    const double distance = std::abs(m_Mean[p] - set.levelDn);
    if (m_Mask[p] != 0 && distance <= 3.0 * sdDn)
    {
      const double deviation = distance / sdDn;
      const double weight = std::exp(-0.5 * deviation * deviation);
      set.pixels.push_back(static_cast<std::uint32_t>(p));
      set.weights.push_back(weight);
      total += weight;
    }
  }
  for (double & weight : set.weights)
  {
    weight /= total;
  }
}

namespace
{
PixelUse
UseOf(const PublishedScene &            scene,
      const FrameGeometry &             geometry,
      const std::vector<std::uint8_t> & mask,
      std::size_t                       p)
{
  const std::size_t x = p % geometry.width;
  const std::size_t y = p / geometry.width;
  if (!mask.empty() && mask[p] == 0)
  {
    return PixelUse::Masked;
  }
  if (scene.valid[p] == 0)
  {
    return std::isfinite(scene.variance[p]) ? PixelUse::Clipped : PixelUse::NotFinite;
  }
  if (x == 0 || y == 0 || x + 1 == geometry.width || y + 1 == geometry.height)
  {
    return PixelUse::Border;
  }
  if (scene.kept[p] != 0)
  {
    return PixelUse::Used;
  }
  return scene.variance[p] > 0.0 ? PixelUse::Vibration : PixelUse::Constant;
}
} // namespace

void
SortPixels(PublishedScene &                  scene,
           const PublishedSettings &         settings,
           const FrameGeometry &             geometry,
           std::size_t                       frames,
           const std::vector<std::uint8_t> & mask,
           const ParallelFor &               parallelFor)
{
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    scene.valid[p] = mask[p] != 0 ? scene.valid[p] : 0;
  }
  scene.kept = VibrationMask(scene.mean.data(),
                             scene.variance.data(),
                             scene.valid.data(),
                             geometry.width,
                             geometry.height,
                             frames,
                             settings.level,
                             parallelFor);
  scene.pixelUse.resize(geometry.Pixels());
  ForBlocks(geometry.Pixels(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      scene.pixelUse[p] = static_cast<std::uint8_t>(UseOf(scene, geometry, mask, p));
    }
  });
}

void
FindSets(PublishedScene &          scene,
         const PublishedSettings & settings,
         std::size_t               frames,
         const ParallelFor &       parallelFor)
{
  try
  {
    RequireDistinctFrames(frames, scene.valid);
    const IsoIntensitySetFinder finder(
      scene.mean.data(), scene.variance.data(), scene.kept.data(), scene.mean.size(), frames, parallelFor);
    ForAll(2, parallelFor, [&](std::size_t k) {
      (k == 0 ? scene.bright : scene.dark) = finder.Find(k == 0 ? settings.brightQuantile : settings.darkQuantile);
    });
    if (settings.rollingShutter != RollingShutter::Off)
    {
      scene.rowSet = finder.FindRowSet(scene.bright);
    }
  }
  catch (const NothingToMeasure & reason)
  {
    scene.failureReason = reason;
  }
}

} // namespace sensornoise
