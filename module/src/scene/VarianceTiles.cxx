// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/VarianceTiles.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Quantiles.h"
#include "scene/Constants.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

VarianceTiles::VarianceTiles(const VarianceSample &           sample,
                             const std::vector<std::size_t> & pixels,
                             const FrameGeometry &            geometry,
                             std::size_t                      frames)
  : m_Sample(sample)
  , m_Geometry(geometry)
  , m_Columns(std::clamp<std::size_t>(geometry.width / InScene.leastCellWidth, 1, InScene.mostCells))
  , m_Rows(std::clamp<std::size_t>(geometry.height / InScene.leastCellWidth, 1, InScene.mostCells))
  , m_CellOf(pixels.size())
{
  const auto dof = static_cast<double>(frames - 1);
  m_MedianRatio = ChiSquareQuantile(0.5, dof) / dof;
  std::transform(
    pixels.begin(), pixels.end(), m_CellOf.begin(), [this](std::size_t p) { return this->CellOfPixel(p); });
}

TileComparison
VarianceTiles::Judge(const VariancePrediction & prediction) const
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
  TileComparison judged;
  double         all = 0.0;
  for (std::size_t c = 0; c < count; ++c)
  {
    const auto pixels = static_cast<double>(ratios[c].size());
    if (ratios[c].size() < InScene.fewestPixelsOfCell)
    {
      judged.fits.push_back(CellFit::Unknown);
      continue;
    }
    const double median = Quantile(ratios[c], 0.5);
    const bool   isAbove = median > InScene.largestMedianRatio || far[c] > InCommon.largestOutlierFraction * pixels;
    const bool   isBelow = median < 1.0 / InScene.largestMedianRatio;
    judged.fits.push_back(isAbove ? CellFit::Above : isBelow ? CellFit::Below : CellFit::Fits);
    (isAbove ? judged.above : isBelow ? judged.below : judged.fitting) += pixels;
    all += pixels;
  }
  for (double * share : { &judged.fitting, &judged.below, &judged.above })
  {
    *share /= std::max(1.0, all);
  }
  return judged;
}

IlluminationTest
VarianceTiles::FindLight(const TileComparison &     judged,
                         const VariancePrediction & prediction,
                         double                     largestRatio) const
{
  std::vector<std::vector<std::size_t>> pixels(judged.fits.size());
  for (std::size_t i = 0; i < m_Sample.Size(); ++i)
  {
    if (judged.fits[m_CellOf[i]] == CellFit::Above)
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
      flickers.push_back((m_Sample.raw[i] / m_MedianRatio - prediction.variance[i]) / (square + 1e-9));
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
  return { explained / std::max(1.0, cells), std::sqrt(std::max(0.0, excess / std::max(1e-30, signal))) };
}

} // namespace sensornoise
