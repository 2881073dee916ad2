// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/MotionLeverage.h"

#include "base/Avx2.h"
#include "scene/ReferenceFrame.h"
#include "series/MotionSeries.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sensornoise
{

namespace
{
/** Adds the squares of a derivative along a row, times \a weight. Both pointers are at the first pixel that has a
 * derivative. */
template <std::size_t VStencil>
void
AddSquares(const double * row, std::size_t width, double weight, double * bounds)
{
  if (weight > 0.0)
  {
    for (std::size_t x = 0; x + 2 * StencilMargin < width; ++x)
    {
      const double derivative = detail::ValueOfStencil<VStencil>(row + x, static_cast<std::ptrdiff_t>(width));
      bounds[x] += weight * derivative * derivative;
    }
  }
}

template <std::size_t... VStencils>
void
AddAllSquares(const double *                               row,
              std::size_t                                  width,
              const std::array<double, NumberOfStencils> & weights,
              double *                                     bounds,
              std::index_sequence<VStencils...>)
{
  (AddSquares<VStencils>(row, width, weights[VStencils], bounds), ...);
}
} // namespace

MotionLeverage::MotionLeverage(const ReferenceFrame & frame, const MotionSeries & motion)
  : m_Frame(frame)
  , m_Motion(motion)
{
  const std::size_t size = motion.stencils.size();
  for (std::size_t k = 0; k < size; ++k)
  {
    m_Weights.at(motion.stencils[k]) = static_cast<double>(size) * motion.inverseGram.data()[k * size + k];
  }
}

void
MotionLeverage::FillBounds(std::size_t y, double * bounds) const
{
  const std::size_t    width = m_Frame.geometry.width;
  const double * const row = m_Frame.mean.data() + y * width;
  std::fill(bounds, bounds + width, 0.0);
  CallWithAvx2([this, row, width, bounds] {
    AddAllSquares(
      row + StencilMargin, width, m_Weights, bounds + StencilMargin, std::make_index_sequence<NumberOfStencils>());
  });
}

double
MotionLeverage::At(std::size_t p) const
{
  const std::size_t                    size = m_Motion.stencils.size();
  const auto                           all = ApplyStencils(m_Frame.mean.data(), m_Frame.geometry.width, p);
  std::array<double, NumberOfStencils> derivatives{};
  for (std::size_t k = 0; k < size; ++k)
  {
    derivatives[k] = all[m_Motion.stencils[k]];
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const double * inverse = m_Motion.inverseGram.data() + i * size;
    sum += derivatives[i] * std::inner_product(inverse, inverse + size, derivatives.begin(), 0.0);
  }
  return sum;
}

} // namespace sensornoise
