// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_SimulatorTestHelper_h
#define sensornoise_test_SimulatorTestHelper_h

#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"

#include <cstddef>
#include <vector>

/** \file
 * Stacks that hold still, and what their pixels scatter by. */

namespace sensornoise::test::simulator
{

/** No flicker, no vibration. */
inline SimulationSettings
StaticSettings(char camera, std::size_t frames)
{
  SimulationSettings settings;
  settings.camera = PaperCamera(camera);
  settings.conditions = { 0.0, 0.0, 0.0 };
  settings.frames = frames;
  return settings;
}

struct Moments
{
  double count{ 0.0 };
  double mean{ 0.0 };
  double variance{ 0.0 };
};

inline Moments
MomentsOf(const std::vector<double> & values)
{
  Moments moments;
  for (const double value : values)
  {
    moments.count += 1.0;
    moments.mean += value;
  }
  moments.mean /= moments.count;
  for (const double value : values)
  {
    moments.variance += (value - moments.mean) * (value - moments.mean);
  }
  moments.variance /= moments.count - 1.0;
  return moments;
}

template <typename TPixel>
std::vector<double>
RenderAll(const StackSimulator & simulator)
{
  std::vector<double> values;
  std::vector<TPixel> row(simulator.GetWidth());
  for (std::size_t frame = 0; frame < simulator.GetTruth().settings.frames; ++frame)
  {
    for (std::size_t y = 0; y < simulator.GetHeight(); ++y)
    {
      simulator.RenderRow(frame, y, row.data());
      values.insert(values.end(), row.begin(), row.end());
    }
  }
  return values;
}

} // namespace sensornoise::test::simulator

#endif
