// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ExpectedSignal_h
#define sensornoise_simulation_ExpectedSignal_h

#include "SensorNoiseExport.h"
#include "sensornoise/Simulator.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** \class ExpectedSignal
 * \brief Expected number of electrons of each pixel.
 *
 * The reference image is blurred by the optics, and scaled to [0, electrons] (a constant image: `electrons`
 * everywhere). It is then shifted and brightened as in the truth of the stack, and multiplied by the efficiency of the
 * pixel. The number is 0 where the shutter is closed. */
class SensorNoise_EXPORT ExpectedSignal
{
public:
  /** \throws std::invalid_argument if the size or a reference value cannot be used. */
  ExpectedSignal(const std::vector<double> & reference,
                 std::size_t                 width,
                 std::size_t                 height,
                 const SimulationSettings &  settings);

  /** Computes (1 + gamma) p(x + alpha, y + beta) for row \a y of frame \a frame, times the efficiency, at least 0;
   * linear between pixels, edge pixels replicated [e-]. */
  void
  ExpectedElectronsRow(const SimulationTruth & truth, std::size_t frame, std::size_t y, double * electrons) const;

  /** Returns the expected number of electrons of a pixel without a shift, for an illumination factor \a brightness
   * [e-]. */
  double
  ElectronsAtRest(std::size_t pixel, double brightness) const;

private:
  std::size_t         m_Width;
  std::size_t         m_Height;
  bool                m_IsDark;
  std::vector<double> m_Electrons;
  std::vector<double> m_Efficiency; ///< empty: 1 everywhere
};

} // namespace sensornoise

#endif
