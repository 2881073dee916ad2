// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameResampling_h
#define sensornoise_simulation_FrameResampling_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/SensorFlaws.h"
#include "simulation/DoubleFrame.h"

#include <algorithm>
#include <array>
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

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const BinningSettings & settings);

/** Returns \a codesDn binned, in the original size [DN]. Where whole squares fill the frame, its mean is kept. */
SensorNoise_EXPORT DoubleFrame
BinFrame(const DoubleFrame & codesDn, const BinningSettings & settings, const ParallelFor & parallelFor);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ResamplingSettings & settings);

/** Returns \a codesDn shifted [DN]. */
SensorNoise_EXPORT DoubleFrame
ResampleFrame(const DoubleFrame & codesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
