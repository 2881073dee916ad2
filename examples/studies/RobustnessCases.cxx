// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/MeasuredStack.h"
#include "studies/StressStacks.h"
#include "studies/StudyCase.h"

#include <algorithm>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
constexpr std::size_t RobustnessSize = 512; // [pixels]

const char *
NameOf(StressExpectation expectation)
{
  switch (expectation)
  {
    case StressExpectation::Measured:
      return "measured";
    case StressExpectation::Nonlinear:
      return "non-linear";
    case StressExpectation::Refused:
      return "refused";
    case StressExpectation::Processed:
      break;
  }
  return "processed";
}

MeasuredStack
Measure(const StressStack & stack, const std::string & method)
{
  const FrameGeometry geometry{ stack.width, stack.height, 1 };
  if (stack.isEightBit)
  {
    return MeasureBy(
      method, std::vector<std::uint8_t>(stack.greyValues.begin(), stack.greyValues.end()), geometry, stack.frames);
  }
  return MeasureBy(method, stack.greyValues, geometry, stack.frames);
}

std::vector<nlohmann::ordered_json>
MeasureCase(const StressCase & one, const std::string & scene, const StudyOptions & options, std::uint64_t seed)
{
  const StressStack         stack = MakeStressStack(one.name, scene, options.size.value_or(RobustnessSize), seed);
  const MeasuredStack       measured = Measure(stack, options.method);
  std::vector<std::uint8_t> isUsed(measured.pixelUse.size());
  std::transform(measured.pixelUse.begin(), measured.pixelUse.end(), isUsed.begin(), [](std::uint8_t use) {
    return static_cast<PixelUse>(use) == PixelUse::Used ? std::uint8_t{ 1 } : std::uint8_t{ 0 };
  });
  const StressTruth truth = stack.TruthOver(isUsed);
  const double intercept = truth.InterceptNear(measured.report.intercept.value.value_or(0.0), stack.lineVarianceDn2);
  return { { { "expectation", NameOf(one.expectation) },
             { "truth", { { "gain", truth.gain }, { "offset", truth.offset }, { "intercept", intercept } } },
             { "report", measured.ReportRecord() } } };
}
} // namespace

void
AppendRobustnessCases(std::vector<StudyCase> & cases)
{
  for (const StressCase & one : GetStressCases())
  {
    for (const char * scene : { "target", "texture" })
    {
      cases.push_back(
        { "robustness/" + one.name + '/' + scene, one.what, [one, scene](const auto & options, std::uint64_t seed) {
           return MeasureCase(one, scene, options, seed);
         } });
    }
  }
}

} // namespace sensornoise::tools
