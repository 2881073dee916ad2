// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_CollectedCharge_h
#define sensornoise_simulation_CollectedCharge_h

#include "sensornoise/SimulationSettings.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/SensorFlaws.h"
#include "simulation/FrameProcessing.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * The charge that the pixels collect: illumination, expected electrons, and exchange between neighbours. */

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used for a stack of `frames` frames. */
SensorNoise_EXPORT void
CheckSettings(const IlluminationSettings & illumination, std::size_t frames);

/** Returns the illumination factor of a frame [1]. A random factor depends on the seed and on the frame alone. */
SensorNoise_EXPORT double
IlluminationFactor(const IlluminationSettings & illumination,
                   std::size_t                  frame,
                   std::size_t                  frames,
                   std::uint64_t                seed);

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

/** \throws std::invalid_argument that names the first setting that cannot be used with \a electrons in the brightest
 * pixel [e-]. */
SensorNoise_EXPORT void
CheckSettings(const BrighterFatterSettings & settings, double electrons);

/** Returns the collected charges [e-]; \a charge are the charges without the effect [e-]. */
SensorNoise_EXPORT DoubleFrame
SpreadCharge(const DoubleFrame & charge, const BrighterFatterSettings & settings, const ParallelFor & parallelFor);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const CouplingSettings & settings);

/** Returns the signals that are read for the charges \a charge [e-]. */
SensorNoise_EXPORT DoubleFrame
CoupleCharge(const DoubleFrame & charge, const CouplingSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
