// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"
#include "itkFlickerCorrectionImageFilter.h"
#include "helpers/FlickerCorrectionTestHelper.h"
#include "helpers/PipelineTestHelper.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkTemporalStatisticsImageFilter.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::flicker;
using RollingShutter = sensornoise::RollingShutter;
constexpr double Offset = 90.0;

/** Returns gamma_t of a noise-free stack: no whole period, but mean 0. */
double
GammaOf(itk::IndexValueType t)
{
  return t == static_cast<itk::IndexValueType>(Frames) - 1 ? 0.0
                                                           : 0.1 * static_cast<double>(((t % 2) * 2 - 1) * (1 + t / 2));
}

/** Returns mu + (1 + gamma_t)(level - mu) without noise, at the level levelOf(index). */
template <typename TFunction>
DoubleStackType::Pointer
NoiseFreeStack(const TFunction & levelOf)
{
  return ImageOf<DoubleStackType>({ { Width, Height, Frames } }, [&](const auto & index) {
    return Offset + (1.0 + 0.05 * GammaOf(index[2])) * (levelOf(index) - Offset);
  });
}
} // namespace

// u = mu + (1 + gamma_t)(L - mu) has the mean L, and u^ = u - (1 + gamma_t)(L - mu) = mu. Numbers up to 2000 and a
// regression of 25 frames round to below 1e-9.
TEST(FlickerCorrectionImageFilter, NoiseFreeStackBecomesTheOffset)
{
  for (const RollingShutter mode : { RollingShutter::Off, RollingShutter::Auto, RollingShutter::Fixed })
  {
    const auto stack = NoiseFreeStack([](const auto & index) { return index[0] < 30 ? 200.0 : 2000.0; });
    Chain      chain(stack.GetPointer());
    chain.filter->SetMask(ConstantImage<MaskType>({ { Width, Height } }, 1));
    chain.filter->SetRollingShutter(mode);
    chain.filter->Update();
    EXPECT_NEAR(chain.filter->GetFlicker().offsetDn, Offset, 1e-9);
    const auto corrected = PixelsOf(chain.filter->GetOutput());
    const auto extremes = std::minmax_element(corrected.begin(), corrected.end());
    EXPECT_NEAR(*extremes.first, Offset, 1e-9);
    EXPECT_NEAR(*extremes.second, Offset, 1e-9);
    for (unsigned int t = 0; t < Frames; ++t)
    {
      EXPECT_NEAR(chain.filter->GetFlicker().Gamma(t, 7), 0.05 * GammaOf(t), 1e-12);
    }
  }
}

// The mean of v^* over time is 1 by construction, so the mean of gamma_t is 0 and the mean of u^ is ubar - (ubar - mu)
// = mu.
TEST(FlickerCorrectionImageFilter, CorrectedStackHasTheOffsetAsItsMean)
{
  for (const RollingShutter mode : { RollingShutter::Off, RollingShutter::Fixed })
  {
    Chain chain(SimulatedStack().GetPointer());
    chain.filter->SetRollingShutter(mode);
    const auto statistics = itk::TemporalStatisticsImageFilter<DoubleStackType>::New();
    statistics->SetInput(chain.filter->GetOutput());
    statistics->Update();
    for (const double mean : PixelsOf(statistics->GetMean()))
    {
      EXPECT_NEAR(mean, chain.filter->GetFlicker().offsetDn, 1e-9);
    }
    EXPECT_EQ(chain.filter->GetOffset(), chain.filter->GetFlicker().offsetDn);
  }
}

// v^* averages the relative noise sqrt(g (u^* - mu) + sigma^2) / u^* over the bright set's effective pixels;
// gamma_t = (v^* - 1) u^* / (u^* - mu).
TEST(FlickerCorrectionImageFilter, SimulatedFlickerIsRecovered)
{
  const auto source = TargetSource<StackType>(Width, Height, Frames);
  Chain      chain(source->GetOutput());
  chain.filter->SetRollingShutter(RollingShutter::Off);
  chain.filter->Update();
  const auto & bright = chain.filter->GetBrightSet();
  const double sd = std::sqrt((bright.levelDn - 100.0 + 64.0) / bright.EffectivePixels()) / (bright.levelDn - 100.0);
  for (unsigned int t = 0; t < Frames; ++t)
  {
    EXPECT_NEAR(chain.filter->GetFlicker().gamma[t], source->GetTruth().normalisedFlicker[t], 5.0 * sd) << t;
  }
  EXPECT_LT(sd, 0.01);
  EXPECT_GT(bright.levelDn, chain.filter->GetDarkSet().levelDn);
}

TEST(FlickerCorrectionImageFilter, WithoutFlickerTheOffsetOutputIsNaN)
{
  const auto source = TargetSource<StackType>(Width, Height, Frames);
  source->SetFlickerSd(0.0);
  Chain chain(source->GetOutput());
  chain.filter->Update();
  EXPECT_TRUE(std::isnan(chain.filter->GetOffset()));
  EXPECT_TRUE(std::isfinite(chain.filter->GetFlicker().offsetDn));
}

TEST(FlickerCorrectionImageFilter, RowsThatTheBrightSetDoesNotReachAreNaN)
{
  // Bright rows 0 to 19; with sigma_y = 4 the flicker is known up to row 23.
  const auto isBright = [](const auto & index) { return index[1] < 20; };
  const auto stack = NoiseFreeStack([&](const auto & index) { return isBright(index) ? 2000.0 : 200.0; });
  Chain      chain(stack.GetPointer());
  chain.filter->SetMask(ConstantImage<MaskType>({ { Width, Height } }, 1));
  chain.filter->SetRollingShutter(RollingShutter::Fixed);
  chain.filter->SetSigmaRows(4.0);
  chain.filter->Update();
  for (itk::ImageRegionIteratorWithIndex<DoubleStackType> it(chain.filter->GetOutput(),
                                                             stack->GetLargestPossibleRegion());
       !it.IsAtEnd();
       ++it)
  {
    ASSERT_EQ(std::isnan(it.Get()), it.GetIndex()[1] >= 24) << it.GetIndex();
  }
}

// Columns instead of rows: the transposed stack gives the transposed result. Sums over the sets run in another order,
// 300 numbers of order 1, which rounds to 300 x 2^-53 x 3000 DN < 1e-9.
TEST(FlickerCorrectionImageFilter, ShutterMayTravelAlongX)
{
  const auto swap = [](const auto & index) { return StackType::IndexType{ { index[1], index[0], index[2] } }; };
  const auto transposed = ImageOf<StackType>(
    { { Height, Width, Frames } }, [&](const auto & index) { return SimulatedStack()->GetPixel(swap(index)); });
  Chain rows(SimulatedStack().GetPointer());
  Chain columns(transposed.GetPointer());
  columns.filter->SetShutterAxis(0);
  for (const auto & filter : { rows.filter, columns.filter })
  {
    filter->SetRollingShutter(RollingShutter::Fixed);
    filter->SetSigmaRows(10.0);
    filter->Update();
  }
  double worst = 0.0;
  for (itk::ImageRegionIteratorWithIndex<DoubleStackType> it(rows.filter->GetOutput(),
                                                             SimulatedStack()->GetLargestPossibleRegion());
       !it.IsAtEnd();
       ++it)
  {
    const double other = columns.filter->GetOutput()->GetPixel(swap(it.GetIndex()));
    EXPECT_EQ(std::isnan(it.Get()), std::isnan(other));
    worst = std::isnan(other) ? worst : std::max(worst, std::abs(it.Get() - other));
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(FlickerCorrectionImageFilter, StartIndexDoesNotMatter)
{
  const auto moved = MovedTo<StackType>({ { -3, 11, 5 } }, SimulatedStack());
  Chain      chain(moved.GetPointer());
  chain.filter->Update();
  EXPECT_EQ(chain.filter->GetOutput()->GetLargestPossibleRegion(), moved->GetLargestPossibleRegion());
  Chain expected(SimulatedStack().GetPointer());
  expected.filter->Update();
  EXPECT_TRUE(HaveTheSameBits<DoubleStackType>(chain.filter->GetOutput(), expected.filter->GetOutput()));
}

TEST(FlickerCorrectionImageFilter, WrongInputIsRefusedWithTheNumbers)
{
  Chain  chain(SimulatedStack().GetPointer());
  auto & filter = chain.filter;
  filter->SetMask(ConstantImage<MaskType>({ { Width, Height } }, 0));
  EXPECT_SAYS(ErrorOf(filter), "only 0 pixels are neither clipped nor moved by vibrations; expected at least 30");
  EXPECT_SAYS(ErrorOf(filter), "only 0 pixels");
  filter->SetMask(ConstantImage<MaskType>({ { Width, Height + 1 } }, 1));
  EXPECT_SAYS(ErrorOf(filter), "the mask has the region");
  filter->SetMask(chain.mask->GetOutput());
  filter->SetMean(ConstantImage<FrameType>({ { Width - 1, Height } }, 1));
  EXPECT_SAYS(ErrorOf(filter), "the mean has the region");
  filter->SetMean(chain.statistics->GetMean());
  filter->SetDarkQuantile(0.999);
  EXPECT_SAYS(ErrorOf(filter), "the dark and bright quantiles are 0.999 and 0.99");
  filter->SetDarkQuantile(0.01);
  filter->SetShutterAxis(2);
  EXPECT_SAYS(ErrorOf(filter), "the shutter axis is 2");
  filter->SetShutterAxis(1);
  filter->SetRollingShutter(RollingShutter::Fixed);
  filter->SetSigmaRows(0.0);
  EXPECT_SAYS(ErrorOf(filter), "sigma_y of the rolling shutter is 0 rows");
  filter->SetSigmaRows(50.0);
  EXPECT_EQ(ErrorOf(filter), "no error");
  filter->SetMean(nullptr);
  EXPECT_SAYS(ErrorOf(filter), "Input Mean is required but not set");
  const auto two = TargetStack<StackType>(Width, Height, 2);
  Chain      shortChain(two.GetPointer(), 2);
  EXPECT_SAYS(ErrorOf(shortChain.filter), "the stack has 2 frame(s); flicker and offset need at least 3");
}
