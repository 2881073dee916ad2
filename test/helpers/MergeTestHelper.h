// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_MergeTestHelper_h
#define sensornoise_test_MergeTestHelper_h

#include "sensornoise/StackMethod.h"
#include "helpers/RefinedTestHelper.h"

#include <cstddef>

/** \file
 * The refined method, run on parts of a stack. */

namespace sensornoise::test::merge
{

inline constexpr std::size_t Width = 96;
inline constexpr std::size_t Height = 80;
inline constexpr std::size_t Frames = 24;

template <typename TPixel>
const Stack<TPixel> &
SmallStack()
{
  static const auto stack = Simulate<TPixel>(FlickeringSettings(Frames), Width, Height);
  return stack;
}

template <typename TPixel>
RefinedMethod<TPixel>
MethodOf(const Stack<TPixel> & stack)
{
  return RefinedMethod<TPixel>(WithDnSettings(), GeometryOf(stack), stack.frames);
}

/** Which of \a processes reads a frame. */
using Reader = std::size_t (*)(std::size_t t, std::size_t processes);

inline std::size_t
InRuns(std::size_t t, std::size_t processes)
{
  return t * processes / Frames;
}
inline std::size_t
InTurn(std::size_t t, std::size_t processes)
{
  return t % processes;
}

template <typename TPixel>
void
AddPart(RefinedMethod<TPixel> & method, const Stack<TPixel> & stack, std::size_t process, std::size_t count, Reader of)
{
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    of(t, count) == process ? method.AddFrames(stack.Frame(t), 1) : method.SkipFrames(1);
  }
}

} // namespace sensornoise::test::merge

#endif
