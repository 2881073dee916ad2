// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/stabilise/GeneralizedAnscombe.h"

#include "sensornoise/base/Eigen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace sensornoise
{

namespace
{
/** Values that are worked on together. A block is always computed whole, so that no value meets another code, and other
 * bits, because of where it stands. */
constexpr std::size_t ValuesPerBlock = 128;
using ValueBlock = Eigen::Array<double, ValuesPerBlock, 1>;

/** The smallest mean of a stabilised value, that of no light and no read noise. */
const double LeastMean = std::sqrt(1.5);

/** Reads a block; what is missing at its end is 0. */
template <typename TValue>
void
ReadBlock(const TValue * values, std::size_t count, ValueBlock & block)
{
  if (count < ValuesPerBlock)
  {
    block.setZero();
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    block[i] = static_cast<double>(values[i]);
  }
}

/** D to E, see AnscombeInverse. Comparisons are such that NaN stays. */
void
InvertBlock(AnscombeInverse inverse, ValueBlock & block)
{
  const double least = inverse == AnscombeInverse::ExactUnbiased ? LeastMean : 0.0;
  for (std::size_t i = 0; i < ValuesPerBlock; ++i)
  {
    block[i] = block[i] < least ? least : block[i];
  }
  if (inverse == AnscombeInverse::ExactUnbiased)
  {
    const double c1 = 0.25 * LeastMean;
    const double c3 = 0.625 * LeastMean;
    for (std::size_t i = 0; i < ValuesPerBlock; ++i)
    {
      const double d = block[i];
      const double r = 1.0 / d;
      block[i] = 0.25 * d * d - 0.125 + r * (c1 + r * (c3 * r - 1.375));
    }
  }
  else
  {
    const double constant = inverse == AnscombeInverse::Algebraic ? 0.375 : 0.125;
    block = 0.25 * block * block - constant;
  }
}

/** Writes levels [DN] as \a TPixel; returns how many are NaN and cannot be. */
template <typename TPixel>
std::size_t
WriteBlock(ValueBlock & block, std::size_t count, TPixel * levelsDn)
{
  if constexpr (std::is_floating_point_v<TPixel>)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      levelsDn[i] = static_cast<TPixel>(block[i]);
    }
    return 0;
  }
  else
  {
    constexpr double low = std::numeric_limits<TPixel>::lowest();
    constexpr double high = std::numeric_limits<TPixel>::max();
    int              notNumbers = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double level = block[i];
      notNumbers += level == level ? 0 : 1;
      const double inRange = level > low ? (level < high ? level : high) : low;
      levelsDn[i] = static_cast<TPixel>(static_cast<int>(inRange - low + 0.5) + static_cast<int>(low));
    }
    for (std::size_t i = 0; notNumbers > 0 && i < count; ++i)
    {
      levelsDn[i] = std::isnan(block[i]) ? TPixel{ 0 } : levelsDn[i];
    }
    return static_cast<std::size_t>(notNumbers);
  }
}
} // namespace

AnscombeInverse
AnscombeInverseOf(const std::string & name)
{
  for (const AnscombeInverse inverse :
       { AnscombeInverse::ExactUnbiased, AnscombeInverse::Algebraic, AnscombeInverse::Asymptotic })
  {
    if (name == NameOf(inverse))
    {
      return inverse;
    }
  }
  throw std::invalid_argument("the inverse is \"" + name + "\"; expected exact-unbiased, algebraic or asymptotic");
}

const char *
NameOf(AnscombeInverse inverse)
{
  return inverse == AnscombeInverse::ExactUnbiased ? "exact-unbiased"
         : inverse == AnscombeInverse::Algebraic   ? "algebraic"
                                                   : "asymptotic";
}

GeneralizedAnscombe::GeneralizedAnscombe(const NoiseModel & model)
  : m_Model(model)
{
  model.Validate();
}

template <typename TPixel, typename TReal>
std::size_t
GeneralizedAnscombe::Stabilise(const TPixel * levelsDn, std::size_t count, TReal * stabilised) const
{
  const double a = m_Model.varianceSlopeDn;
  const double constant = 0.375 * a * a + m_Model.totalInterceptDn2;
  const double scale = 2.0 / a;
  std::size_t  negative = 0;
  ValueBlock   block;
  for (std::size_t begin = 0; begin < count; begin += ValuesPerBlock)
  {
    const std::size_t size = std::min(ValuesPerBlock, count - begin);
    ReadBlock(levelsDn + begin, size, block);
    int below = 0;
    for (std::size_t i = 0; i < ValuesPerBlock; ++i)
    {
      const double argument = a * block[i] + constant;
      below += argument < 0.0 && i < size ? 1 : 0;
      block[i] = argument < 0.0 ? 0.0 : argument;
    }
    negative += static_cast<std::size_t>(below);
    block = scale * block.sqrt();
    for (std::size_t i = 0; i < size; ++i)
    {
      stabilised[begin + i] = static_cast<TReal>(block[i]);
    }
  }
  return negative;
}

template <typename TReal, typename TPixel>
std::size_t
GeneralizedAnscombe::Invert(const TReal *   stabilised,
                            std::size_t     count,
                            TPixel *        levelsDn,
                            AnscombeInverse inverse) const
{
  const double zeroLevelDn = -m_Model.totalInterceptDn2 / m_Model.varianceSlopeDn;
  std::size_t  notNumbers = 0;
  ValueBlock   block;
  for (std::size_t begin = 0; begin < count; begin += ValuesPerBlock)
  {
    const std::size_t size = std::min(ValuesPerBlock, count - begin);
    ReadBlock(stabilised + begin, size, block);
    InvertBlock(inverse, block);
    block = m_Model.varianceSlopeDn * block + zeroLevelDn;
    notNumbers += WriteBlock(block, size, levelsDn + begin);
  }
  return notNumbers;
}

// clang-format off
#define SENSORNOISE_INSTANTIATE(TPixel, TReal)                                                                        \
  template SensorNoise_EXPORT std::size_t GeneralizedAnscombe::Stabilise(const TPixel *, std::size_t, TReal *) const; \
  template SensorNoise_EXPORT std::size_t GeneralizedAnscombe::Invert(                                                \
    const TReal *, std::size_t, TPixel *, AnscombeInverse) const;
// clang-format on
SENSORNOISE_INSTANTIATE(unsigned char, float)
SENSORNOISE_INSTANTIATE(unsigned short, float)
SENSORNOISE_INSTANTIATE(short, float)
SENSORNOISE_INSTANTIATE(float, float)
SENSORNOISE_INSTANTIATE(double, float)
SENSORNOISE_INSTANTIATE(unsigned char, double)
SENSORNOISE_INSTANTIATE(unsigned short, double)
SENSORNOISE_INSTANTIATE(short, double)
SENSORNOISE_INSTANTIATE(float, double)
SENSORNOISE_INSTANTIATE(double, double)
#undef SENSORNOISE_INSTANTIATE

} // namespace sensornoise
