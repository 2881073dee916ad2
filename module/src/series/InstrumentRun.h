// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_InstrumentRun_h
#define sensornoise_series_InstrumentRun_h

#include "base/PixelRuns.h"
#include "series/FrameRegressors.h"
#include "series/ShiftInstruments.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sensornoise
{

/** \class InstrumentRun
 * \brief The terms of the noise of the instruments for some pixels, stored for SIMD. */
class InstrumentRun
{
public:
  static constexpr std::size_t Pixels = 256;
  static constexpr std::size_t Terms = 4; ///< w, and the products of the instruments times their weights w: xx, xy, yy

  /** Computes the terms of the pixels [first, last); pixels that are not used have 0. */
  void
  Fill(const FrameRegressors & regressors, std::size_t first, std::size_t last)
  {
    const ShiftInstruments & instruments = regressors.GetInstruments();
    const double * const     weights = instruments.weight.data() + first;
    const double * const     xs = instruments.x.data() + first;
    const double * const     ys = instruments.y.data() + first;
    for (std::size_t i = 0; i < last - first; ++i)
    {
      const bool   serves = regressors.ClassOf(first + i) != FrameRegressors::Unused;
      const double weight = serves ? weights[i] : 0.0;
      const double x = serves ? xs[i] * weight : 0.0;
      const double y = serves ? ys[i] * weight : 0.0;
      m_Terms[0][i] = weight;
      m_Terms[1][i] = x * x;
      m_Terms[2][i] = x * y;
      m_Terms[3][i] = y * y;
    }
    const double * const level = regressors.GetFrame().neighbourMean.data();
    std::copy(level + first, level + last, m_Level.begin());
    m_Pixels = last - first;
  }
  /** Adds the sums of the terms, and of the terms times the level. */
  void
  AddTo(std::array<double, 2 * Terms> & total) const
  {
    for (std::size_t k = 0; k < Terms; ++k)
    {
      const double * const terms = m_Terms[k].data();
      const double * const level = m_Level.data();
      total[k] += SumOfRun(m_Pixels, [=](std::size_t i) { return terms[i]; });
      total[Terms + k] += SumOfRun(m_Pixels, [=](std::size_t i) { return terms[i] * level[i]; });
    }
  }

private:
  std::array<std::array<double, Pixels>, Terms> m_Terms{};
  std::array<double, Pixels>                    m_Level{};
  std::size_t                                   m_Pixels{ 0 };
};

} // namespace sensornoise

#endif
