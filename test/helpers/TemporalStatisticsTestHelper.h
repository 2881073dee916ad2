// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_TemporalStatisticsTestHelper_h
#define sensornoise_test_TemporalStatisticsTestHelper_h

#include "itkImage.h"
#include "itkTemporalStatisticsImageFilter.h"
#include "helpers/PipelineTestHelper.h"

#include <gtest/gtest.h>
#include <string>

/** \file
 * The statistics of a stack over time, and their comparison. */

namespace sensornoisetest::statistics
{
using StackType = itk::Image<unsigned short, 3>;
using PixelTypes = ::testing::Types<unsigned char, unsigned short, short, float, double>;
inline constexpr unsigned int Width = 37;
inline constexpr unsigned int Height = 33;
inline constexpr unsigned int Frames = 11;

template <typename TStack>
auto
StatisticsOf(const TStack * stack)
{
  auto filter = itk::TemporalStatisticsImageFilter<TStack>::New();
  filter->SetInput(stack);
  return filter;
}

template <typename TFilter>
void
ExpectTheSameStatistics(const TFilter & a, const TFilter & b, const std::string & what)
{
  EXPECT_TRUE(HaveTheSameBits(a->GetMean(), b->GetMean())) << what;
  EXPECT_TRUE(HaveTheSameBits(a->GetVariance(), b->GetVariance())) << what;
  EXPECT_TRUE(HaveTheSameBits(a->GetValidMask(), b->GetValidMask())) << what;
}

} // namespace sensornoisetest::statistics

#endif
