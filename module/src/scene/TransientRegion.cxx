// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Quantiles.h"
#include "scene/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace sensornoise
{

VarianceTiles::VarianceTiles(const VarianceSample &           sample,
                             const std::vector<std::size_t> & pixels,
                             const FrameGeometry &            geometry,
                             std::size_t                      frames)
  : m_Sample(sample)
  , m_Geometry(geometry)
  , m_Columns(std::clamp<std::size_t>(geometry.width / InCommon.leastCellWidth, 1, InCommon.mostCells))
  , m_Rows(std::clamp<std::size_t>(geometry.height / InCommon.leastCellWidth, 1, InCommon.mostCells))
  , m_CellOf(pixels.size())
{
  const auto dof = static_cast<double>(frames - 1);
  m_MedianRatio = ChiSquareQuantile(0.5, dof) / dof;
  std::transform(
    pixels.begin(), pixels.end(), m_CellOf.begin(), [this](std::size_t p) { return this->CellOfPixel(p); });
}

TileComparison
VarianceTiles::Compare(const VariancePrediction & prediction) const
{
  const std::size_t                count = m_Columns * m_Rows;
  std::vector<std::vector<double>> ratios(count);
  std::vector<double>              far(count, 0.0);
  for (std::size_t i = 0; i < m_Sample.Size(); ++i)
  {
    const std::size_t c = m_CellOf[i];
    ratios[c].push_back(m_Sample.raw[i] / (m_MedianRatio * prediction.variance[i]));
    far[c] += prediction.keep[i] != 0 ? 0.0 : 1.0;
  }
  TileComparison comparison;
  double         all = 0.0;
  for (std::size_t c = 0; c < count; ++c)
  {
    const auto pixels = static_cast<double>(ratios[c].size());
    if (ratios[c].size() < InScene.fewestPixelsOfMedian)
    {
      comparison.fits.push_back(CellFit::Unknown);
      continue;
    }
    const double median = Quantile(ratios[c], 0.5);
    const bool   isAbove = median > InScene.largestMedianRatio || far[c] > InCommon.largestOutlierFraction * pixels;
    const bool   isBelow = median < 1.0 / InScene.largestMedianRatio;
    comparison.fits.push_back(isAbove ? CellFit::Above : isBelow ? CellFit::Below : CellFit::Fits);
    (isAbove ? comparison.above : isBelow ? comparison.below : comparison.fitting) += pixels;
    all += pixels;
  }
  for (double * fraction : { &comparison.fitting, &comparison.below, &comparison.above })
  {
    *fraction /= std::max(1.0, all);
  }
  return comparison;
}

bool
VarianceTiles::AreIndependent(const TileComparison &            comparison,
                              const VariancePrediction &        prediction,
                              const std::vector<CellVariance> & variances) const
{
  std::vector<double> pixels(comparison.fits.size(), 0.0);
  std::vector<double> expected(comparison.fits.size(), 0.0);
  std::vector<double> excess(comparison.fits.size(), 0.0);
  for (std::size_t i = 0; i < m_Sample.Size(); ++i)
  {
    pixels[m_CellOf[i]] += 1.0;
    expected[m_CellOf[i]] += prediction.variance[i];
    excess[m_CellOf[i]] += m_Sample.raw[i] - prediction.variance[i];
  }
  std::vector<double> together; // number of pixels that change together, for each cell
  for (const CellVariance & own : variances)
  {
    const std::size_t c = this->CellOfPixel(own.pixel);
    if (comparison.fits[c] == CellFit::Above && excess[c] > 0.0)
    {
      together.push_back((own.perPixelDn2 * pixels[c] - expected[c]) / excess[c]);
    }
  }
  return together.size() >= InCommon.fewestCells && Quantile(together, 0.5) < InScene.mostPixelsTogether;
}

IlluminationTest
VarianceTiles::TestIllumination(const TileComparison &     comparison,
                                const VariancePrediction & prediction,
                                double                     largestRatio) const
{
  std::vector<std::vector<std::size_t>> pixels(comparison.fits.size());
  for (std::size_t i = 0; i < m_Sample.Size(); ++i)
  {
    if (comparison.fits[m_CellOf[i]] == CellFit::Above)
    {
      pixels[m_CellOf[i]].push_back(i);
    }
  }
  double cells = 0.0;
  double explained = 0.0;
  double excess = 0.0;
  double signal = 0.0;
  for (const std::vector<std::size_t> & own : pixels)
  {
    std::vector<double> flickers;
    for (const std::size_t i : own)
    {
      const double square = std::pow(m_Sample.TermsOf(i)(1) * m_Sample.scale, 2);
      flickers.push_back((m_Sample.raw[i] / m_MedianRatio - prediction.variance[i]) / (square + smallestDivisor));
      excess += m_Sample.raw[i] - prediction.variance[i];
      signal += square;
    }
    const double flicker = own.empty() ? 0.0 : std::max(0.0, Quantile(flickers, 0.5));
    double       off = 0.0;
    for (const std::size_t i : own)
    {
      const double square = std::pow(m_Sample.TermsOf(i)(1) * m_Sample.scale, 2);
      const double ratio = m_Sample.raw[i] / (prediction.variance[i] + flicker * square);
      off += ratio > largestRatio || ratio < 1.0 / largestRatio ? 1.0 : 0.0;
    }
    cells += own.empty() ? 0.0 : 1.0;
    explained += !own.empty() && off <= InCommon.largestOutlierFraction * static_cast<double>(own.size()) ? 1.0 : 0.0;
  }
  return { explained / std::max(1.0, cells), std::sqrt(std::max(0.0, excess / std::max(smallestDivisor, signal))) };
}

namespace
{
using Coefficients = VarianceSample::Coefficients;

/** A model of the variance, and the comparison of the cells of the frame with it. */
struct Candidate
{
  VariancePrediction prediction;
  TileComparison     comparison;

  double
  Score() const
  {
    return comparison.fitting - InScene.penaltyOfBelow * comparison.below;
  }
};

/** Sets negative variance components to 0. */
Coefficients
NotNegative(Coefficients theta)
{
  for (int k = 0; k + 1 < VarianceSample::Terms; ++k) // the last component is a covariance
  {
    theta(k) = std::max(0.0, theta(k));
  }
  return theta;
}

Coefficients
CoefficientsOf(const InitialNoiseModel & model, double scaleDn)
{
  Coefficients theta;
  theta << model.interceptDn2, model.slopeDn * scaleDn, model.flickerVariance * scaleDn * scaleDn,
    model.vibrationXPixels2, model.vibrationYPixels2, 2.0 * model.vibrationXY;
  return theta;
}

/** A rectangle of a frame, in units of its width and height. */
struct FramePart
{
  double left, right, top, bottom;
};

std::vector<FramePart>
PartsOfFrame()
{
  std::vector<FramePart> parts;
  for (const int count : { 3, 2 })
  {
    for (int i = 0; i < count; ++i)
    {
      const double begin = static_cast<double>(i) / count;
      const double end = static_cast<double>(i + 1) / count;
      parts.push_back({ 0.0, 1.0, begin, end });
      parts.push_back({ begin, end, 0.0, 1.0 });
    }
  }
  for (int i = 0; i < 9; ++i)
  {
    const int x = i / 3;
    const int y = i % 3;
    parts.push_back({ x / 3.0, (x + 1) / 3.0, y / 3.0, (y + 1) / 3.0 });
  }
  return parts;
}

std::vector<std::size_t>
PixelsOfPart(const std::vector<std::size_t> & pixels, const FrameGeometry & geometry, const FramePart & part)
{
  std::vector<std::size_t> own;
  std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(own), [&](std::size_t p) {
    const double x = static_cast<double>(p % geometry.width) / static_cast<double>(geometry.width);
    const double y = static_cast<double>(p / geometry.width) / static_cast<double>(geometry.height);
    return x >= part.left && x < part.right && y >= part.top && y < part.bottom;
  });
  return own;
}

/** Fits a model to \a part of the frame, extends it several times to all cells that fit it, and returns the best of
 * these models. */
Candidate
ExtendModel(const VarianceSample & part, const VarianceSample & whole, const VarianceTiles & cells, double largestRatio)
{
  VariancePrediction drawn = StartFromMedians(part);
  Coefficients       theta = Coefficients::Zero();
  for (int round = 0; round < 5; ++round)
  {
    theta = NotNegative(SolveKept(part, drawn));
    Predict(part, theta, largestRatio, drawn);
  }
  Candidate best;
  Candidate own;
  own.prediction.lowest = drawn.lowest;
  for (int round = 0; round < 6; ++round)
  {
    Predict(whole, theta, largestRatio, own.prediction);
    own.comparison = cells.Compare(own.prediction);
    if (round == 0 || own.Score() > best.Score())
    {
      best = own;
    }
    if (!(own.comparison.fitting > 0.0))
    {
      break;
    }
    for (std::size_t i = 0; i < whole.Size(); ++i)
    {
      own.prediction.keep[i] = own.comparison.fits[cells.CellOf(i)] == CellFit::Fits ? own.prediction.keep[i] : 0;
    }
    theta = NotNegative(SolveKept(whole, own.prediction));
  }
  return best;
}

/** Returns the number of cells of \a region within \a radius of a cell, and the number of all cells there. */
std::pair<std::size_t, std::size_t>
CountNear(const std::vector<std::uint8_t> & region, const VarianceTiles & cells, std::size_t c, std::size_t radius)
{
  const std::size_t x = c % cells.Columns();
  const std::size_t y = c / cells.Columns();
  std::size_t       count = 0;
  std::size_t       all = 0;
  for (std::size_t j = y - std::min(y, radius); j <= std::min(y + radius, cells.Rows() - 1); ++j)
  {
    for (std::size_t i = x - std::min(x, radius); i <= std::min(x + radius, cells.Columns() - 1); ++i)
    {
      count += region[j * cells.Columns() + i];
      ++all;
    }
  }
  return { count, all };
}

/** Adds the neighbours, which the object touches. Then adds cells most of whose 5 x 5 neighbours belong to the region,
 * until none is left. Where an object is as bright as its background, its variance is not visible. */
std::vector<std::uint8_t>
Close(const std::vector<std::uint8_t> & region, const VarianceTiles & cells)
{
  std::vector<std::uint8_t> closed(region.size());
  for (std::size_t c = 0; c < region.size(); ++c)
  {
    closed[c] = CountNear(region, cells, c, 1).first > 0 ? 1 : 0;
  }
  for (bool hasGrown = true; hasGrown;)
  {
    hasGrown = false;
    const std::vector<std::uint8_t> before = closed;
    for (std::size_t c = 0; c < region.size(); ++c)
    {
      const auto [count, all] = CountNear(before, cells, c, 2);
      if (before[c] == 0 && 2 * count > all)
      {
        closed[c] = 1;
        hasGrown = true;
      }
    }
  }
  return closed;
}

Candidate
FindBest(Candidate                        best,
         const ReferenceFrame &           frame,
         const InitialNoiseModel &        model,
         const std::vector<std::size_t> & pixels,
         const VarianceSample &           whole,
         const VarianceTiles &            cells)
{
  for (const FramePart & part : PartsOfFrame())
  {
    const std::vector<std::size_t> own = PixelsOfPart(pixels, frame.geometry, part);
    if (own.size() >= InScene.fewestPixels)
    {
      Candidate found = ExtendModel(SampleVariance(frame, own, model), whole, cells, model.largestRatio);
      if (found.Score() > best.Score())
      {
        best = std::move(found);
      }
    }
  }
  return best;
}
} // namespace

std::vector<std::uint8_t>
FindTransientRegion(const ReferenceFrame &            frame,
                    const InitialNoiseModel &         model,
                    const std::vector<CellVariance> & cellVariances)
{
  const std::vector<std::size_t> pixels = SamplePixels(frame.usable);
  const VarianceSample           sample = SampleVariance(frame, pixels, model);
  const VarianceTiles            cells(sample, pixels, frame.geometry, frame.frames);
  Candidate                      best;
  best.prediction.lowest = model.interceptDn2;
  Predict(sample, CoefficientsOf(model, sample.scale), model.largestRatio, best.prediction);
  best.comparison = cells.Compare(best.prediction);
  if (best.Score() >= InScene.enoughScore)
  {
    return {};
  }
  best = FindBest(std::move(best), frame, model, pixels, sample, cells);
  const IlluminationTest illumination = cells.TestIllumination(best.comparison, best.prediction, model.largestRatio);
  if ((illumination.explained >= InScene.leastIlluminationFraction &&
       illumination.modulation <= InScene.largestModulation) ||
      cells.AreIndependent(best.comparison, best.prediction, cellVariances))
  {
    return {};
  }
  std::vector<std::uint8_t> region(best.comparison.fits.size());
  std::transform(best.comparison.fits.begin(), best.comparison.fits.end(), region.begin(), [](CellFit fit) {
    return static_cast<std::uint8_t>(fit == CellFit::Above ? 1 : 0);
  });
  region = Close(region, cells);
  const auto staticPixels =
    std::count_if(pixels.begin(), pixels.end(), [&](std::size_t p) { return region[cells.CellOfPixel(p)] == 0; });
  if (static_cast<double>(staticPixels) < InScene.leastStaticFraction * static_cast<double>(pixels.size()) ||
      static_cast<std::size_t>(staticPixels) < InScene.fewestPixels) // the model is fitted to them
  {
    return {};
  }
  std::vector<std::uint8_t> transient(frame.mean.size());
  for (std::size_t p = 0; p < transient.size(); ++p)
  {
    transient[p] = region[cells.CellOfPixel(p)];
  }
  return transient;
}

} // namespace sensornoise
