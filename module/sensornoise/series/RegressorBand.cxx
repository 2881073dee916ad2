// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/series/RegressorBand.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/series/FrameProducts.h"

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
      for (std::size_t x = width * cell / m_Cells; x < width * (cell + 1) / m_Cells; ++x)
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
  const Factors of{ m_Columns.data(), m_Order.data(), m_Series.data(), m_Pixels };
  for (std::size_t g = 0; g < m_Groups.size(); ++g)
  {
    MultiplyGroup(m_Groups[g], of, m_Sums[g]);
  }
  return m_Sums;
}

} // namespace sensornoise
