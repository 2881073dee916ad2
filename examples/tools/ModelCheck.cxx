// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ModelCheck.h"

#include "sensornoise/report/ReportJson.h"
#include "sensornoise/stabilise/NoiseModel.h"
#include "tools/CompanionFiles.h"
#include "tools/EstimateOptions.h"
#include "tools/StackEstimate.h"
#include "itkSensorNoiseFrameFiles.h"

#include <iostream>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
/** What the refined method says of the frames to be checked: no other method tells every pixel's variance without what
 * flicker and motion add. What was told of the report's frames, but for those that were chosen and for dark frames, is
 * true of them, too. */
Report
MeasureFramesToCheck(const EstimateOptions & options)
{
  EstimateOptions other = options;
  other.method = "refined";
  if (options.check.empty())
  {
    return EstimateStack(other, OpenFrames(other.files), nullptr);
  }
  other.files = options.check;
  other.frames.reset();
  other.dark.clear();
  const FrameList frames = OpenFrames(other.files);
  TellWarningOf(frames);
  return EstimateStack(other, frames, nullptr);
}
} // namespace

std::optional<NoiseModelCheck>
CheckModel(const EstimateOptions & options, const Report & report)
{
  try
  {
    NoiseModelOf(report);
  }
  catch (const std::invalid_argument & error)
  {
    std::cerr << "error: the noise model cannot be checked: " << error.what() << '\n';
    return std::nullopt;
  }
  const bool isMeasured = options.check.empty() && options.method == "refined";
  return CheckReport(isMeasured ? report : MeasureFramesToCheck(options), report);
}

std::string
ToJson(const Report & report, const std::optional<NoiseModelCheck> & check)
{
  std::string text = sensornoise::ToJson(report);
  if (check)
  {
    std::string member = sensornoise::ToJson(*check);
    member.erase(member.find_last_not_of('\n') + 1);
    text.insert(text.rfind('}'), ", \"check\": " + member);
  }
  return text;
}

} // namespace sensornoise::tools
