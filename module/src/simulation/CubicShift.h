// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_CubicShift_h
#define sensornoise_simulation_CubicShift_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

/** Cubic interpolation at position + shift along one axis of \a size pixels, edge pixels replicated. The four weights
 * of Keys 1981 (IEEE Trans. ASSP 29, DOI 10.1109/TASSP.1981.1163711) with a = -1/2 are exact for polynomials up to
 * degree 2. They sum to 1; at half a pixel they are -1/16, 9/16, 9/16, -1/16. */
class CubicShift
{
public:
  static constexpr std::size_t NumberOfTaps = 4;

  CubicShift(double shift, std::size_t size)
    : m_Last(static_cast<double>(size) - 1.0)
    , m_Whole(std::floor(shift))
  {
    const double f = shift - m_Whole;
    const double back = 1.0 - f;
    m_Weights = { -0.5 * f * back * back,
                  1.0 - 2.5 * f * f + 1.5 * f * f * f,
                  1.0 - 2.5 * back * back + 1.5 * back * back * back,
                  -0.5 * back * f * f };
  }
  /** Returns the pixel that tap \a k, 0 to 3, reads. */
  std::size_t
  Tap(std::size_t position, std::size_t k) const
  {
    const double at = static_cast<double>(position) + m_Whole + static_cast<double>(k) - 1.0;
    return static_cast<std::size_t>(std::clamp(at, 0.0, m_Last));
  }
  double
  Weight(std::size_t k) const
  {
    return m_Weights[k];
  }

private:
  double                           m_Last;
  double                           m_Whole;
  std::array<double, NumberOfTaps> m_Weights{};
};

} // namespace sensornoise

#endif
