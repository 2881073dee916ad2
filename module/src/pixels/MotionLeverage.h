// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_MotionLeverage_h
#define sensornoise_pixels_MotionLeverage_h

#include "SensorNoiseExport.h"
#include "base/Stencils.h"

#include <array>
#include <cstddef>

namespace sensornoise
{

struct MotionSeries;
struct ReferenceFrame;

/** \class MotionLeverage
 * \brief Leverage of a pixel in the estimate of the motion, times its noise variance: D' G^-1 D, with its derivatives D
 * [DN^2].
 *
 * The motion was estimated from the same pixels, so the estimate follows the noise of each of them. This matters only
 * in the few pixels that dominate the regression. A bound, K sum_k D_k^2 (G^-1)_kk for K components, excludes the other
 * pixels row by row. The references must outlive the object. */
class SensorNoise_EXPORT MotionLeverage
{
public:
  /** Prepares the weights of the bound. */
  MotionLeverage(const ReferenceFrame & frame, const MotionSeries & motion);

  /** Sets bounds[x] to the bound of pixel x of row \a y [DN^2]. It is 0 at the StencilMargin pixels next to the left
   * and the right border. */
  void
  FillBounds(std::size_t y, double * bounds) const;

  /** Returns the leverage of pixel \a p times its noise variance [DN^2]. */
  double
  At(std::size_t p) const;

private:
  const ReferenceFrame &               m_Frame;
  const MotionSeries &                 m_Motion;
  std::array<double, NumberOfStencils> m_Weights{}; // of the squared derivatives in the bound
};

} // namespace sensornoise

#endif
