// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/GroupProducts.h"

#include "base/Eigen.h"
#include "base/Avx2.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

namespace
{
/** Computes the sums over the pixels of \a group for a few columns at a time, so that the sums stay in registers. */
void
MultiplyGroupAnywhere(const RegressorBand::Group & group, const GroupFactors & of, RegressorBand::Sums & sums)
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
/** Does the same with AVX2 vectors of four: the products and sums are the same, in the same order, and so are the bits.
 * The target has no fused multiplication and addition, which would round differently. */
__attribute__((target("avx2"))) void
MultiplyGroupAvx2(const RegressorBand::Group & group, const GroupFactors & of, RegressorBand::Sums & sums)
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

/** Returns the fastest function for this processor. */
auto
FindMultiplyGroup()
{
#if defined(__GNUC__) && defined(__x86_64__)
  return HasAvx2() ? MultiplyGroupAvx2 : MultiplyGroupAnywhere;
#else
  return MultiplyGroupAnywhere;
#endif
}
} // namespace

void
MultiplyGroup(const RegressorBand::Group & group, const GroupFactors & of, RegressorBand::Sums & sums)
{
  static const auto multiply = FindMultiplyGroup();
  multiply(group, of, sums);
}

} // namespace sensornoise
