// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_SensorNoiseEstimatorTestHelper_h
#define sensornoise_test_SensorNoiseEstimatorTestHelper_h

#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "itkImage.h"
#include "itkSensorNoiseEstimator.h"
#include "helpers/PipelineTestHelper.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>

/** \file
 * The estimator on simulated stacks, and its reports. */

namespace sensornoisetest::estimator
{
using StackType = itk::Image<unsigned short, 3>;
using PixelTypes = ::testing::Types<unsigned char, unsigned short, short, float, double>;
inline constexpr unsigned int Width = 65;
inline constexpr unsigned int Height = 63;
inline constexpr unsigned int Frames = 25;

template <typename TStack>
auto
EstimatorOf(const TStack * stack, const std::string & method = "refined")
{
  auto estimator = itk::SensorNoiseEstimator<TStack>::New();
  estimator->SetInput(stack);
  estimator->SetMethod(method);
  return estimator;
}

inline StackType::Pointer
SimulatedStack()
{
  static const StackType::Pointer stack = TargetStack<StackType>(Width, Height, Frames);
  return stack;
}

template <typename TEstimator>
std::string
JsonOf(const TEstimator & estimator)
{
  EXPECT_EQ(ErrorOf(estimator), "no error");
  return sensornoise::ToJson(estimator->GetReport());
}

/** Returns the record without the settings, which say how it was made. */
template <typename TEstimator>
std::string
MeasuredBy(const TEstimator & estimator)
{
  EXPECT_EQ(ErrorOf(estimator), "no error");
  sensornoise::Report report = estimator->GetReport();
  report.settings.clear();
  return sensornoise::ToJson(report);
}

template <typename TEstimator>
void
ExpectTheSameMaps(const TEstimator & a, const TEstimator & b)
{
  EXPECT_TRUE(HaveTheSameBits(a->GetMean(), b->GetMean()));
  EXPECT_TRUE(HaveTheSameBits(a->GetVariance(), b->GetVariance()));
  EXPECT_TRUE(HaveTheSameBits(a->GetCorrectedVariance(), b->GetCorrectedVariance()));
  EXPECT_TRUE(HaveTheSameBits(a->GetPixelUse(), b->GetPixelUse()));
}

inline bool
WarnsOf(const sensornoise::Report & report, sensornoise::WarningCode code)
{
  return std::any_of(
    report.warnings.begin(), report.warnings.end(), [&code](const auto & warning) { return warning.code == code; });
}

} // namespace sensornoisetest::estimator

#endif
