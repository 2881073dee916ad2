// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Settings_h
#define sensornoise_Settings_h

#include "SensorNoiseExport.h"
#include "base/RollingShutter.h"
#include "moments/CodeSettings.h"
#include "moments/KnownOffset.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Levels from low to high. */
struct LevelRange
{
  double lowDn;
  double highDn;
};

/** Every parameter of the refined method. */
struct SensorNoise_EXPORT RefinedSettings
{
  /** Off: the light changes everywhere alike. Otherwise light that changes in some places in another way than in
   * others (a rolling shutter, a second lamp, a patch that bleaches) is looked for, and needs no width. */
  RollingShutter rollingShutter{ RollingShutter::Auto };
  /** The offset, if it is known: offset and read noise then need no flicker. */
  std::optional<KnownOffset> offset;
  /** Levels between which the variance is fitted, of a pixel's neighbours [DN]; null: all. For sensors whose response
   * is straight in a part of its range (EMVA 1288 takes 5 to 95 % of saturation). */
  std::optional<LevelRange> levelRangeDn;
  /** Exposure of each frame, in the order of the frames, in any unit: exposure times, or irradiations; 0: a dark frame.
   * Finite, 0 or more, at least 3 different values. With them the linearity of the response is measured, see
   * FitExposures(). Empty (default): not given. */
  std::vector<double> exposures;
  /** Excess noise factor F of the sensor [1]: what an amplification of single electrons or photons makes of the
   * variance of their shot noise, 2 in an EMCCD. The gain is the slope of the variance, divided by F. 1 or more; 1
   * (default): none. See DivideExcessNoise(). */
  double excessNoiseFactor{ 1.0 };
  /** What is known of the codes; the rest is found. */
  CodeSettings codes;
  /** Most that the method may hold, beside the frames that it is handed [bytes]; infinite: what it needs. The stack is
   * read more often if it is less, with the same bits. Not below MemoryNeed::Least(). */
  double memoryLimitBytes{ std::numeric_limits<double>::infinity() };

  /** Throws std::invalid_argument if a parameter is out of its range. */
  void
  Validate() const;

  /** Throws std::invalid_argument if the offset, or its standard error, is further from 0 than \a limitDn [DN], which
   * is \a whatOf the data. */
  void
  RequireOffsetWithin(double limitDn, const std::string & whatOf) const;
};

} // namespace sensornoise

#endif
