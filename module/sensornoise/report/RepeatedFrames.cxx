// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/report/RepeatedFrames.h"

#include <cstddef>
#include <string>

namespace sensornoise
{

namespace
{
/** "frame 1 equals frame 0, frame 3 equals frame 2, ...": the first ones. */
std::string
TextOfRepeated(const DistinctFrames & frames)
{
  constexpr std::size_t most = 2;
  std::string           text;
  std::size_t           count = 0;
  for (std::size_t t = 0; t < frames.Given() && count <= most; ++t)
  {
    if (frames.OriginalOf(t) != t)
    {
      text += count == 0 ? "" : ", ";
      text +=
        count == most ? "..." : "frame " + std::to_string(t) + " equals frame " + std::to_string(frames.OriginalOf(t));
      ++count;
    }
  }
  return text;
}

template <typename TValue>
void
Repeat(std::vector<TValue> & series, const DistinctFrames & frames)
{
  if (!series.empty())
  {
    series = frames.OfGiven(series);
  }
}
} // namespace

void
ReportAllFrames(Report & report, const DistinctFrames & frames)
{
  report.frames = frames.Given();
  report.framesDistinct = frames.Count();
  const std::size_t repeated = frames.Given() - frames.Count();
  if (repeated == 0)
  {
    return;
  }
  Repeat(report.flicker, frames);
  Repeat(report.flickerRows, frames);
  Repeat(report.motion, frames);
  const Warning warning{ WarningCode::RepeatedFrames,
                         std::to_string(repeated) + " of " + std::to_string(frames.Given()) + " frames " +
                           (repeated == 1 ? "is" : "are") + " equal to an earlier one (" + TextOfRepeated(frames) +
                           "; the first is 0): each is counted once" };
  report.warnings.insert(report.warnings.begin(), warning); // what follows is of the distinct frames
}

} // namespace sensornoise
