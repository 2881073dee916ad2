// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/Partition.h"

#include <algorithm>

namespace sensornoise
{

namespace
{
std::size_t
Along(double place, std::size_t parts)
{
  return std::min(parts - 1, static_cast<std::size_t>(std::max(0.0, place) * static_cast<double>(parts)));
}

std::string
NameOfPhase(std::size_t part, std::size_t period)
{
  return "column " + std::to_string(part % period) + ", row " + std::to_string(part / period) + " of " +
         std::to_string(period) + " x " + std::to_string(period);
}
} // namespace

std::size_t
PartOf(Partition partition, double x, double y, std::size_t phase)
{
  const std::size_t column = phase % LargestPeriod;
  const std::size_t row = phase / LargestPeriod;
  switch (partition)
  {
    case Partition::LeftRight:
      return Along(x, 2);
    case Partition::UpperLower:
      return Along(y, 2);
    case Partition::Quadrants:
      return 2 * Along(y, 2) + Along(x, 2);
    case Partition::Blocks:
    case Partition::SmoothField:
      return BlocksAcross * Along(y, BlocksAcross) + Along(x, BlocksAcross);
    case Partition::Columns2:
      return column % 2;
    case Partition::Rows2:
      return row % 2;
    case Partition::Phases2:
      return 2 * (row % 2) + column % 2;
    case Partition::Columns4:
      return column;
    case Partition::Rows4:
      return row;
    case Partition::FrameHalves:
      return phase / 4;
    case Partition::FrameQuarters:
      return phase / 2;
    case Partition::FrameParities:
      return phase % 2;
    case Partition::Phases4:
      break;
  }
  return phase;
}

std::string
NameOfPart(Partition partition, std::size_t part)
{
  switch (partition)
  {
    case Partition::LeftRight:
      return part == 0 ? "left half" : "right half";
    case Partition::UpperLower:
      return part == 0 ? "upper half" : "lower half";
    case Partition::Quadrants:
      return std::string(part < 2 ? "upper " : "lower ") + (part % 2 == 0 ? "left" : "right");
    case Partition::Blocks:
    case Partition::SmoothField:
      return "block column " + std::to_string(part % BlocksAcross) + ", row " + std::to_string(part / BlocksAcross);
    case Partition::Columns2:
      return part == 0 ? "even columns" : "odd columns";
    case Partition::Rows2:
      return part == 0 ? "even rows" : "odd rows";
    case Partition::Phases2:
      return NameOfPhase(part, 2);
    case Partition::Columns4:
      return "column " + std::to_string(part) + " of 4";
    case Partition::Rows4:
      return "row " + std::to_string(part) + " of 4";
    case Partition::FrameHalves:
      return part == 0 ? "first half of the frames" : "last half of the frames";
    case Partition::FrameQuarters:
      return "quarter " + std::to_string(part + 1) + " of the frames";
    case Partition::FrameParities:
      return part == 0 ? "even frames" : "odd frames";
    case Partition::Phases4:
      break;
  }
  return NameOfPhase(part, LargestPeriod);
}

} // namespace sensornoise
