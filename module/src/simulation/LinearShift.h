// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_LinearShift_h
#define sensornoise_simulation_LinearShift_h

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

/** Linear interpolation at position + shift along one axis of \a size pixels, edge pixels replicated. */
class LinearShift
{
public:
  LinearShift(double shift, std::size_t size)
    : m_Last(static_cast<double>(size) - 1.0)
    , m_Whole(std::floor(shift))
    , m_Fraction(shift - m_Whole)
  {}
  std::size_t
  First(std::size_t position) const
  {
    return static_cast<std::size_t>(std::clamp(static_cast<double>(position) + m_Whole, 0.0, m_Last));
  }
  std::size_t
  Second(std::size_t position) const
  {
    return static_cast<std::size_t>(std::clamp(static_cast<double>(position) + m_Whole + 1.0, 0.0, m_Last));
  }
  double
  Blend(double first, double second) const
  {
    return first + m_Fraction * (second - first);
  }

private:
  double m_Last;
  double m_Whole;
  double m_Fraction;
};

} // namespace sensornoise

#endif
