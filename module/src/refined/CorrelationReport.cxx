// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Text.h"
#include "correlation/Constants.h"
#include "refined/Constants.h"
#include "report/Quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace sensornoise
{

namespace
{
const LagCoefficient *
LargestOf(const std::vector<LagCoefficient> & lags)
{
  const auto largest = std::max_element(lags.begin(), lags.end(), [](const auto & a, const auto & b) {
    return std::abs(a.coefficient.value) < std::abs(b.coefficient.value);
  });
  return largest == lags.end() ? nullptr : &*largest;
}

std::string
PercentOf(const MeasuredNumber & number)
{
  return Measured(100.0 * number.value, 100.0 * number.standardError) + " %";
}

/** Returns "the noise correlation of pixels 1 row apart is 5.00 +- 0.30 %". */
std::string
CorrelationOf(const LagCoefficient & neighbour)
{
  const Lag & lag = neighbour.lag;
  const auto  count = [](int apart, const char * what) {
    return std::to_string(std::abs(apart)) + " " + what + (std::abs(apart) == 1 ? "" : "s");
  };
  const std::string distance = lag.y == 0   ? count(lag.x, "column")
                               : lag.x == 0 ? count(lag.y, "row")
                                            : count(lag.x, "column") + " and " + count(lag.y, "row");
  return "the noise correlation of pixels " + distance + " apart is " + PercentOf(neighbour.coefficient);
}

/** Returns how the gain follows from the variance, and then \a action, a command. */
std::string
Consequence(const Report & report, const std::string & action)
{
  if (!report.gain.value || !report.varianceSlope.value)
  {
    return ". " + action;
  }
  return ". The slope of the variance (variance_slope) is " +
         Text(std::round(100.0 * *report.varianceSlope.value / *report.gain.value)) +
         " % of the gain, which is from the covariance over all lags. " + action;
}

/** Returns whether the noise is normally distributed, as after a linear filter. Then the covariances are the reason why
 * the gain is not given. */
bool
IsNormal(const NoiseCorrelation & correlation)
{
  return std::none_of(correlation.kurtosis.begin(), correlation.kurtosis.end(), [](const MeasuredNumber & kurtosis) {
    return kurtosis.Exceeds(0.0, Significance.severalTests);
  });
}

/** Names of the kinds of series in KurtosisSums, without single pixels. */
constexpr std::array<const char *, KurtosisSums::Kinds - 1> NamesOfDifferences{ { "of horizontal differences",
                                                                                  "of vertical differences",
                                                                                  "of differences in 2 x 2 pixels",
                                                                                  "of differences in 8 x 1 pixels",
                                                                                  "of differences in 1 x 8 pixels" } };

/** Returns the kind of series in KurtosisSums, except single pixels, whose kurtosis is least probable for normal noise.
 */
std::size_t
MostUnusualDifference(const NoiseCorrelation & correlation)
{
  std::size_t most = 3; // default, if no kurtosis was measured
  double      largest = 0.0;
  for (std::size_t kind = 1; kind < correlation.kurtosis.size(); ++kind)
  {
    const MeasuredNumber & kurtosis = correlation.kurtosis[kind];
    const double           z = kurtosis.standardError > 0.0 ? std::abs(kurtosis.value) / kurtosis.standardError : 0.0;
    if (z > largest)
    {
      largest = z;
      most = kind;
    }
  }
  return most;
}

/** Returns the known cause of noise that no linear filter makes, and what to do; null: none is known. \a space is the
 * largest coefficient of a spatial lag, or null. */
std::optional<std::string>
CauseOfNonlinear(const NoiseCorrelation & correlation, const LagCoefficient * space)
{
  if (correlation.repeatedFraction > 0.0)
  {
    return PercentApart(correlation.repeatedFraction, InRefined.largestRepeatedFraction) +
           " of the pixels repeat their value in the frame before, beyond chance (expected at most " +
           Percent(InRefined.largestRepeatedFraction) +
           "): a video coder skips blocks, or parts of frames are repeated, so that the gain is not "
           "identifiable. Record raw frames";
  }
  if (correlation.copiedFraction > 0.0)
  {
    const std::string line = correlation.copiedAxis == LineAxis::Rows ? "row" : "column";
    return PercentApart(correlation.copiedFraction, InRefined.largestRepeatedFraction) + " of the " + line +
           "s are copies of the " + line + " before them in single frames (expected at most " +
           Percent(InRefined.largestRepeatedFraction) +
           "): lost parts of frames were concealed, so that the gain is not identifiable. Record frames without "
           "losses: at a lower frame rate, or with larger packets or buffers";
  }
  if (correlation.isByIllumination && space != nullptr)
  {
    return CorrelationOf(*space) +
           " and grows with the square of the signal: the illumination changes from place to place, in patterns "
           "too fine to be removed (caustics, haze, moving shadows). Choose an evenly lit part "
           "(--roi), or steady the illumination";
  }
  if (correlation.DetailsChange())
  {
    return "at the bright levels the nearest neighbours have a covariance of " +
           PercentOf(correlation.brightCovariance) + " of the noise variance (expected at most " +
           Percent(InCorrelation.leastBrightCovariance) +
           "), and pixels of all levels together none: details of the scene change or move by themselves, as "
           "stars that twinkle. Charge that spreads to neighbours has the same effect. Choose a part of the "
           "scene without them (--roi), or record it at rest";
  }
  if (correlation.isBySensitivity)
  {
    return "the noise correlation between frames grows with the square of the signal, as no filter makes it: the "
           "sensitivity "
           "of pixels drifts during the burst, or the illumination changes in patterns too fine to be removed. "
           "Record a shorter burst, let the sensor settle, or choose an evenly lit part (--roi)";
  }
  if (correlation.MixesByDifference())
  {
    const MeasuredNumber & excess = correlation.kurtosisOfSteps;
    return "the differences between successive frames have an excess kurtosis of " +
           Measured(excess.value, excess.standardError) + " (expected at most " +
           Text(InCorrelation.largestExcessOfSteps) +
           "), which no linear filter makes: frames are mixed only where they differ little, so that the gain is not "
           "identifiable. Switch noise reduction in time off, or record raw frames";
  }
  if (correlation.HasLocalMotion())
  {
    return PercentOf(correlation.localMotion) +
           " of the noise variance is common to neighbours in proportion to the slopes of the scene (expected "
           "at most " +
           Percent(InCorrelation.leastLocalMotion) +
           "): parts of the scene move by themselves, as in heat haze, or pulsed illumination under a rolling shutter "
           "lights rows unequally while the scene moves. Choose a smooth part of the scene (--roi), record it at rest, "
           "or use illumination without pulses";
  }
  if (correlation.LacksTail())
  {
    return "of the values more than " + Text(InCorrelation.tailBegins) +
           " standard deviations above their mean that normal noise has, " + Percent(-correlation.upperTail.value) +
           " are missing (expected at most " + Percent(InCorrelation.largestTailDeficit) +
           "): outliers were removed, as of cosmic rays or defects, and noise with them, so that the gain is not "
           "identifiable. Give the frames as the camera read them";
  }
  return std::nullopt;
}

void
WarnOfNonlinear(Report & report, const NoiseCorrelation & correlation, const LagCoefficient * space)
{
  if (const std::optional<std::string> cause = CauseOfNonlinear(correlation, space))
  {
    report.Warn(WarningCode::NoiseNotLinear, *cause);
    return;
  }
  const MeasuredNumber & own = correlation.kurtosis.front();
  const std::size_t      kind = MostUnusualDifference(correlation);
  const MeasuredNumber & other = correlation.kurtosis.at(kind);
  const std::string      kurtosis = "excess kurtosis " + Measured(own.value, own.standardError) + ", " +
                               NamesOfDifferences.at(kind - 1) + " " + Measured(other.value, other.standardError) +
                               ", expected 0";
  if (space != nullptr && IsNormal(correlation))
  {
    report.Warn(
      WarningCode::NoiseNotLinear,
      CorrelationOf(*space) +
        " and does not grow with the signal as after a filter: periodic interference, or blocks of rounded pixels "
        "(compression). The noise is normal (" +
        kurtosis +
        "). Record raw frames, and look for the source of the interference in cables, power supply and read-out "
        "clock");
    return;
  }
  const bool isOfPixels = own.Exceeds(0.0, Significance.severalTests);
  report.Warn(WarningCode::NoiseNotLinear,
              (isOfPixels ? "the noise is not normally distributed ("
                          : "differences of neighbours are not normally distributed (") +
                kurtosis +
                "): the camera corrects defects, takes medians or compresses. Set the camera to raw frames, without "
                "corrections");
}

std::string
TextOf(const EnlargementTrace & trace, const std::optional<Interval> & gain)
{
  std::string text = "the noise correlation of pixels " + std::to_string(trace.lag) +
                     (trace.isAlongX ? " column" : " row") + (trace.lag == 1 ? "" : "s") + " apart changes by " +
                     PercentApart(trace.amplitude, InCorrelation.leastOscillation) + " (expected at most " +
                     Percent(InCorrelation.leastOscillation) + ") every " +
                     Text(std::round(10.0 / trace.cyclesPerPixel) / 10.0) +
                     " pixels: the frames were enlarged or a mosaic was interpolated";
  if (gain && gain->low && gain->high)
  {
    text += ". The gain is between " + Rounded(*gain->low) + " and " + Rounded(*gain->high) + " DN/e-";
  }
  return text + ". Give the frames as the camera read them";
}

/** Returns a clause where the covariance grows with the signal alone, by a filter before the read-out or events of
 * several electrons; else an empty text. */
std::string
BeforeReadOut(const NoiseCorrelation & correlation)
{
  return correlation.ProbabilityOfLateNoise() > 0.5
           ? ". The noise is spread before the read-out, so that the gain is per event where one event frees several "
             "electrons (scintillator, intensifier)"
           : "";
}

void
NoteInterference(Report & report)
{
  if (!report.noiseCorrelation || report.noiseCorrelation->interference.empty())
  {
    return;
  }
  const auto & waves = report.noiseCorrelation->interference;
  const auto   strongest =
    *std::max_element(waves.begin(), waves.end(), [](const auto & a, const auto & b) { return a.rmsDn < b.rmsDn; });
  const std::string others =
    waves.size() == 1 ? "" : ", the strongest of " + std::to_string(waves.size()) + " such waves,";
  report.Warn(WarningCode::PeriodicInterference,
              "a wave of " + Measured(strongest.rmsDn, strongest.rmsStandardErrorDn) + " DN rms, with " +
                Rounded(strongest.cyclesPerColumn) + " cycles per column and " + Rounded(strongest.cyclesPerRow) +
                " cycles per row" + others +
                " has another phase in each frame: periodic interference, which gain, intercept and read noise do not "
                "contain. Look for its source in cables, power supply and read-out clock");
}
} // namespace

void
WarnOfCorrelation(Report & report, const NoiseCorrelation & correlation)
{
  NoteInterference(report);
  const LagCoefficient * space = LargestOf(correlation.space);
  const LagCoefficient * time = LargestOf(correlation.time);
  switch (correlation.kind)
  {
    case NoiseKind::NotLinear:
      WarnOfNonlinear(report, correlation, space);
      break;
    case NoiseKind::Temporal:
      report.Warn(WarningCode::NoiseCorrelated,
                  "the camera mixes its frames: the noise correlation of frames " + std::to_string(time->lag.t) +
                    " apart is " + PercentOf(time->coefficient) +
                    Consequence(report, "Switch the temporal noise reduction off"));
      break;
    case NoiseKind::Filtered:
      report.Warn(WarningCode::NoiseCorrelated,
                  "the camera smooths, resamples or sharpens its frames: " + CorrelationOf(*space) +
                    BeforeReadOut(correlation) + Consequence(report, "Set the camera to raw frames"));
      break;
    case NoiseKind::Enlarged:
      report.Warn(WarningCode::FramesEnlarged, TextOf(*correlation.enlargement, report.gain.bracket));
      break;
    case NoiseKind::Crosstalk:
      report.Warn(WarningCode::NoiseCorrelated,
                  "neighbours are coupled, or slightly filtered: " + CorrelationOf(*space) +
                    Consequence(report, "Set the camera to raw frames, if it filters"));
      break;
    case NoiseKind::BrighterFatter:
      report.Warn(WarningCode::NoiseCorrelated,
                  "charge repels charge in bright pixels (brighter-fatter effect): " + CorrelationOf(*space) +
                    ", and grows with the square of the signal" +
                    Consequence(report, "Use `gain` for electrons, and `variance_slope` for the noise of the frames"));
      break;
    case NoiseKind::White:
    case NoiseKind::NotMeasured:
      break;
  }
}

bool
HasCorrelatedNeighbours(const Report & report, const NeighbourCovariance & covariance)
{
  return report.varianceSlope.value &&
         covariance.slope.Exceeds(InCorrelation.leastEffect * *report.varianceSlope.value, Significance.severalTests) &&
         covariance.typical / covariance.slope.value > InCorrelation.leastTypical;
}

void
AddToGain(Report & report, const NeighbourCovariance & covariance)
{
  if (!report.gain.value || !report.gain.interval95 || !report.varianceSlope.value)
  {
    return;
  }
  // The excess noise factor divides both.
  const double relative = covariance.slope.value / *report.varianceSlope.value;
  const double before = *report.gain.value;
  const double added = relative * before;
  const double ofSlope = covariance.slope.standardError / *report.varianceSlope.value * before;
  const double random = std::hypot(report.gain.standardError.value_or(0.0), ofSlope);
  const double error = std::hypot(random, 0.5 * added); // how far the noise spreads is not known
  const double reach = NormalQuantile(0.975) * error;
  report.gain.value = before + added;
  report.gain.standardError = error;
  report.gain.interval95 = Interval{ before + added - reach, before + added + reach };
  report.covariance.reset();
  report.gainByParts.clear();
  for (Quantity * const quantity :
       { &report.intercept, &report.readNoise, &report.readNoiseMedian, &report.readNoiseElectrons })
  {
    *quantity = Quantity::Without(EstimateStatus::NotIdentifiable);
  }
  if (report.noiseCorrelation)
  {
    report.noiseCorrelation->kind = "filtered";
  }
  report.Warn(WarningCode::NoiseCorrelated,
              "the noise of neighbouring pixels of different colours is correlated: their covariances add " +
                PercentApart(relative, InCorrelation.leastEffect) +
                " to the slope of the variance. The camera smooths or sharpens its frames or subtracts crosstalk, or "
                "charge couples neighbours. The interval of the gain contains the gain without them" +
                Consequence(report, "Set the camera to raw frames"));
  FileStatuses(report);
}

} // namespace sensornoise
