// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_NumberInterpolation_h
#define sensornoise_sweep_NumberInterpolation_h

#include "SensorNoiseExport.h"
#include "sweep/SettingNoise.h"

#include <vector>

namespace sensornoise
{

/** A number at one setting of the camera. */
struct SettingNumber
{
  double          setting{ 0.0 }; ///< above 0
  NumberWithError number;
};

/** Returns the number at a \a setting between two neighbouring settings of \a points, which are in ascending order.
 *
 * The line is straight in ln(setting) and, with \a isLogarithmic, in ln(number): then all numbers are above 0. Its
 * standard error has two parts, added in squares: the errors of both neighbours by their weights, and the largest error
 * of a straight line through a curve, |(x - x0) (x - x1) f''/2|. Here f''/2 is the larger of the second divided
 * differences with the point before and the point behind, and 0 if there is neither. Throws std::invalid_argument
 * unless there are two points and the setting is between the first and the last one. */
SensorNoise_EXPORT NumberWithError
InterpolateNumber(const std::vector<SettingNumber> & points, double setting, bool isLogarithmic);

} // namespace sensornoise

#endif
