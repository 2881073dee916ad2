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
