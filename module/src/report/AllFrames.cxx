// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/AllFrames.h"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

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

/** "frame 3: no-noise, frame 31: other-shape, ...": the first ones. */
std::string
TextOfLeftOut(const std::vector<LeftOutFrame> & leftOut)
{
  constexpr std::size_t most = 4;
  std::string           text;
  for (std::size_t k = 0; k < leftOut.size() && k <= most; ++k)
  {
    text += k == 0 ? "" : ", ";
    text += k == most ? "..." : "frame " + std::to_string(leftOut[k].frame) + ": " + NameOf(leftOut[k].fault);
  }
  return text;
}

template <typename TValue>
void
SpreadOverFrames(std::vector<TValue> & series, const DistinctFrames & frames, const TValue & ofLeftOut)
{
  if (!series.empty())
  {
    series = frames.OfGiven(series, ofLeftOut);
  }
}

std::string
OfFrames(std::size_t count, std::size_t all)
{
  return std::to_string(count) + " of " + std::to_string(all) + " frames " + (count == 1 ? "is" : "are");
}
} // namespace

void
ReportAllFrames(Report & report, const DistinctFrames & frames, const std::vector<LeftOutFrame> & leftOut)
{
  report.frames = frames.Given();
  report.framesDistinct = frames.Count();
  report.framesLeftOut = leftOut;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  SpreadOverFrames(report.flicker, frames, unknown);
  SpreadOverFrames(report.flickerRows,
                   frames,
                   std::vector<double>(report.flickerRows.empty() ? 0 : report.flickerRows.front().size(), unknown));
  SpreadOverFrames(report.motion, frames, { unknown, unknown });
  // In front: what follows is of the frames that are counted.
  if (frames.Repeated() > 0)
  {
    const Warning warning{ WarningCode::RepeatedFrames,
                           OfFrames(frames.Repeated(), frames.Given()) + " equal to an earlier one (" +
                             TextOfRepeated(frames) + "; the first is 0): each is counted once" };
    report.warnings.insert(report.warnings.begin(), warning);
  }
  if (!leftOut.empty())
  {
    const Warning warning{ WarningCode::FramesLeftOut,
                           OfFrames(leftOut.size(), frames.Given()) + " unlike the others (" + TextOfLeftOut(leftOut) +
                             "; the first is 0): all else is measured without " +
                             (leftOut.size() == 1 ? "it" : "them") };
    report.warnings.insert(report.warnings.begin(), warning);
  }
}

} // namespace sensornoise
