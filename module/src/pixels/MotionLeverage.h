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
 * \brief By how much the motion, which was estimated from the pixels' own series, follows a pixel's noise:
 * D' G^-1 D of its derivatives D, over the noise's variance [DN^2].
 *
 * It counts in the few pixels that dominate the regression; that it does not in the others is told, row by row, by the
 * bound K sum_k D_k^2 (G^-1)_kk for K series. The references must outlive the object. */
class SensorNoise_EXPORT MotionLeverage
{
public:
  MotionLeverage(const ReferenceFrame & frame, const MotionSeries & motion);

  /** Sets bounds[x] to that of pixel x of row \a y, but for those next to the border, StencilMargin of them. */
  void
  FillBounds(std::size_t y, double * bounds) const;

  /** Of pixel \a p. */
  double
  At(std::size_t p) const;

private:
  const ReferenceFrame &               m_Frame;
  const MotionSeries &                 m_Motion;
  std::array<double, NumberOfStencils> m_Weights{}; // of the squares of the derivatives in the bound
};

} // namespace sensornoise

#endif
