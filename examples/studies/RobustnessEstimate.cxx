// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RobustnessEstimate.h"

namespace sensornoise::tools
{

void
FileEstimation(Run & run, const StressStack & stack, const Estimation & estimation)
{
  const StressTruth truth = stack.TruthOver(estimation.isUsed);
  run.report = estimation.report;
  run.gain = truth.gain;
  run.gainPercent = Compare(run.report.gain, truth.gain, 0.01 * truth.gain);
  run.intercept = Compare(
    run.report.intercept, truth.InterceptNear(run.report.intercept.value.value_or(0.0), stack.sharedVariance), 1.0);
  run.offset = Compare(run.report.offset, truth.offset, 1.0);
}

} // namespace sensornoise::tools
