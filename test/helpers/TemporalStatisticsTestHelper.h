/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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
