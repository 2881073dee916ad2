// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/NoiseModel.h"

#include "base/Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace sensornoise
{

namespace
{
const char *
StatusWord(EstimateStatus status)
{
  return status == EstimateStatus::NotIdentifiable ? "not identifiable"
         : status == EstimateStatus::UpperLimit    ? "an upper limit only"
                                                   : "failed";
}

double
ValueOf(const Quantity & quantity, const std::string & name)
{
  if (!quantity.value)
  {
    throw std::invalid_argument("the report's " + name + " has no value (it is " + StatusWord(quantity.status) +
                                "); expected a report that has variance_slope and total_intercept");
  }
  return *quantity.value;
}
} // namespace

void
NoiseModel::Validate() const
{
  if (!(std::isfinite(varianceSlopeDn) && varianceSlopeDn > 0.0))
  {
    throw std::invalid_argument("the variance slope is " + Text(varianceSlopeDn) +
                                "; expected a finite number above 0 [DN/e-], the report's variance_slope");
  }
  if (!std::isfinite(totalInterceptDn2))
  {
    throw std::invalid_argument("the total intercept is " + Text(totalInterceptDn2) +
                                "; expected a finite number [DN^2], the report's total_intercept");
  }
}

NoiseModel
NoiseModelOf(const Report & report)
{
  const NoiseModel model{ ValueOf(report.varianceSlope, "variance_slope"),
                          ValueOf(report.totalIntercept, "total_intercept") };
  model.Validate();
  return model;
}

namespace
{
/** Number of values that are computed together. A block is always computed as a whole, by loops of a constant length
 * with SIMD instructions. The place of a value therefore does not change the code that computes it, nor its bits. */
constexpr std::size_t ValuesPerBlock = 128;
using ValueBlock = std::array<double, ValuesPerBlock>;

/** Smallest mean of a stabilised value: no signal and no read noise. */
const double LeastMean = std::sqrt(1.5);

/** Reads a block. Missing values at its end become NaN, which is never counted as negative. */
template <typename TValue>
void
ReadBlock(const TValue * values, std::size_t count, ValueBlock & block)
{
  if (count < ValuesPerBlock)
  {
    block.fill(std::numeric_limits<double>::quiet_NaN());
    std::copy_n(values, count, block.begin());
    return;
  }
  for (std::size_t i = 0; i < ValuesPerBlock; ++i)
  {
    block[i] = static_cast<double>(values[i]);
  }
}

/** Replaces the values of a block by function(value). */
template <typename TFunction>
void
Transform(ValueBlock & block, TFunction function)
{
  for (std::size_t i = 0; i < ValuesPerBlock; ++i)
  {
    block[i] = function(block[i]);
  }
}

/** Returns the number of values of a block for which \a isCounted is true. Four sums permit SIMD instructions. */
template <typename TFunction>
std::size_t
CountIn(const ValueBlock & block, TFunction isCounted)
{
  constexpr std::size_t     lanes = 4;
  std::array<double, lanes> counted{};
  for (std::size_t i = 0; i < ValuesPerBlock; i += lanes)
  {
    for (std::size_t k = 0; k < lanes; ++k)
    {
      counted[k] += isCounted(block[i + k]) ? 1.0 : 0.0;
    }
  }
  return static_cast<std::size_t>(counted[0] + counted[1] + counted[2] + counted[3]);
}

/** Converts D to E, see AnscombeInverse. The comparisons keep NaN. */
void
InvertBlock(AnscombeInverse inverse, ValueBlock & block)
{
  if (inverse == AnscombeInverse::ExactUnbiased)
  {
    const double least = LeastMean;
    const double c1 = 0.25 * LeastMean;
    const double c3 = 0.625 * LeastMean;
    Transform(block, [=](double value) {
      const double d = value < least ? least : value;
      const double r = 1.0 / d;
      return 0.25 * d * d - 0.125 + r * (c1 + r * (c3 * r - 1.375));
    });
    return;
  }
  const double constant = inverse == AnscombeInverse::Algebraic ? 0.375 : 0.125;
  Transform(block, [=](double value) {
    const double d = value < 0.0 ? 0.0 : value;
    return 0.25 * d * d - constant;
  });
}

/** Writes the first \a count values of a block, converted by \a convert. */
template <typename TValue, typename TFunction>
void
WriteBlock(const ValueBlock & block, std::size_t count, TValue * values, TFunction convert)
{
  std::array<TValue, ValuesPerBlock> converted{};
  for (std::size_t i = 0; i < ValuesPerBlock; ++i)
  {
    converted[i] = convert(block[i]);
  }
  std::copy_n(converted.begin(), count, values);
}

/** Returns the nearest whole number in the range of \a TPixel, half up; for NaN the lowest number. */
template <typename TPixel>
TPixel
Rounded(double level)
{
  constexpr double low = std::numeric_limits<TPixel>::lowest();
  constexpr double high = std::numeric_limits<TPixel>::max();
  const double     above = level > low ? level : low;
  const double     inside = above < high ? above : high;
  // Above 0 the conversion rounds down; SIMD instructions convert to 32 bits.
  // NOLINTNEXTLINE(bugprone-incorrect-roundings)
  return static_cast<TPixel>(static_cast<std::int32_t>(inside - low + 0.5) + static_cast<std::int32_t>(low));
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
  const auto   scale = static_cast<TReal>(2.0 / a);
  std::size_t  negative = 0;
  ValueBlock   block;
  for (std::size_t begin = 0; begin < count; begin += ValuesPerBlock)
  {
    const std::size_t size = std::min(ValuesPerBlock, count - begin);
    ReadBlock(levelsDn + begin, size, block);
    Transform(block, [=](double level) { return a * level + constant; });
    negative += CountIn(block, [](double argument) { return argument < 0.0; });
    Transform(block, [](double argument) { return argument < 0.0 ? 0.0 : argument; });
    WriteBlock(block, size, stabilised + begin, [scale](double argument) {
      return scale * std::sqrt(static_cast<TReal>(argument)); // single precision is twice as fast
    });
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
  const double a = m_Model.varianceSlopeDn;
  const double zeroLevelDn = -m_Model.totalInterceptDn2 / a;
  std::size_t  numbers = 0;
  ValueBlock   block;
  for (std::size_t begin = 0; begin < count; begin += ValuesPerBlock)
  {
    const std::size_t size = std::min(ValuesPerBlock, count - begin);
    ReadBlock(stabilised + begin, size, block);
    InvertBlock(inverse, block);
    Transform(block, [=](double electrons) { return a * electrons + zeroLevelDn; });
    if constexpr (std::is_integral_v<TPixel>)
    {
      numbers += CountIn(block, [](double level) { return level == level; });
      WriteBlock(block, size, levelsDn + begin, [](double level) { return Rounded<TPixel>(level); });
    }
    else
    {
      WriteBlock(block, size, levelsDn + begin, [](double level) { return static_cast<TPixel>(level); });
    }
  }
  return std::is_integral_v<TPixel> ? count - numbers : 0;
}

// Types have no parentheses. NOLINTBEGIN(bugprone-macro-parentheses)
// clang-format off
#define SENSORNOISE_INSTANTIATE(TPixel, TReal)                                                                        \
  template SensorNoise_EXPORT std::size_t GeneralizedAnscombe::Stabilise(const TPixel *, std::size_t, TReal *) const; \
  template SensorNoise_EXPORT std::size_t GeneralizedAnscombe::Invert(                                                \
    const TReal *, std::size_t, TPixel *, AnscombeInverse) const;
// clang-format on
// NOLINTEND(bugprone-macro-parentheses)
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
