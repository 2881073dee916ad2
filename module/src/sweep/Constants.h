// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_Constants_h
#define sensornoise_sweep_Constants_h

#include "base/Constants.h"

#include <cstddef>

namespace sensornoise
{

/** Numbers of the room `sweep`. */
struct SweepConstants
{
  /** Standard error that is added to each ln(gain / setting) [1]: the steps of the amplifier, and nominal ISO speeds,
   * which deviate from third-stops by up to 1.6 % (1250 is 1270). */
  double gainRounding{ 0.01 };
  /** Standard error that is added to each read noise, relative to it [1]: what the model of two amplifier stages leaves
   * out. Chosen empirically. */
  double readNoiseModelError{ 0.02 };
  /** Smallest relative deviation of a gain from the line, and smallest step of gain / setting, that counts [1]: three
   * times the largest rounding of a nominal ISO speed. */
  double leastGainDeviation{ 0.05 };
  /** Smallest relative deviation of a gain from the gains at other exposures that counts [1]. The exposure changes no
   * amplifier; 1 % is the accuracy that is asked of a gain. */
  double leastCommonGainDeviation{ 0.01 };
  /** Smallest drop of the read noise in electrons, relative to it, that is a switch of the conversion gain [1]. A
   * switch changes the conversion gain by a factor of 1.5 or more; a tenth is far below what it does to the read noise.
   */
  double leastReadNoiseDrop{ 0.1 };
  /** Settings that are needed on each side of a switch. A single setting that deviates is no switch. */
  std::size_t leastSettingsOfSide{ 2 };
  /** Settings with a read noise that its model of three parameters needs: two more. */
  std::size_t leastReadNoises{ 5 };
};

SENSORNOISE_CONSTANT SweepConstants InSweep;

} // namespace sensornoise

#endif
