// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Planes of a mosaic that need different numbers of passes.
#include "mosaic/MosaicPasses.h"

#include "sensornoise/Report.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using Pixel = unsigned short;

namespace
{
/** A method that needs one pass more in each plane than in the one before. */
struct MorePassesInEachPlane
{
  using Passes = MorePassesInEachPlane;

  static constexpr unsigned int NumberOfPasses = 3;
  static constexpr bool         HasManySums = false;
  static constexpr bool         HasSample = false;

  std::size_t passes;
  std::size_t frames{ 0 };
  std::size_t ended{ 0 };
  Report      report{};

  std::vector<std::uint8_t> has{};

  void
  SetLayout(const PixelLayout &)
  {}
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return has;
  }
  void
  AddFrames(const Pixel *, std::size_t count)
  {
    EXPECT_FALSE(this->IsDone());
    frames += count;
  }
  static void
  AddFrames(const std::vector<MorePassesInEachPlane *> & planes,
            const Pixel *                                mosaics,
            std::size_t                                  count,
            const ParallelFor &)
  {
    for (MorePassesInEachPlane * const plane : planes)
    {
      plane->AddFrames(mosaics, count);
    }
  }
  bool
  IsFirstPass() const
  {
    return ended == 0;
  }
  std::vector<LeftOutFrame>
  FindUnlike() const
  {
    return {};
  }
  void
  LeaveOut(const std::vector<LeftOutFrame> &)
  {}
  void
  EndPass()
  {
    EXPECT_FALSE(this->IsDone());
    report.frames = frames;
    ++ended;
  }
  bool
  IsDone() const
  {
    return ended == passes;
  }
  const Report &
  GetReport() const
  {
    return report;
  }
};
} // namespace

TEST(MosaicPasses, PlanesThatAreDoneWaitForTheOthers)
{
  MosaicPasses<Pixel, MorePassesInEachPlane> mosaic(
    { { 4, 4, 1 }, BayerPattern::RGGB },
    [](BayerPlane plane, const auto &) { return MorePassesInEachPlane{ 3 + static_cast<std::size_t>(plane) }; });
  const std::vector<Pixel> frames(5 * 16);
  std::size_t              passes = 0;
  for (; !mosaic.IsDone(); ++passes)
  {
    mosaic.AddFrames(frames.data(), 5);
    mosaic.EndPass();
  }
  EXPECT_EQ(passes, 6U);
  for (std::size_t k = 0; k < 4; ++k)
  {
    EXPECT_EQ(mosaic.GetReports()[k].frames, 5 * (3 + k));
  }
}
