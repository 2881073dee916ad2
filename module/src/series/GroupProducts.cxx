// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/GroupProducts.h"

#include "base/Eigen.h"

#include <algorithm>

namespace sensornoise
{

namespace
{
#if defined(SENSORNOISE_AVX2)
/** Does the same as MultiplyGroupAnywhere() with AVX2 vectors of four: the products and sums are the same, in the same
 * order, and so are the bits. The target has no fused multiplication and addition, which would round differently. */
__attribute__((target("avx2"))) void
MultiplyGroupAvx2(const GroupFactors & of, GroupSums & sums)
{
  using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
  constexpr std::size_t part = 2; // vectors of columns: with four series their sums take half of the registers
  for (std::size_t first = 0; first < sums[0].size(); first += 4 * part)
  {
    Four sum[FramesTogether][part] = {};
    for (std::size_t i = of.begin; i < of.end; ++i)
    {
      const auto * const   columns = reinterpret_cast<const Four *>(of.columns[i].data() + first);
      const double * const values = of.series + of.order[i];
      for (std::size_t k = 0; k < FramesTogether; ++k)
      {
        for (std::size_t j = 0; j < part; ++j)
        {
          sum[k][j] += columns[j] * values[k * of.pixels];
        }
      }
    }
    for (std::size_t k = 0; k < FramesTogether; ++k)
    {
      std::copy_n(sum[k], part, reinterpret_cast<Four *>(sums[k].data() + first));
    }
  }
}
#endif

/** Returns the fastest function for this processor. */
auto
FindMultiplyGroup()
{
#if defined(SENSORNOISE_AVX2)
  return HasAvx2() ? MultiplyGroupAvx2 : MultiplyGroupAnywhere;
#else
  return MultiplyGroupAnywhere;
#endif
}
} // namespace

/** The sums are computed for a few columns at a time, so that they stay in registers. */
void
MultiplyGroupAnywhere(const GroupFactors & of, GroupSums & sums)
{
  constexpr std::size_t part = 4;
  using Columns = Eigen::Matrix<double, part, 1>;
  for (std::size_t first = 0; first < sums[0].size(); first += part)
  {
    Eigen::Matrix<double, part, FramesTogether> sum;
    sum.setZero();
    for (std::size_t i = of.begin; i < of.end; ++i)
    {
      const double * const                           v = of.series + of.order[i];
      const Eigen::Matrix<double, 1, FramesTogether> values(v[0], v[of.pixels], v[2 * of.pixels], v[3 * of.pixels]);
      sum.noalias() += Eigen::Map<const Columns>(of.columns[i].data() + first) * values;
    }
    for (std::size_t k = 0; k < FramesTogether; ++k)
    {
      Eigen::Map<Columns>(sums[k].data() + first) = sum.col(static_cast<Eigen::Index>(k));
    }
  }
}

void
MultiplyGroup(const GroupFactors & of, GroupSums & sums)
{
  static const auto multiply = FindMultiplyGroup();
  multiply(of, sums);
}

} // namespace sensornoise
