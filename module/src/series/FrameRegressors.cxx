// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameRegressors.h"

#include "base/BoxSum.h"
#include "base/ParallelWork.h"
#include "base/Quantiles.h"
#include "base/Stencils.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "scene/UsablePixels.h"
#include "scene/StaticScene.h"
#include "series/Constants.h"
#include "series/FrameEquations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** \class DerivativeRows
 * \brief Returns the derivative of the mean by a stencil, divided by the numbers of pixels of two boxes, row by row; 0
 * where it exceeds the border. */
class DerivativeRows
{
public:
  DerivativeRows(const ReferenceFrame & frame, StencilIndex k)
    : m_Frame(frame)
    , m_Taps(MotionStencils()[k].taps)
    , m_Row(frame.geometry.width)
    , m_Zeros(frame.geometry.width)
  {}

  const double *
  operator()(std::size_t y)
  {
    const std::size_t width = m_Frame.geometry.width;
    if (y < StencilMargin || y + StencilMargin >= m_Frame.geometry.height || width <= 2 * StencilMargin)
    {
      return m_Zeros.data();
    }
    constexpr double     side = 2.0 * static_cast<double>(InSeries.instrumentRadius) + 1.0;
    const double * const mean = m_Frame.mean.data() + y * width + StencilMargin;
    double * const       row = m_Row.data() + StencilMargin;
    const std::size_t    count = width - 2 * StencilMargin;
    for (const StencilTap * tap = m_Taps.begin(); tap != m_Taps.end(); ++tap)
    {
      const double         weight = tap->weight / (side * side * side * side);
      const bool           isFirst = tap == m_Taps.begin();
      const double * const from = mean + tap->Offset(width);
      for (std::size_t x = 0; x < count; ++x)
      {
        row[x] = (isFirst ? 0.0 : row[x]) + weight * from[x];
      }
    }
    return m_Row.data();
  }

private:
  const ReferenceFrame & m_Frame;
  const StencilTaps &    m_Taps;
  std::vector<double>    m_Row;
  std::vector<double>    m_Zeros;
};

/** \class BoxedRows
 * \brief The box sums of a source, as the source of the rows [first, last) of another BoxRows of the same radius. That
 * one reads each row twice: the rows between are kept. */
template <typename TSource>
class BoxedRows
{
public:
  BoxedRows(TSource source, const FrameGeometry & geometry, std::size_t radius, std::size_t first, std::size_t last)
    : m_Width(geometry.width)
    , m_Next(first - std::min(first, radius))
    , m_Kept(2 * radius + 2)
    , m_Sums(std::move(source),
             geometry.width,
             geometry.height,
             radius,
             m_Next,
             std::min(geometry.height, last + radius))
    , m_Rows(m_Kept * m_Width)
  {}

  const double *
  operator()(std::size_t y)
  {
    double * const row = m_Rows.data() + y % m_Kept * m_Width;
    if (y == m_Next)
    {
      std::copy_n(m_Sums.Next(), m_Width, row);
      ++m_Next;
    }
    return row;
  }

private:
  std::size_t         m_Width;
  std::size_t         m_Next;
  std::size_t         m_Kept;
  BoxRows<TSource>    m_Sums;
  std::vector<double> m_Rows;
};

template <typename TSource>
BoxedRows(TSource, const FrameGeometry &, std::size_t, std::size_t, std::size_t) -> BoxedRows<TSource>;
} // namespace

std::vector<float>
SmoothedDerivative(const ReferenceFrame & frame, StencilIndex k, const ParallelFor & parallelFor)
{
  const std::size_t width = frame.geometry.width;
  const std::size_t height = frame.geometry.height;
  const std::size_t radius = InSeries.instrumentRadius;
  auto              smoothed = MakeMap<float>(frame.mean.size(), parallelFor);
  ForBoxBands(height, parallelFor, [&](std::size_t first, std::size_t last) {
    BoxedRows once(DerivativeRows(frame, k), frame.geometry, radius, first, last);
    BoxRows   twice(std::move(once), width, height, radius, first, last);
    for (std::size_t y = first; y < last; ++y)
    {
      const double * const row = twice.Next();
      std::transform(
        row, row + width, smoothed.data() + y * width, [](double value) { return static_cast<float>(value); });
    }
  });
  return smoothed;
}

std::vector<float>
InstrumentWeight(const ReferenceFrame &            frame,
                 const InitialNoiseModel &         model,
                 const std::vector<std::uint8_t> & mask,
                 const ParallelFor &               parallelFor)
{
  const std::size_t reach = InSeries.missingRadius;
  const std::size_t radius = InSeries.noiseRadius;
  const std::size_t width = frame.geometry.width;
  const std::size_t height = frame.geometry.height;
  const auto        missingRows = [&] {
    return [&, row = std::vector<std::uint8_t>(width)](std::size_t y) mutable {
      const bool                 isInner = y >= StencilMargin && y + StencilMargin < height;
      const std::uint8_t * const own = mask.data() + y * width;
      for (std::size_t x = StencilMargin; x + StencilMargin < width; ++x)
      {
        row[x] = isInner && own[x] == 0 ? 1 : 0;
      }
      return row.data();
    };
  };
  const auto noiseRows = [&] {
    return [&, row = std::vector<double>(width)](std::size_t y) mutable {
      const InitialNoiseModel own = model; // a copy: it cannot alias the row, so that the loop is vectorized
      const float * const     level = frame.neighbourMean.data() + y * width;
      std::transform(level, level + width, row.begin(), [&own](float mean) { return own.NoiseVariance(mean); });
      return row.data();
    };
  };
  std::vector<std::uint8_t> complete(mask.size());
  ForBoxRows(missingRows, width, height, reach, parallelFor, [&](std::size_t y, const double * near) {
    std::transform(near, near + width, complete.data() + y * width, [](double missing) {
      return static_cast<std::uint8_t>(missing < 0.5);
    });
  });
  const double side = 2.0 * static_cast<double>(radius) + 1.0;
  const double reachSide = 2.0 * static_cast<double>(reach) + 1.0;
  auto         weight = MakeMap<float>(mask.size(), parallelFor);
  ForBoxBands(height, parallelFor, [&](std::size_t first, std::size_t last) {
    BoxRows completes(RowsOf(complete, width), width, height, reach, first, last);
    BoxRows noises(noiseRows(), width, height, radius, first, last);
    for (std::size_t y = first; y < last; ++y)
    {
      const double * const near = completes.Next();
      std::transform(near, near + width, noises.Next(), weight.data() + y * width, [=](double whole, double smooth) {
        return static_cast<float>(whole * (side * side / (reachSide * reachSide * smooth)));
      });
    }
  });
  return weight;
}

ShiftInstruments
MakeShiftInstruments(const ReferenceFrame &            frame,
                     const InitialNoiseModel &         model,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor)
{
  ShiftInstruments instruments{ SmoothedDerivative(frame, StencilX, parallelFor),
                                SmoothedDerivative(frame, StencilY, parallelFor),
                                InstrumentWeight(frame, model, mask, parallelFor) };
  return instruments;
}

namespace
{
using Edges = std::array<double, GradientClasses - 1>;

/** Sets the classes of the pixels of [first, last) that \a take selects, whose roughness is separated by \a edges.
 * Small arguments are passed by value: by reference they could alias the output, which prevents vectorization. */
void
FillClasses(const ReferenceFrame & frame,
            InitialNoiseModel      model,
            Edges                  edges,
            const std::uint8_t *   take,
            std::size_t            first,
            std::size_t            last,
            std::uint8_t *         classes)
{
  const double * const mean = frame.mean.data();
  const float * const  neighbourMean = frame.neighbourMean.data();
  const std::size_t    width = frame.geometry.width;
  for (std::size_t p = first; p < last; ++p)
  {
    // All edges are compared: a search would have unpredictable branches, which cost more.
    const double rough = StencilEnergyAt(mean, width, p) / model.NoiseVariance(neighbourMean[p]);
    unsigned int above = 0;
    for (const double edge : edges)
    {
      above += edge < rough ? 1 : 0;
    }
    classes[p] = static_cast<std::uint8_t>(take[p] != 0 ? above : FrameRegressors::Unused);
  }
}
} // namespace

FrameRegressors::FrameRegressors(const ReferenceFrame &            frame,
                                 const InitialNoiseModel &         model,
                                 const std::vector<std::uint8_t> & take,
                                 ShiftInstruments                  instruments,
                                 const ParallelFor &               parallelFor)
  : m_Frame(&frame)
  , m_Model(model)
  , m_ClassOf(frame.mean.size(), Unused)
  , m_Instruments(std::move(instruments))
{
  this->ClassifyPixels(take, parallelFor);
}

void
FrameRegressors::ClassifyPixels(const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor)
{
  const std::size_t width = m_Frame->geometry.width;
  const double *    mean = m_Frame->mean.data();
  const auto        roughness = [&](std::size_t p) {
    return StencilEnergyAt(mean, width, p) / m_Model.NoiseVariance(m_Frame->neighbourMean[p]);
  };
  std::vector<double> values;
  for (const std::size_t p : SamplePixels(take))
  {
    values.push_back(roughness(p));
  }
  Edges edges = InSeries.classEdges;
  for (double & edge : edges)
  {
    edge = values.empty() ? 0.0 : Quantile(values, edge);
  }
  ForInnerBlocks(m_Frame->geometry, parallelFor, [&](std::size_t begin, std::size_t end) {
    FillClasses(*m_Frame, m_Model, edges, take.data(), begin, end, m_ClassOf.data());
  });
  m_PixelsOfClass = SumBlocks<GradientClasses>(
    m_ClassOf.size(), parallelFor, [this](std::size_t begin, std::size_t end, auto & counts) {
      for (std::size_t c = 0; c < GradientClasses; ++c)
      {
        counts[c] = static_cast<double>(
          std::count(m_ClassOf.data() + begin, m_ClassOf.data() + end, static_cast<std::uint8_t>(c)));
      }
    });
}

FrameRegressors
MakeSceneRegressors(const StaticScene &               scene,
                    const std::vector<std::uint8_t> & outliers,
                    const ParallelFor &               parallelFor)
{
  const std::size_t         pixels = outliers.size();
  std::vector<std::uint8_t> take(pixels);
  std::vector<std::uint8_t> whole(pixels); // missing single pixels would roughen the instruments
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    const std::uint8_t * const why = outliers.data();
    const std::uint8_t * const usable = scene.frame.usable.data() + begin;
    std::transform(why + begin, why + end, usable, take.data() + begin, [](std::uint8_t own, std::uint8_t use) {
      return own == 0 ? use : std::uint8_t{ 0 };
    });
    std::transform(why + begin, why + end, usable, whole.data() + begin, [](std::uint8_t own, std::uint8_t use) {
      return own == 2 ? std::uint8_t{ 0 } : use;
    });
  });
  ShiftInstruments instruments = MakeShiftInstruments(scene.frame, scene.model, whole, parallelFor);
  return FrameRegressors(scene.frame, scene.model, take, std::move(instruments), parallelFor);
}

namespace
{
/** Number of different elements of a symmetric matrix of the columns. */
constexpr std::size_t Products = FrameColumns * (FrameColumns + 1) / 2;

/** Returns the columns of pixel \a p: 1, the mean minus the centre, and the derivatives of the mean. */
std::array<double, FrameColumns>
ColumnsOf(const FrameRegressors & regressors, std::size_t p)
{
  const ReferenceFrame &           frame = regressors.GetFrame();
  std::array<double, FrameColumns> columns{ 1.0, frame.mean[p] - regressors.GetModel().centreDn };
  const auto                       derivatives = ApplyStencils(frame.mean.data(), frame.geometry.width, p);
  std::copy(derivatives.begin(), derivatives.end(), columns.begin() + 2);
  return columns;
}

} // namespace

std::vector<FrameSums::ClassMatrix>
CovarianceOfProducts(const FrameRegressors & regressors, const PixelMap & variance, const ParallelFor & parallelFor)
{
  const std::vector<float> & level = regressors.GetFrame().neighbourMean;
  const std::vector<double>  sums =
    SumOverBlocks(level.size(), parallelFor, GradientClasses * Products, [&](std::size_t p, double * sum) {
      const std::size_t c = regressors.ClassOf(p);
      if (c == FrameRegressors::Unused)
      {
        return;
      }
      const double ofModel = regressors.GetModel().NoiseVariance(level[p]);
      const double own = std::isfinite(variance[p]) ? variance[p] : ofModel;
      const double weight = own / (ofModel * ofModel);
      const auto   columns = ColumnsOf(regressors, p);
      double *     product = sum + c * Products;
      for (std::size_t i = 0; i < FrameColumns; ++i)
      {
        const double weighted = weight * columns[i];
        for (std::size_t j = 0; j <= i; ++j)
        {
          *product++ += weighted * columns[j];
        }
      }
    });
  std::vector<FrameSums::ClassMatrix> covariance(GradientClasses);
  const double *                      product = sums.data();
  for (FrameSums::ClassMatrix & ofClass : covariance)
  {
    for (Eigen::Index i = 0; i < ofClass.rows(); ++i)
    {
      for (Eigen::Index j = 0; j <= i; ++j)
      {
        ofClass(i, j) = ofClass(j, i) = *product++;
      }
    }
  }
  return covariance;
}

} // namespace sensornoise
