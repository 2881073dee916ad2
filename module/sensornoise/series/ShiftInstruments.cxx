// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/series/ShiftInstruments.h"

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/FirstTouch.h"
#include "sensornoise/series/Constants.h"

#include <algorithm>

namespace sensornoise
{

namespace
{
/** Adds \a weight times the values of \a from to those of \a to. */
void
AddScaled(const double * from, double weight, double * to, std::size_t count)
{
  std::transform(to, to + count, from, to, [weight](double sum, double value) { return sum + weight * value; });
}
/** \class DerivativeRows
 * \brief The derivative of the mean by a stencil over the pixels of two boxes, row by row; 0 where it reaches over the
 * border. */
class DerivativeRows
{
public:
  DerivativeRows(const ReferenceFrame & frame, StencilIndex k)
    : m_Frame(frame)
    , m_Taps(MotionStencils()[k].taps)
    , m_Row(frame.geometry.width)
  {}

  const double *
  operator()(std::size_t y)
  {
    constexpr double  side = 2.0 * static_cast<double>(InSeries.instrumentRadius) + 1.0;
    const std::size_t width = m_Frame.geometry.width;
    std::fill(m_Row.begin(), m_Row.end(), 0.0);
    if (y >= StencilMargin && y + StencilMargin < m_Frame.geometry.height && width > 2 * StencilMargin)
    {
      const std::size_t first = y * width + StencilMargin;
      const std::size_t count = width - 2 * StencilMargin;
      double * const    row = m_Row.data() + StencilMargin;
      for (const StencilTap & tap : m_Taps)
      {
        AddScaled(m_Frame.mean.data() + static_cast<std::ptrdiff_t>(first) + tap.Offset(width), tap.weight, row, count);
      }
      std::transform(row, row + count, row, [](double d) { return d / (side * side * side * side); });
    }
    return m_Row.data();
  }

private:
  const ReferenceFrame & m_Frame;
  const StencilTaps &    m_Taps;
  std::vector<double>    m_Row;
};
} // namespace

std::vector<double>
SmoothedDerivative(const ReferenceFrame & frame, StencilIndex k, const ParallelFor & parallelFor)
{
  const std::size_t width = frame.geometry.width;
  const std::size_t height = frame.geometry.height;
  const std::size_t radius = InSeries.instrumentRadius;
  const auto        boxSum = [&](const auto & makeSource) {
    auto sums = MakeMap<double>(frame.mean.size(), parallelFor);
    ForBoxRows(makeSource, width, height, radius, parallelFor, [&](std::size_t y, const double * row) {
      std::copy_n(row, width, sums.data() + y * width);
    });
    return sums;
  };
  const std::vector<double> once = boxSum([&] { return DerivativeRows(frame, k); });
  return boxSum([&] { return RowsOf(once, width); });
}

std::vector<double>
InstrumentWeight(const ReferenceFrame &            frame,
                 const ProvisionalModel &          model,
                 const std::vector<std::uint8_t> & mask,
                 const ParallelFor &               parallelFor)
{
  const std::size_t reach = InSeries.missingRadius;
  const std::size_t radius = InSeries.noiseRadius;
  const std::size_t width = frame.geometry.width;
  const std::size_t height = frame.geometry.height;
  const auto        missingRows = [&] {
    return [&, row = std::vector<std::uint8_t>(width)](std::size_t y) mutable {
      const bool isInner = y >= StencilMargin && y + StencilMargin < height;
      for (std::size_t x = 0; x < width; ++x)
      {
        const bool isMissing = isInner && x >= StencilMargin && x + StencilMargin < width && mask[y * width + x] == 0;
        row[x] = isMissing ? 1 : 0;
      }
      return row.data();
    };
  };
  const auto noiseRows = [&] {
    return [&, row = std::vector<double>(width)](std::size_t y) mutable {
      const double * const level = frame.neighbourMean.data() + y * width;
      std::transform(level, level + width, row.begin(), [&model](double own) { return model.NoiseVariance(own); });
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
  auto         weight = MakeMap<double>(mask.size(), parallelFor);
  ForBoxBands(height, parallelFor, [&](std::size_t first, std::size_t last) {
    BoxRows completes(RowsOf(complete, width), width, height, reach, first, last);
    BoxRows noises(noiseRows(), width, height, radius, first, last);
    for (std::size_t y = first; y < last; ++y)
    {
      const double * const near = completes.Next();
      std::transform(near, near + width, noises.Next(), weight.data() + y * width, [&](double whole, double smooth) {
        return whole * (side * side / (reachSide * reachSide * smooth));
      });
    }
  });
  return weight;
}

ShiftInstruments
MakeShiftInstruments(const ReferenceFrame &            frame,
                     const ProvisionalModel &          model,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor)
{
  ShiftInstruments instruments{ SmoothedDerivative(frame, StencilX, parallelFor),
                                SmoothedDerivative(frame, StencilY, parallelFor),
                                InstrumentWeight(frame, model, mask, parallelFor) };
  return instruments;
}

} // namespace sensornoise
