// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/FreeMemory.h"

#include <cstddef>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef __linux__
#  include <unistd.h>
#endif

using namespace sensornoise;

TEST(FreeMemory, BytesAsPeopleReadThem)
{
  EXPECT_EQ(TextOfBytes(4.0), "4 bytes");
  EXPECT_EQ(TextOfBytes(5e5), "0.5 MB");
  EXPECT_EQ(TextOfBytes(2.436e9), "2.44 GB");
  EXPECT_EQ(TextOfBytes(1.6e12), "1.6 TB");
  EXPECT_EQ(TextOfBytes(3e20), "3e+05 PB");
}

TEST(FreeMemory, MoreThanThereIsIsRefused)
{
  EXPECT_NO_THROW(RequireMemory(1.0, "a byte"));
  if (!FreeMemoryBytes())
  {
    GTEST_SKIP() << "this system does not tell";
  }
  EXPECT_GT(*FreeMemoryBytes(), 1e6);
  try
  {
    RequireMemory(1e18, "the test");
    FAIL();
  }
  catch (const std::runtime_error & error)
  {
    EXPECT_EQ(std::string(error.what()).rfind("the test needs 1e+03 PB of memory, but ", 0), 0u) << error.what();
  }
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
TEST(FreeMemory, WhatWasFreedBetweenPiecesInUseIsGivenBack)
{
  const auto residentBytes = [] {
    std::size_t   pages = 0;
    std::ifstream statm("/proc/self/statm");
    statm >> pages >> pages; // all, and of these what is in memory
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  };
  constexpr std::size_t pieceBytes = 32768; // small enough for the heap: larger blocks come from mmap()
  std::vector<std::unique_ptr<std::vector<char>>> pieces(2000);
  for (auto & piece : pieces)
  {
    piece = std::make_unique<std::vector<char>>(pieceBytes, 'x');
  }
  const std::vector<char> above(pieceBytes, 'x');
  for (std::size_t i = 0; i < pieces.size(); i += 2)
  {
    pieces[i].reset();
  }
  const std::size_t before = residentBytes();
  ReleaseFreedMemory();
  EXPECT_LT(residentBytes() + pieces.size() / 4 * pieceBytes, before); // half of what was freed, at least
}
#endif
