// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Eigen.h"
#include "pixels/QuantisationNoise.h"
#include "pixels/GainByParts.h"
#include "refined/FramePhotonTransfer.h"
#include "refined/GainEstimate.h"
#include "report/Quantities.h"
#include "sensornoise/Settings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace sensornoise
{

namespace
{
/** Returns Student's quantile of the 95 % intervals [1]. */
double
StudentOf(const RefinedResults & found)
{
  return StudentQuantile(0.975, static_cast<double>(found.scene.frame.frames) - 2.0);
}

UnlikeParts
GainsOf(const PartGains & gains, const GainEstimate & gain)
{
  const double pixels = std::accumulate(gains.pixels.begin(), gains.pixels.end(), 0.0);
  const auto & kind = KindOf(gains.partition);
  UnlikeParts  parts{ kind.divided, kind.words, gains.size, { kind.name, {} } };
  for (std::size_t k = 0; k < gains.excess.size(); ++k)
  {
    parts.record.parts.push_back(
      { NameOfPart(gains.partition, k),
        gain.line.gain * (1.0 + gains.excess[k]),
        std::hypot(std::sqrt(gain.covariance(0, 0)) * (1.0 + gains.excess[k]), gain.line.gain * gains.error[k]),
        gains.pixels[k] / pixels });
  }
  return parts;
}

/** Returns the gains of lines of a sensor, which messages call a \a name. \a student is the quantile of a 95 %
 * interval [1]. */
UnlikeParts
GainsOf(const GainByLines & lines, const std::string & name, const GainEstimate & gain, double student)
{
  UnlikeParts       parts{ Divided::Phases, name + "s", lines.size, { name + "s", {} } };
  const std::size_t period = lines.excess.size();
  const auto        add = [&](const std::string & part, double excess, double errorOfExcess, double fraction) {
    parts.record.parts.push_back(
      { part,
        gain.line.gain * (1.0 + excess),
        std::hypot(std::sqrt(gain.covariance(0, 0)) * (1.0 + excess), gain.line.gain * errorOfExcess),
        fraction });
  };
  for (std::size_t k = 0; k < period; ++k)
  {
    add(name + " " + std::to_string(k) + " of " + std::to_string(period),
        lines.excess[k],
        lines.error,
        1.0 / static_cast<double>(period));
  }
  if (period == 0)
  {
    const double outside = 0.025; // the lines beyond either end of a 95 % interval
    const double distance = student * lines.size;
    const double errorOfDistance = 0.5 * distance / lines.z; // the size is a root
    add("lowest 2.5 % of the " + name + "s", -distance, errorOfDistance, outside);
    add("highest 2.5 % of the " + name + "s", distance, errorOfDistance, outside);
  }
  else
  {
    parts.words += " with a period of " + std::to_string(period);
  }
  return parts;
}

/** Returns the gains of groups of frames, or of the frames of the lowest and the highest gain. */
UnlikeParts
GainsOf(const GainsOfFrames & frames, const GainEstimate & gain)
{
  UnlikeParts parts{ Divided::Frames, frames.areGroups ? "groups of frames" : "frames", frames.size, { "frames", {} } };
  const double error = std::sqrt(gain.covariance(0, 0));
  const auto   all = static_cast<double>(frames.excess.size());
  for (const FrameGroup & group : frames.groups)
  {
    const auto   count = static_cast<double>(group.frames.size());
    const double ofExcess = std::hypot(frames.error / std::sqrt(count), (group.noise - 1.0) * frames.errorOfScale);
    parts.record.parts.push_back({ TextOfFrames(group.frames),
                                   gain.line.gain * group.noise,
                                   std::hypot(error * group.noise, gain.line.gain * ofExcess),
                                   count / all });
  }
  return parts;
}

/** Returns the partitions whose parts differ. Phases are left out if the noise is correlated: where frames were
 * resampled, the variance depends on the phase, and not because of the gain. */
std::vector<UnlikeParts>
FindUnlikeParts(const RefinedResults & found, const GainEstimate & gain)
{
  std::vector<UnlikeParts> unlike;
  const GainByParts &      parts = found.variance.parts;
  for (const auto * const own : { &parts.places, &parts.phases, &parts.frames })
  {
    if (*own && (*own)->Differ() && !(own == &parts.phases && found.correlation.IsCorrelated()))
    {
      unlike.push_back(GainsOf(**own, gain));
    }
  }
  if (found.frameNoise.gains.Differ())
  {
    unlike.push_back(GainsOf(found.frameNoise.gains, gain));
  }
  // The noise of whole lines has one variance, but by chance its sample of a few frames differs from line to line.
  const LinesOfSensor & lines = found.variance.lines;
  const double          ofLines = found.correlation.LineNoise().value / gain.line.At(gain.line.pivotDn);
  const double scatter = Significance.hint * ofLines * std::sqrt(2.0 / static_cast<double>(found.scene.frame.frames));
  for (const auto & [own, name] : { std::pair(&lines.columns, "column"), std::pair(&lines.rows, "row") })
  {
    if (own->Differ() && own->size > scatter && !found.correlation.IsCorrelated() && MovesLittle(found.scene.model))
    {
      unlike.push_back(GainsOf(*own, name, gain, StudentOf(found)));
    }
  }
  return unlike;
}

/** Largest distances of the parts' gains below and above their mean, and their rms deviation, relative to it [1]. */
struct PartsRange
{
  double below{ 0.0 };
  double above{ 0.0 };
  double rms{ 0.0 };
};

PartsRange
RangeOf(const std::vector<UnlikeParts> & unlike, double gain)
{
  PartsRange range;
  for (const UnlikeParts & parts : unlike)
  {
    const auto [lowest, highest] = parts.Extremes();
    range.below += 1.0 - lowest.gain / gain;
    range.above += highest.gain / gain - 1.0;
    range.rms = std::hypot(range.rms, parts.rms);
  }
  return range;
}

/** Returns the read noise in electrons from that in DN and the gain. */
Quantity
InElectrons(const Quantity & readNoise, const DarkVariance & squareDn2, const GainEstimate & gain, double student)
{
  const double g = gain.line.gain;
  if (readNoise.status == EstimateStatus::UpperLimit)
  {
    return UpperLimit(*readNoise.bracket->high / g);
  }
  const double fromGain = 2.0 * squareDn2.valueDn2 / g * gain.StandardError();
  return RootOf(squareDn2.valueDn2 / (g * g), std::hypot(squareDn2.standardErrorDn2, fromGain) / (g * g), student);
}

/** Returns the covariance of gain, intercept and offset. The error of the offset is independent of the error of the
 * line; without an offset its elements are NaN. */
std::array<std::array<double, 3>, 3>
CovarianceOf(const GainEstimate & gain, std::optional<double> offsetVarianceDn2)
{
  // The error of assuming a linear response turns the line about its pivot.
  const double    ofModel = 0.5 * (gain.below + gain.above);
  const double    pivotDn = gain.line.pivotDn;
  Eigen::Matrix2d covariance;
  covariance << 1.0, -pivotDn, -pivotDn, pivotDn * pivotDn;
  covariance = gain.covariance + ofModel * ofModel * covariance;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const double other = offsetVarianceDn2 ? 0.0 : unknown;
  return { { { covariance(0, 0), covariance(0, 1), other },
             { covariance(0, 1), covariance(1, 1), other },
             { other, other, offsetVarianceDn2.value_or(unknown) } } };
}

/** Returns bounds of offset and read noise, which are not identifiable. */
DarkQuantities
QuantitiesByLimits(const OffsetLimits & limits, const GainEstimate & gain)
{
  const double largest = std::sqrt(limits.largestNoiseDn2);
  const auto   within = [](const Interval & bounds) {
    return Quantity::Without(EstimateStatus::NotIdentifiable, bounds);
  };
  DarkQuantities dark;
  dark.offset = within({ limits.lowestDn, limits.highestDn });
  dark.readNoise = within({ 0.0, largest });
  dark.readNoiseElectrons = within({ 0.0, largest / gain.line.gain });
  dark.covariance = CovarianceOf(gain, std::nullopt);
  return dark;
}

/** Fills the read noise by the value of the line at the offset. */
void
FillReadNoise(DarkQuantities &     dark,
              const GainEstimate & gain,
              const UsedOffset &   offset,
              double               quantisationDn2,
              double               student)
{
  const VarianceLine &  v = gain.line;
  const Eigen::Vector2d design(offset.valueDn, 1.0);
  const double          square = v.intercept + v.gain * offset.valueDn - quantisationDn2;
  const double          ofModel = 0.5 * (gain.below + gain.above) * (v.pivotDn - offset.valueDn);
  const double          error = std::sqrt(design.dot(gain.covariance * design) + ofModel * ofModel +
                                 v.gain * v.gain * offset.errorDn * offset.errorDn);
  if (square + Significance.severalTests * error < 0.0)
  {
    dark.readNoise = Quantity::Without(EstimateStatus::Failed);
    dark.readNoiseElectrons = Quantity::Without(EstimateStatus::Failed);
    return;
  }
  dark.readNoise = RootOf(square, error, student);
  // An error of the gain changes the divisor, too.
  const double          g2 = v.gain * v.gain;
  const Eigen::Vector2d inElectrons(offset.valueDn - 2.0 * square / v.gain, 1.0);
  const double          turned = 0.5 * (gain.below + gain.above) * (v.pivotDn - inElectrons(0));
  const double          electrons =
    std::sqrt(inElectrons.dot(gain.covariance * inElectrons) + turned * turned + g2 * offset.errorDn * offset.errorDn);
  dark.readNoiseElectrons = RootOf(square / g2, electrons / g2, student);
}
} // namespace

std::pair<const GainByPartsRecord::Part &, const GainByPartsRecord::Part &>
UnlikeParts::Extremes() const
{
  const auto byGain = [](const auto & a, const auto & b) { return a.gain < b.gain; };
  const auto [lowest, highest] = std::minmax_element(record.parts.begin(), record.parts.end(), byGain);
  return { *lowest, *highest };
}

TestedGain
QuantitiesBy(GainVerdict verdict, const GainEstimate & line, const RefinedResults & found, double quantisationDn2)
{
  TestedGain tested;
  tested.line = line;
  tested.verdict = verdict;
  if (verdict != GainVerdict::Identified)
  {
    for (Quantity * quantity : { &tested.gain, &tested.varianceSlope, &tested.intercept, &tested.totalIntercept })
    {
      *quantity = Quantity::Without(StatusBy(verdict));
    }
    if (verdict == GainVerdict::FewLitFrames || verdict == GainVerdict::LevelsTooAlike)
    {
      tested.gain.bracket = GainBounds(found, line);
    }
    return tested;
  }
  tested.parts = FindUnlikeParts(found, line);
  const QuantisationNoise & quantisation = found.variance.quantisationNoise;
  const double              student = StudentOf(found);
  const double              gain = line.line.gain;
  const PartsRange          parts = RangeOf(tested.parts, gain);
  const double              error = std::sqrt(line.covariance(0, 0));
  tested.gain = WithError(gain, std::hypot(line.StandardError(), parts.rms * gain), student);
  tested.gain.interval95 = Interval{ gain * (1.0 - parts.below) - line.below - student * error * (1.0 - parts.below),
                                     gain * (1.0 + parts.above) + line.above + student * error * (1.0 + parts.above) };
  tested.varianceSlope = tested.gain;
  tested.varianceSlope.value = gain + quantisation.slopeDn;
  tested.varianceSlope.interval95 = Interval{ *tested.gain.interval95->low + quantisation.slopeDn,
                                              *tested.gain.interval95->high + quantisation.slopeDn };
  tested.gain.bracket = GainBounds(found, line);
  // The value at the pivot is precise, so that an error of the gain changes the intercept in the opposite direction.
  const double interceptError =
    std::hypot(std::sqrt(line.covariance(1, 1)), 0.5 * (line.below + line.above) * line.line.pivotDn);
  tested.totalIntercept = WithError(line.line.intercept + quantisation.interceptDn2, interceptError, student);
  tested.intercept = WithError(line.line.intercept - quantisationDn2, interceptError, student);
  return tested;
}

DarkQuantities
QuantitiesOfDarkFrames(const RefinedSettings & settings,
                       double                  quantisationDn2,
                       EstimateStatus          status,
                       double                  filterFactor)
{
  DarkQuantities dark;
  dark.offset = dark.readNoise = dark.readNoiseElectrons = Quantity::Without(status);
  if (!settings.offset)
  {
    return dark;
  }
  const KnownOffset & known = *settings.offset;
  dark.offset = WithError(known.valueDn, known.standardErrorDn);
  if (!known.variance)
  {
    return dark;
  }
  const double student = StudentQuantile(0.975, std::max(1.0, static_cast<double>(known.darkFrames) - 1.0));
  const double square = known.variance->valueDn2 - quantisationDn2;
  const double halfStepDn2 = filterFactor * 3.0 * quantisationDn2; // below it, the quantization hides the noise
  dark.readNoise = square < halfStepDn2 ? UpperLimit(std::sqrt(halfStepDn2))
                                        : RootOf(square, known.variance->standardErrorDn2, student);
  if (known.readNoiseMedian)
  {
    dark.readNoiseMedian = WithError(known.readNoiseMedian->valueDn, known.readNoiseMedian->standardErrorDn, student);
  }
  return dark;
}

namespace
{
/** Returns the settings with errors of the dark frames that hold their difference from the line of the frames, which
 * another black level or another read noise explains, and their charge. */
RefinedSettings
WidenDarkErrors(const RefinedResults & found, const GainEstimate & gain)
{
  RefinedSettings settings = found.settings;
  const double    chargeDn2 = found.darkCharge.VarianceDn2(gain.line.gain);
  const double    addedDn2 = std::hypot(gain.darkDifferenceDn2, chargeDn2);
  if (addedDn2 > 0.0)
  {
    KnownOffset &  known = *settings.offset;
    DarkVariance & variance = *known.variance;
    known.standardErrorDn = std::hypot(known.standardErrorDn, addedDn2 / gain.line.gain);
    variance.standardErrorDn2 = std::hypot(variance.standardErrorDn2, addedDn2);
  }
  return settings;
}
} // namespace

DarkQuantities
QuantitiesByOffset(const RefinedResults & found,
                   const GainEstimate &   gain,
                   const OffsetLimits &   limits,
                   const OffsetEstimate & flicker,
                   double                 quantisationDn2)
{
  const auto & known = found.settings.offset;
  if (!known && !flicker.IsIdentified())
  {
    return QuantitiesByLimits(limits, gain);
  }
  const double     student = StudentOf(found);
  const UsedOffset offset = known ? UsedOffset{ known->valueDn, known->standardErrorDn }
                                  : UsedOffset{ flicker.valueDn, flicker.standardErrorDn };
  DarkQuantities   dark;
  if (known && known->variance)
  {
    const RefinedSettings settings = WidenDarkErrors(found, gain);
    dark = QuantitiesOfDarkFrames(settings, quantisationDn2, EstimateStatus::Failed, FilterFactor(found.correlation));
    const DarkVariance square{ known->variance->valueDn2 - quantisationDn2,
                               settings.offset->variance->standardErrorDn2 };
    dark.readNoiseElectrons = InElectrons(dark.readNoise, square, gain, student);
  }
  else
  {
    dark.offset = WithError(offset.valueDn, offset.errorDn);
    FillReadNoise(dark, gain, offset, quantisationDn2, student);
  }
  if (!known)
  {
    dark.offset.interval95 = flicker.interval;
  }
  const double errorDn = dark.offset.standardError.value_or(offset.errorDn);
  // The bracket contains the identified offset.
  dark.offset.bracket = Interval{ limits.lowestDn, std::max(limits.highestDn, offset.valueDn + errorDn) };
  if (limits.lowestDn)
  {
    dark.offset.bracket->low = std::min(*limits.lowestDn, offset.valueDn - errorDn);
  }
  dark.covariance = CovarianceOf(gain, errorDn * errorDn);
  return dark;
}

} // namespace sensornoise
