// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ParallelWork.h"
#include "helpers/StackTestHelper.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** A single call is made where it is asked for, as by the filters. */
ParallelFor
ThreadsForMany(std::size_t threads)
{
  return [threads](std::size_t count, const auto & function) {
    count == 1 ? SerialFor(count, function) : Threads(threads)(count, function);
  };
}
} // namespace

TEST(SensorNoisePlaneWork, EachPlaneIsWorkedOnOnceByAnyThreads)
{
  constexpr std::size_t pieces = 50;
  for (const std::size_t threads : { 1, 2, 3, 5 })
  {
    const PlaneWork                      work(ThreadsForMany(threads), threads);
    const ParallelFor                    within = work.WithinPlane();
    std::array<std::atomic<unsigned>, 4> calls{};
    work.ForPlanes(1, 4, [&](std::size_t k) { within(pieces, [&](std::size_t) { ++calls[k]; }); });
    EXPECT_EQ(calls[0], 0U);
    for (std::size_t k = 1; k < 4; ++k)
    {
      EXPECT_EQ(calls[k], pieces) << threads;
    }
  }
}

TEST(SensorNoisePlaneWork, WhatOnePlaneThrowsStopsTheOther)
{
  constexpr std::size_t pieces = 1'000'000;
  for (const std::size_t bad : { 0, 1 })
  {
    const PlaneWork          work(ThreadsForMany(2), 2);
    const ParallelFor        within = work.WithinPlane();
    std::atomic<bool>        isThrown{ false };
    std::atomic<std::size_t> calls{ 0 };
    const auto               ofPlane = [&](std::size_t k) {
      within(pieces, [&](std::size_t) {
        if (k == bad)
        {
          isThrown = true;
          throw std::runtime_error("of the plane");
        }
        while (!isThrown)
        {
          std::this_thread::yield();
        }
        ++calls;
        std::this_thread::yield();
      });
    };
    try
    {
      work.ForPlanes(0, 2, ofPlane);
      FAIL() << "it is thrown";
    }
    catch (const std::runtime_error & error)
    {
      EXPECT_STREQ(error.what(), "of the plane");
    }
    EXPECT_LT(calls, pieces);
    std::size_t after = 0;
    work.ForPlanes(0, 1, [&](std::size_t) { within(3, [&](std::size_t) { ++after; }); });
    EXPECT_EQ(after, 3U) << "later work is not stopped";
  }
}
