// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FloatingLevels.h"

#include "moments/Codes.h"

#include <optional>
#include <string>

namespace sensornoise
{

namespace
{

/** Returns whether the outermost of \a levels is a pile-up. \a stepDn is their spacing, if it is known [DN]. */
bool
PilesUp(const OutermostLevels & levels, std::optional<double> stepDn, double typicalVarianceDn2, double depth)
{
  const double step = stepDn.value_or(levels.Step());
  return IsPileUpEvidence(typicalVarianceDn2, step, depth) && IsPileUp(levels.Pixels(), levels.MostInside(step));
}

/** Returns "given", "pile-up" or "none". */
std::string
SourceOf(bool isGiven, bool isPileUp)
{
  return isGiven ? "given" : (isPileUp ? "pile-up" : "none");
}

} // namespace

CodeRange
FindLevels(const OutermostLevels & minima,
           const OutermostLevels & maxima,
           double                  typicalVarianceDn2,
           const CodeSettings &    settings,
           const ExtremeDepths &   depths)
{
  CodeRange range = GivenCodes(settings);
  if (minima.Pixels() > 0 && maxima.Pixels() > 0 && minima.Level() == maxima.Level())
  {
    return range;
  }
  const auto & step = settings.quantisationStepDn;
  const bool   low = !settings.clipLowDn && PilesUp(minima, step, typicalVarianceDn2, depths.low);
  const bool   high = !settings.clipHighDn && PilesUp(maxima, step, typicalVarianceDn2, depths.high);
  if (low || high)
  {
    range.clipLowDn = low ? minima.Level() : settings.clipLowDn;
    range.clipHighDn = high ? maxima.Level() : settings.clipHighDn;
    const std::string lowSource = SourceOf(settings.clipLowDn.has_value(), low);
    const std::string highSource = SourceOf(settings.clipHighDn.has_value(), high);
    range.SetClipSources(lowSource, highSource);
  }
  return range;
}

} // namespace sensornoise
