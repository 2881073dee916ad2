// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RenderedStack_h
#define RenderedStack_h

#include "sensornoise/Simulator.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise::tools
{

/** Returns all frames of a simulated stack, frame after frame [DN]. */
inline std::vector<std::uint16_t>
RenderStack(const StackSimulator & simulator, std::size_t width, std::size_t height, std::size_t frames)
{
  std::vector<std::uint16_t> stack(width * height * frames);
  for (std::size_t row = 0; row < height * frames; ++row)
  {
    simulator.RenderRow(row / height, row % height, stack.data() + row * width);
  }
  return stack;
}

} // namespace sensornoise::tools

#endif
