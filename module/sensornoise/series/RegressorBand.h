/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_series_RegressorBand_h
#define sensornoise_series_RegressorBand_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/series/FrameProducts.h"
#include "sensornoise/series/FrameRegressors.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sensornoise
{

/** \class RegressorBand
 * \brief The rows of FrameRegressors over a few lines of the image, ordered by cell and class, and their inner products
 * with series.
 *
 * Whole lines are read from memory in one piece; the rows stay in the second-level cache while all frames pass, and the
 * sums of one cell and class in registers. */
class RegressorBand
{
public:
  static constexpr std::size_t Together = 4; // series whose sums stay in registers

  using Vector = Eigen::Matrix<double, Together, 1>; // the values of series at a pixel
  using Sums = Eigen::Matrix<double, FrameRegressors::Row{}.size(), Together>;

  /** The pixels of one class in one cell of the band, which has \a cells cells side by side. */
  struct Group
  {
    std::size_t cell;
    std::size_t gradientClass;
    std::size_t begin;
    std::size_t end;
  };

  RegressorBand(const FrameRegressors & regressors, std::size_t firstLine, std::size_t lines, std::size_t cells)
    : m_First(firstLine * regressors.GetFrame().geometry.width)
    , m_Pixels(lines * regressors.GetFrame().geometry.width)
  {
    const std::size_t        width = regressors.GetFrame().geometry.width;
    std::vector<std::size_t> begin(cells * GradientClasses + 1, 0);
    const auto               forUsed = [&](auto function) {
      for (std::size_t line = 0; line < lines; ++line)
      {
        for (std::size_t cell = 0; cell < cells; ++cell)
        {
          for (std::size_t x = width * cell / cells; x < width * (cell + 1) / cells; ++x)
          {
            const std::size_t  i = line * width + x;
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
    m_Rows.resize(begin.back());
    forUsed([&](std::size_t i, std::size_t group) {
      const std::size_t place = begin[group]++;
      m_Order[place] = static_cast<std::uint32_t>(i);
      m_Rows[place] = regressors.RowOf(m_First + i, regressors.ValuesOf(m_First + i));
    });
  }

  /** The band's pixels are First() ... First() + Pixels() - 1. */
  std::size_t
  First() const
  {
    return m_First;
  }
  std::size_t
  Pixels() const
  {
    return m_Pixels;
  }
  const std::vector<Group> &
  GetGroups() const
  {
    return m_Groups;
  }
  /** The pixels that serve, counted from First() and ordered by group. */
  const std::vector<std::uint32_t> &
  GetOrder() const
  {
    return m_Order;
  }

  /** Fills \a sums with those over the pixels of every group of their rows times \a values, which are the values of
   * Together series at all pixels of the band. A series' bits do not depend on those beside it. */
  void
  Multiply(const std::vector<Vector> & values, std::vector<Sums> & sums) const
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
          const Eigen::Map<const Eigen::Matrix<double, part, 1>> columns(m_Rows[i].data() + column);
          sum.noalias() += columns * values[m_Order[i]].transpose();
        }
        sums[g].middleRows<part>(column) = sum;
      }
    }
  }

private:
  std::size_t                       m_First;
  std::size_t                       m_Pixels;
  std::vector<Group>                m_Groups;
  std::vector<std::uint32_t>        m_Order;
  std::vector<FrameRegressors::Row> m_Rows;
};

} // namespace sensornoise

#endif
