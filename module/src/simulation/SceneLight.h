// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_SceneLight_h
#define sensornoise_simulation_SceneLight_h

#include "SensorNoiseExport.h"
#include "sensornoise/Simulator.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** \class SceneLight
 * The electrons that a pixel expects: the reference image, blurred by the optics, scaled to [0, electrons] (a constant
 * image: `electrons` everywhere), shifted and brightened as the truth of the stack says, times the efficiency of the
 * pixel. None where the shutter is closed. */
class SensorNoise_EXPORT SceneLight
{
public:
  /** \throws std::invalid_argument if the size or a reference value cannot be used. */
  SceneLight(const std::vector<double> & reference,
             std::size_t                 width,
             std::size_t                 height,
             const SimulationSettings &  settings);

  /** (1 + gamma) p(x + alpha, y + beta) of row \a y of frame \a frame, times the efficiency, cut at 0; linear between
   * pixels, edge pixels replicated [e-]. */
  void
  ExpectedElectronsRow(const SimulationTruth & truth, std::size_t frame, std::size_t y, double * electrons) const;

  /** The same for a pixel at rest under light of \a brightness [e-]. */
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
