// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ProfileCheck.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace sensornoise
{
namespace
{
/** Returns a number of a report; NaN if it is null or missing. */
double
NumberOrNan(const StoredReport & report, const std::string & pointer)
{
  const auto found = report.numbers.find(pointer);
  return found == report.numbers.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

/** Returns a number of a report that counts something; 0 if it is missing or is none. */
std::size_t
CountAt(const StoredReport & report, const std::string & pointer)
{
  constexpr double most = 9007199254740992.0; // 2^53: the largest count that a double holds exactly
  const double     number = NumberOrNan(report, pointer);
  return number > 0.0 && number <= most ? static_cast<std::size_t>(number) : 0;
}

/** Returns the noise curve of a channel of a stored report, its number of frames, and its first warning. \a at is the
 * JSON Pointer of the channel. */
Report
FramesAt(const StoredReport & report, const std::string & at)
{
  const auto method = report.texts.find(at + "/method");
  if (method != report.texts.end() && method->second != "refined")
  {
    throw ExportError("the report " + report.name + " is of the method " + method->second +
                      "; expected a report of the refined method, which gives the variance of each level");
  }
  Report frames;
  frames.framesDistinct = CountAt(report, at + "/frames_distinct");
  const std::string curve = at + "/scatter/";
  for (std::size_t i = 0; report.numbers.count(curve + "mean/" + std::to_string(i)) > 0; ++i)
  {
    const std::string bin = "/" + std::to_string(i);
    const std::size_t pixels = CountAt(report, curve + "count" + bin);
    if (pixels == 0)
    {
      throw ExportError("the report " + report.name + " has a noise curve without its numbers of pixels (scatter" +
                        "/count" + bin + "); expected a whole report of estimate-sensor-noise");
    }
    frames.scatter.mean.push_back(NumberOrNan(report, curve + "mean" + bin));
    frames.scatter.variance.push_back(NumberOrNan(report, curve + "variance" + bin));
    frames.scatter.correctedVariance.push_back(NumberOrNan(report, curve + "corrected_variance" + bin));
    frames.scatter.count.push_back(pixels);
  }
  if (!std::is_sorted(frames.scatter.mean.begin(), frames.scatter.mean.end()))
  {
    throw ExportError("the report " + report.name +
                      " has a noise curve whose levels do not rise (scatter/mean); expected a report as "
                      "estimate-sensor-noise writes it");
  }
  const auto warning = report.texts.find(at + "/warnings/0/message");
  if (warning != report.texts.end())
  {
    frames.warnings.push_back({ WarningCode::FewFrames, warning->second }); // the message alone is used
  }
  return frames;
}
} // namespace

std::vector<ChannelProfileCheck>
CheckStoredFrames(const NoiseProfile & profile, const StoredReport & frames, const CameraNoise & noise)
{
  const bool                       isMosaic = frames.texts.count("/channels/0/channel") > 0;
  std::vector<ChannelProfileCheck> checks;
  for (std::size_t i = 0; i < noise.channels.size(); ++i)
  {
    ChannelProfileCheck made;
    made.channel = noise.channels[i].channel;
    CameraNoise burst = noise;
    burst.channels = { noise.channels[i] };
    const Report measured = FramesAt(frames, isMosaic ? "/channels/" + std::to_string(i) : "");
    try
    {
      made.check = CheckNoiseProfile(profile, measured, burst);
    }
    catch (const ExportError & error)
    {
      made.reason = error.what();
    }
    checks.push_back(made);
  }
  return checks;
}

} // namespace sensornoise
