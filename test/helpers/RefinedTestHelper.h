// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_RefinedTestHelper_h
#define sensornoise_test_RefinedTestHelper_h

#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "moments/StackMaps.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"
#include "helpers/ReportTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>

/** \file
 * The refined method, run on stacks. */

namespace sensornoise::test
{

/** Grey values of 16 bits, with the clip levels of 12 bits above \a lowDn. */
inline RefinedSettings
WithDnSettings(double stepDn = 1.0, double lowDn = 0.0)
{
  RefinedSettings settings;
  settings.dnSettings = MakeDnSettings(16, lowDn, lowDn + 4095.0 * stepDn, stepDn);
  return settings;
}

template <typename TPixel>
FrameGeometry
GeometryOf(const Stack<TPixel> & stack)
{
  return { stack.width, stack.height, 1 };
}

template <typename TPixel>
RefinedMethod<TPixel>
Measure(const Stack<TPixel> &   stack,
        const RefinedSettings & settings = WithDnSettings(),
        std::size_t             chunk = 1000,
        const ParallelFor &     parallelFor = SerialFor)
{
  RefinedMethod<TPixel> method(settings, GeometryOf(stack), stack.frames, {}, parallelFor);
  while (!method.IsDone())
  {
    for (std::size_t t = 0; t < stack.frames; t += chunk)
    {
      method.AddFrames(stack.Frame(t), std::min(chunk, stack.frames - t));
    }
    method.EndPass();
  }
  return method;
}

} // namespace sensornoise::test

#endif
