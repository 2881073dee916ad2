// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/series/RegressorBand.h"

#include "sensornoise/series/FrameProducts.h"

#include <numeric>

namespace sensornoise
{

RegressorBand::RegressorBand(const FrameRegressors & regressors,
                             std::size_t             firstRow,
                             std::size_t             rows,
                             std::size_t             cells)
  : m_First(firstRow * regressors.GetFrame().geometry.width)
  , m_Pixels(rows * regressors.GetFrame().geometry.width)
{
  const std::size_t        width = regressors.GetFrame().geometry.width;
  std::vector<std::size_t> begin(cells * GradientClasses + 1, 0);
  const auto               forUsed = [&](auto function) {
    for (std::size_t row = 0; row < rows; ++row)
    {
      for (std::size_t cell = 0; cell < cells; ++cell)
      {
        for (std::size_t x = width * cell / cells; x < width * (cell + 1) / cells; ++x)
        {
          const std::size_t  i = row * width + x;
          const std::uint8_t gradientClass = regressors.ClassOf(m_First + i);
          if (gradientClass != FrameRegressors::Unused)
          {
            function(i, cell * GradientClasses + gradientClass);
          }
        }
      }
    }
  };
  forUsed([&](std::size_t, std::size_t group) { ++begin[group + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (std::size_t group = 0; group + 1 < begin.size(); ++group)
  {
    if (begin[group + 1] > begin[group])
    {
      m_Groups.push_back({ group / GradientClasses, group % GradientClasses, begin[group], begin[group + 1] });
    }
  }
  m_Order.resize(begin.back());
  m_Columns.resize(begin.back());
  forUsed([&](std::size_t i, std::size_t group) {
    const std::size_t place = begin[group]++;
    m_Order[place] = static_cast<std::uint32_t>(i);
    m_Columns[place] = regressors.WeightedColumnsOf(m_First + i, regressors.ValuesOf(m_First + i));
  });
}

void
RegressorBand::Multiply(const std::vector<Vector> & values, std::vector<Sums> & sums) const
{
  constexpr Eigen::Index part = 4; // columns whose sums stay in registers
  sums.resize(m_Groups.size());
  for (std::size_t g = 0; g < m_Groups.size(); ++g)
  {
    for (Eigen::Index column = 0; column < Sums::RowsAtCompileTime; column += part)
    {
      Eigen::Matrix<double, part, Together> sum = Eigen::Matrix<double, part, Together>::Zero();
      for (std::size_t i = m_Groups[g].begin; i < m_Groups[g].end; ++i)
      {
        const Eigen::Map<const Eigen::Matrix<double, part, 1>> columns(m_Columns[i].data() + column);
        sum.noalias() += columns * values[m_Order[i]].transpose();
      }
      sums[g].middleRows<part>(column) = sum;
    }
  }
}

} // namespace sensornoise
