// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/LevelProjection.h"

#include "base/Eigen.h"
#include "base/NothingToMeasure.h"
#include "base/Quantiles.h"
#include "correlation/FrameSample.h"
#include "moments/StackFrames.h"
#include "refined/Constants.h"
#include "scene/InitialNoiseModel.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace sensornoise
{

namespace
{
/** Returns the basis of the frames' levels, centred and divided by their range. */
TemporalBasis
BasisOfLevels(const std::vector<double> & frameMeans)
{
  const auto   count = static_cast<double>(frameMeans.size());
  const double mean = std::accumulate(frameMeans.begin(), frameMeans.end(), 0.0) / count;
  const auto [lowest, highest] = std::minmax_element(frameMeans.begin(), frameMeans.end());
  std::vector<double> levels;
  levels.reserve(frameMeans.size());
  for (const double level : frameMeans)
  {
    levels.push_back((level - mean) / (*highest - *lowest));
  }
  const Eigen::MatrixXd none(static_cast<Eigen::Index>(frameMeans.size()), 0);
  return { levels, none, none };
}

/** Returns the least-squares slope of \a skew over the mean [1]. */
double
SlopeOfSkew(const ReferenceFrame & frame, const std::vector<float> & skew)
{
  const std::vector<std::size_t> pixels = SamplePixels(frame.usable);
  double                         level = 0.0;
  double                         centre = 0.0;
  for (const std::size_t p : pixels)
  {
    level += frame.mean[p] / static_cast<double>(pixels.size());
    centre += static_cast<double>(skew[p]) / static_cast<double>(pixels.size());
  }
  double products = 0.0;
  double squares = 0.0;
  for (const std::size_t p : pixels)
  {
    products += (frame.mean[p] - level) * (static_cast<double>(skew[p]) - centre);
    squares += (frame.mean[p] - level) * (frame.mean[p] - level);
  }
  return squares > 0.0 ? products / squares : 0.0;
}

/** Returns an approximate gain. The projection reduces shot noise by g times \a skew over \a freedom, so that the slope
 * of the residual variance over the level is too small by a known factor. */
double
RoughGain(const ReferenceFrame & frame, const std::vector<float> & skew, double dof)
{
  try
  {
    const double slope = FitInitialNoiseModel(frame).slopeDn;
    const double taken = SlopeOfSkew(frame, skew) / dof;
    return slope / std::max(InRefined.leastShotLeft, 1.0 - taken);
  }
  catch (const NothingToMeasure &)
  {
    return 0.0; // the same failure follows when the scene is made
  }
}
} // namespace

bool
AreLevelsSeries(const std::vector<double> & frameMeans)
{
  const bool areFinite =
    std::all_of(frameMeans.begin(), frameMeans.end(), [](double level) { return std::isfinite(level); });
  return areFinite && frameMeans.size() >= MinimumFrames &&
         *std::min_element(frameMeans.begin(), frameMeans.end()) <
           *std::max_element(frameMeans.begin(), frameMeans.end());
}

LevelProjection::LevelProjection(StackMaps                   maps,
                                 const FrameGeometry &       geometry,
                                 const PixelLayout &         layout,
                                 const std::vector<double> & frameMeans,
                                 bool                        withoutMerging,
                                 const ParallelFor &         parallelFor)
  : m_Summary(maps.summary)
  , m_Valid(std::move(maps.valid))
  , m_Frame(MakeReferenceFrame(std::move(maps.mean),
                               std::move(maps.variance),
                               m_Valid,
                               geometry,
                               frameMeans.size(),
                               parallelFor))
  , m_Projections(geometry,
                  FrameSample(),
                  BasisOfLevels(frameMeans),
                  { ProjectionSums::NumberOfSlabs(geometry.Pixels()), false, withoutMerging },
                  parallelFor)
{
  m_Projections.SetLayout(layout);
}

LevelProjection::Maps
LevelProjection::TakeMaps(const ParallelFor & parallelFor)
{
  m_Projections.EndPass(m_Frame);
  ResidualSquares     squares = m_Projections.TakeSquares();
  const double        dof = static_cast<double>(m_Frame.frames) - 2.0;
  std::vector<double> raw = std::move(m_Frame.variance);
  m_Frame.variance = std::move(squares.rss);
  ForPixels(raw.size(), parallelFor, [&](std::size_t p) { m_Frame.variance[p] /= dof; });
  const double gain = RoughGain(m_Frame, squares.skew, dof);
  ForPixels(raw.size(), parallelFor, [&](std::size_t p) {
    const double added = gain * static_cast<double>(squares.skew[p]) / dof;
    m_Frame.variance[p] += raw[p] > 0.0 ? added : 0.0; // the variance of a constant pixel stays 0
  });
  return { { m_Summary, std::move(m_Frame.mean), std::move(m_Frame.variance), std::move(m_Valid) }, std::move(raw) };
}

} // namespace sensornoise
