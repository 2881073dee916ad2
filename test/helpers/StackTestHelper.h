// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_StackTestHelper_h
#define sensornoise_test_StackTestHelper_h

#include "sensornoise/Parallel.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <thread>
#include <vector>

/** \file
 * Simulated stacks, and threads. */

namespace sensornoise::test
{

/** A stack, frame after frame. */
template <typename TPixel>
struct Stack
{
  std::size_t         width;
  std::size_t         height;
  std::size_t         frames;
  std::vector<TPixel> pixels;

  const TPixel *
  Frame(std::size_t t) const
  {
    return pixels.data() + t * width * height;
  }
  /** Returns the stack with pixels of \a TOther, function(u) in place of u. */
  template <typename TOther = TPixel, typename TFunction>
  Stack<TOther>
  Map(TFunction function) const
  {
    Stack<TOther> mapped{ width, height, frames, std::vector<TOther>(pixels.size()) };
    std::transform(
      pixels.begin(), pixels.end(), mapped.pixels.begin(), [&](TPixel u) { return static_cast<TOther>(function(u)); });
    return mapped;
  }
};

/** Returns camera B of the paper, with flicker and vibration that a small stack shows well. */
inline SimulationSettings
FlickeringSettings(std::size_t frames)
{
  SimulationSettings settings;
  settings.conditions = { 0.05, 0.05, 0.02 };
  settings.frames = frames;
  settings.seed = 11;
  return settings;
}

template <typename TPixel>
Stack<TPixel>
Simulate(const SimulationSettings &  settings,
         std::size_t                 width,
         std::size_t                 height,
         const std::vector<double> & scene = {})
{
  const StackSimulator simulator(scene.empty() ? MakeTargetScene(width, height) : scene, width, height, settings);
  Stack<TPixel>        stack{ width, height, settings.frames, std::vector<TPixel>(width * height * settings.frames) };
  for (std::size_t frame = 0; frame < settings.frames; ++frame)
  {
    simulator.RenderFrame(frame, stack.pixels.data() + frame * width * height);
  }
  return stack;
}

/** Returns a ParallelFor of \a count threads, which take the pieces in turn and backwards. */
inline ParallelFor
Threads(std::size_t count)
{
  return [count](std::size_t pieces, const std::function<void(std::size_t)> & function) {
    std::vector<std::thread> threads;
    for (std::size_t first = 0; first < std::min(count, pieces); ++first)
    {
      threads.emplace_back([=, &function] {
        for (std::size_t i = first; i < pieces; i += count)
        {
          function(pieces - 1 - i);
        }
      });
    }
    std::for_each(threads.begin(), threads.end(), [](std::thread & thread) { thread.join(); });
  };
}

template <typename TNumber>
bool
HaveSameBits(const std::vector<TNumber> & a, const std::vector<TNumber> & b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(TNumber)) == 0;
}

} // namespace sensornoise::test

#endif
