// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_BrighterFatter_h
#define sensornoise_simulation_BrighterFatter_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"

namespace sensornoise
{

/** Brighter-fatter effect: the charge that a pixel holds pushes the border to a neighbour with less charge inwards, and
 * what arrives next falls to the neighbour. The flow over a border is the shift of the border, k (Q - Q'), times the
 * charge that arrives there, (Q + Q') / 2: the model of Guyonnet et al. 2015 (A&A 575, A41,
 * DOI 10.1051/0004-6361/201424897) with the nearest borders alone; Astier et al. 2019 (A&A 629, A36,
 * DOI 10.1051/0004-6361/201935508) has what it does to variance and covariance. On an even level Q it acts as a
 * coupling of the fraction k Q: to first order the variance Q loses 8 k Q^2 and each neighbour gains a covariance of
 * 2 k Q^2, both growing with the square of the level. */
struct BrighterFatterSettings
{
  /** k, shift of a border for each electron of difference [1/e-], 0 or more; k times the electrons of the brightest
   * pixel at most 0.1. Thick CCDs: about 4e-7. */
  double perElectron{ 0.0 };

  bool
  IsOn() const
  {
    return perElectron > 0.0;
  }
};

/** \throws std::invalid_argument naming the first setting that cannot be used with \a electrons in the brightest
 * pixel. */
SensorNoise_EXPORT void
CheckSettings(const BrighterFatterSettings & settings, double electrons);

/** The charges [e-] that are collected where \a charge would be without the effect [e-]. */
SensorNoise_EXPORT DoubleFrame
SpreadCharge(const DoubleFrame & charge, const BrighterFatterSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
