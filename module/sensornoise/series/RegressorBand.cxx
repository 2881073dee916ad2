// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/series/RegressorBand.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/WideVectors.h"
#include "sensornoise/series/FrameProducts.h"

#include <algorithm>
#include <numeric>

namespace sensornoise
{

namespace
{
/** What the sums of a group are made of. */
struct Factors
{
  const FrameRegressors::WeightedColumns * columns;
  const std::uint32_t *                    order;
  const double *                           series;
  std::size_t                              pixels; // from one series to the next
};

/** Sums over the pixels of \a group, a few columns at a time: theirs stay in registers. */
void
MultiplyGroup(const RegressorBand::Group & group, const Factors & of, RegressorBand::Sums & sums)
{
  constexpr std::size_t part = 4;
  using Columns = Eigen::Matrix<double, part, 1>;
  for (std::size_t first = 0; first < sums[0].size(); first += part)
  {
    Eigen::Matrix<double, part, RegressorBand::Together> sum;
    sum.setZero();
    for (std::size_t i = group.begin; i < group.end; ++i)
    {
      const double * const                                    v = of.series + of.order[i];
      const Eigen::Matrix<double, 1, RegressorBand::Together> values(
        v[0], v[of.pixels], v[2 * of.pixels], v[3 * of.pixels]);
      sum.noalias() += Eigen::Map<const Columns>(of.columns[i].data() + first) * values;
    }
    for (std::size_t k = 0; k < RegressorBand::Together; ++k)
    {
      Eigen::Map<Columns>(sums[k].data() + first) = sum.col(static_cast<Eigen::Index>(k));
    }
  }
}

#if defined(__GNUC__) && defined(__x86_64__)
/** The same with vectors of four: the same products and sums in the same order, so the same bits. The target has no
 * fused multiplication and addition, which would round differently. */
__attribute__((target("avx2"))) void
MultiplyGroupAvx2(const RegressorBand::Group & group, const Factors & of, RegressorBand::Sums & sums)
{
  using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
  constexpr std::size_t part = 2; // vectors of columns: with four series their sums take half of the registers
  for (std::size_t first = 0; first < sums[0].size(); first += 4 * part)
  {
    Four sum[RegressorBand::Together][part] = {};
    for (std::size_t i = group.begin; i < group.end; ++i)
    {
      const auto * const   columns = reinterpret_cast<const Four *>(of.columns[i].data() + first);
      const double * const values = of.series + of.order[i];
      for (std::size_t k = 0; k < RegressorBand::Together; ++k)
      {
        for (std::size_t j = 0; j < part; ++j)
        {
          sum[k][j] += columns[j] * values[k * of.pixels];
        }
      }
    }
    for (std::size_t k = 0; k < RegressorBand::Together; ++k)
    {
      std::copy_n(sum[k], part, reinterpret_cast<Four *>(sums[k].data() + first));
    }
  }
}
#endif

/** The quickest for this processor. */
auto
FindMultiplyGroup()
{
#if defined(__GNUC__) && defined(__x86_64__)
  return HasWideVectors() ? MultiplyGroupAvx2 : MultiplyGroup;
#else
  return MultiplyGroup;
#endif
}
} // namespace

RegressorBand::RegressorBand(const FrameRegressors & regressors, std::size_t cells)
  : m_Regressors(regressors)
  , m_Cells(cells)
{}

/** Calls function(pixel of the band, group) for the pixels that serve, row by row. */
template <typename TFunction>
void
RegressorBand::ForUsed(TFunction function) const
{
  const std::size_t width = m_Regressors.GetFrame().geometry.width;
  for (std::size_t row = 0; row < m_Pixels; row += width)
  {
    for (std::size_t cell = 0; cell < m_Cells; ++cell)
    {
      const std::size_t end = width * (cell + 1) / m_Cells;
      for (std::size_t x = width * cell / m_Cells; x < end; ++x)
      {
        const std::uint8_t gradientClass = m_Regressors.ClassOf(m_First + row + x);
        if (gradientClass != FrameRegressors::Unused)
        {
          function(row + x, cell * GradientClasses + gradientClass);
        }
      }
    }
  }
}

void
RegressorBand::MoveTo(std::size_t firstRow, std::size_t rows)
{
  const std::size_t width = m_Regressors.GetFrame().geometry.width;
  m_First = firstRow * width;
  m_Pixels = rows * width;
  m_Places.assign(m_Cells * GradientClasses + 1, 0);
  this->ForUsed([this](std::size_t, std::size_t group) { ++m_Places[group + 1]; });
  std::partial_sum(m_Places.begin(), m_Places.end(), m_Places.begin());
  m_Groups.clear();
  for (std::size_t group = 0; group + 1 < m_Places.size(); ++group)
  {
    if (m_Places[group + 1] > m_Places[group])
    {
      m_Groups.push_back({ group / GradientClasses, group % GradientClasses, m_Places[group], m_Places[group + 1] });
    }
  }
  m_Order.resize(m_Places.back());
  m_Columns.resize(m_Places.back());
  m_Series.resize(Together * m_Pixels);
  m_Sums.resize(m_Groups.size());
  this->ForUsed([this](std::size_t i, std::size_t group) {
    const std::size_t place = m_Places[group]++;
    m_Order[place] = static_cast<std::uint32_t>(i);
    m_Columns[place] = m_Regressors.WeightedColumnsOf(m_First + i, m_Regressors.ValuesOf(m_First + i));
  });
}

const std::vector<RegressorBand::Sums> &
RegressorBand::Multiply()
{
  static const auto multiplyGroup = FindMultiplyGroup();
  const Factors     of{ m_Columns.data(), m_Order.data(), m_Series.data(), m_Pixels };
  for (std::size_t g = 0; g < m_Groups.size(); ++g)
  {
    multiplyGroup(m_Groups[g], of, m_Sums[g]);
  }
  return m_Sums;
}

} // namespace sensornoise
