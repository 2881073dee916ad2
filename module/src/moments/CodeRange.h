// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_CodeRange_h
#define sensornoise_moments_CodeRange_h

#include "moments/CodeSteps.h"

#include <optional>
#include <string>

namespace sensornoise
{

/** What is known about the codes of the data. */
struct CodeRange
{
  std::optional<int> bitDepth;                  ///< null for floating-point data
  std::string        bitDepthSource{ "none" };  ///< "given", "data" or "none"
  double             quantisationStepDn{ 0.0 }; ///< spacing of the codes [DN], of companded ones the darkest; 0: none
  bool               isRegular{ true };         ///< false: rescaled data, the spacing varies
  CodeSteps          steps;                     ///< the spacing by level, of companded codes
  std::optional<double> clipLowDn;              ///< a pixel that attains it is clipped [DN]; null: none
  std::optional<double> clipHighDn;             ///< a pixel that attains it is clipped [DN]; null: none
  std::string           clipSource{ "none" };   ///< "given", "pile-up", "code range", "none", or "low: ..., high: ..."

  /** Files where the clip levels are from. */
  void
  SetClipSources(const std::string & low, const std::string & high)
  {
    clipSource = low == high ? low : "low: " + low + ", high: " + high;
  }
  /** The spacing of the codes about a level [DN]; 0: the data have no codes. */
  double
  StepAt(double levelDn) const
  {
    return steps.IsCompanded() ? steps.StepAt(levelDn) : quantisationStepDn;
  }
  /** Whether a pixel with these extremes over time attains a clip level. */
  bool
  IsClippedLow(double minimumDn) const
  {
    return clipLowDn && minimumDn <= *clipLowDn;
  }
  bool
  IsClippedHigh(double maximumDn) const
  {
    return clipHighDn && maximumDn >= *clipHighDn;
  }
  bool
  IsClipped(double minimumDn, double maximumDn) const
  {
    return this->IsClippedLow(minimumDn) || this->IsClippedHigh(maximumDn);
  }
};

} // namespace sensornoise

#endif
