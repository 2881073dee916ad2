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
#include "sensornoise/series/SceneSeries.h"
#include "sensornoise/base/NothingToMeasure.h"
#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/series/FrameEquations.h"
#include "sensornoise/series/FrameProducts.h"
#include "sensornoise/series/FrameRegressors.h"
#include "sensornoise/series/FrameSums.h"
#include "helpers/FrameTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 70;
constexpr std::size_t Height = 45;
} // namespace

TEST(SensorNoiseSceneSeries, FlickerTellsTheOffset)
{
  const SyntheticFrames frames(Width, Height, FlickerAndMotion(24, 120.0, 0.3), 1.0);
  const FrameSums       sums = frames.Sums();
  const SceneSeries     series = FindSceneSeries(sums, RollingShutter::Off);
  EXPECT_EQ(series.offset, series.line.offset);
  // 6 standard errors.
  EXPECT_NEAR(series.offset + frames.model.centreDn, 120.0, 6.0 * series.line.standardError);
  EXPECT_EQ(series.local.series.cols(), 0);
  EXPECT_EQ(series.basis.NumberOfLightFactors(), 1u);
  EXPECT_GE(series.basis.Size(), 1 + series.motion.stencils.size());
}

TEST(SensorNoiseSceneSeries, WithoutFlickerTheDarkestLevelServes)
{
  const SyntheticFrames frames(Width, Height, std::vector<FrameChange>(24), 1.0);
  const FrameSums       sums = frames.Sums();
  const SceneSeries     series = FindSceneSeries(sums, RollingShutter::Off);
  EXPECT_EQ(series.offset, frames.model.darkestDn - frames.model.centreDn);
}

TEST(SensorNoiseSceneSeries, OneIntensityIsNothingToMeasure)
{
  SyntheticFrames frames(Width, Height, std::vector<FrameChange>(24));
  std::fill(frames.reference.mean.begin(), frames.reference.mean.end(), 500.0);
  const FrameSums sums = frames.EmptySums();
  EXPECT_THROW(FindSceneSeries(sums, RollingShutter::Auto), NothingToMeasure);
}

TEST(SensorNoiseSceneSeries, NoiseOfTheModelCountsThePixelsOfEachClass)
{
  const SyntheticFrames   frames(Width, Height, std::vector<FrameChange>(5));
  const FrameSums         sums = frames.EmptySums();
  const RegressorNoise    noise = NoiseOfModel(sums.GetRegressors());
  std::vector<double>     counts(GradientClasses, 0.0);
  const FrameRegressors & regressors = sums.GetRegressors();
  for (std::size_t p = 0; p < frames.Pixels(); ++p)
  {
    if (frames.take[p] != 0)
    {
      counts[regressors.ClassOf(p)] += 1.0;
    }
  }
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    EXPECT_EQ(noise.variance[c], counts[c]) << c;
    EXPECT_EQ(noise.shot[c], 0.0) << c;
  }
}
