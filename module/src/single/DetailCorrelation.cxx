// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/DetailCorrelation.h"

#include "single/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{
namespace
{
/** Returns the diagonal details of a tile in expected standard deviations; 0: the position is left out. */
std::vector<float>
StandardDetails(const BandTile & tile, const LevelGrid & grid)
{
  std::vector<float> details(tile.Positions());
  const auto         largestRoughness = static_cast<float>(InSingle.largestRoughness);
  const auto         largest = static_cast<float>(InSingle.largestDetail);
  for (std::size_t i = 0; i < details.size(); ++i)
  {
    const float variance = grid.variance[grid.SetOf(tile.level[i])];
    const float detail = tile.detail[i] / std::sqrt(variance);
    const bool  isUsed = tile.roughness[i] < largestRoughness * variance && std::abs(detail) < largest;
    details[i] = isUsed ? detail : 0.0F;
  }
  return details;
}
} // namespace

void
DetailCorrelation::Add(const BandTile & tile, const LevelGrid & grid)
{
  const std::vector<float> details = StandardDetails(tile, grid);
  const std::size_t        width = tile.Width();
  const std::size_t        height = width == 0 ? 0 : details.size() / width;
  for (std::size_t k = 0; k < Places.size(); ++k)
  {
    const auto [right, down] = Places.at(k);
    const auto  across = static_cast<std::size_t>(std::abs(right));
    const auto  under = static_cast<std::size_t>(down);
    std::size_t pairs = 0;
    double      products = 0.0;
    double      squares = 0.0;
    for (std::size_t y = 0; y + under < height; ++y)
    {
      const float * const one = details.data() + y * width + (right < 0 ? across : 0);
      const float * const other = details.data() + (y + under) * width + (right < 0 ? 0 : across);
      for (std::size_t x = 0; x + across < width; ++x)
      {
        const float a = one[x];
        const float b = other[x];
        const float product = a * b;
        pairs += product != 0.0F ? 1 : 0;
        products += static_cast<double>(product);
        squares += static_cast<double>(product != 0.0F ? 0.5F * (a * a + b * b) : 0.0F);
      }
    }
    m_Sums.at(k).pairs += static_cast<double>(pairs);
    m_Sums.at(k).products += products;
    m_Sums.at(k).squares += squares;
  }
}

void
DetailCorrelation::Add(const DetailCorrelation & other)
{
  for (std::size_t k = 0; k < m_Sums.size(); ++k)
  {
    m_Sums.at(k).pairs += other.m_Sums.at(k).pairs;
    m_Sums.at(k).products += other.m_Sums.at(k).products;
    m_Sums.at(k).squares += other.m_Sums.at(k).squares;
  }
}

DetailCorrelation::Lag
DetailCorrelation::Largest() const
{
  Lag largest;
  for (std::size_t k = 0; k < m_Sums.size(); ++k)
  {
    const Sums & sums = m_Sums.at(k);
    const double value = sums.squares > 0.0 ? sums.products / sums.squares : 0.0;
    if (std::abs(value) > std::abs(largest.value))
    {
      largest = { Places.at(k).x, Places.at(k).y, value, 1.0 / std::sqrt(sums.pairs) };
    }
  }
  return largest;
}

} // namespace sensornoise
